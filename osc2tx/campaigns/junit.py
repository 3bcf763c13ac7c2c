"""The rows of a campaign as JUnit XML: those that passed and each kind of failure are a suite."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree import ElementTree as etree

from osc2tx.campaigns.summary import Results, Run, replay_command
from osc2tx_shared.text import visible

NOT_A_TEST = ("error", "crashed")  # rows that could not be judged


def render_junit(campaigns: Sequence[Results]) -> str:
    """Return the document of one campaign or of several."""
    names = ", ".join(dict.fromkeys(results.identity["scenario"] for results in campaigns))
    root = etree.Element(
        "testsuites", _counts(names, [run for results in campaigns for run in results.runs])
    )
    for results in campaigns:
        _add_campaign(root, results)
    etree.indent(root)
    text = etree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _add_campaign(root: etree.Element, results: Results) -> None:
    name = results.identity["scenario"]
    failed = {number for group in results.failures for number in group.rows}
    passed = [run for run in results.runs if run["number"] not in failed]
    by_number = {run["number"]: run for run in results.runs}
    _suite(root, results, f"{name}: success", passed)
    for group in results.failures:
        rows = [by_number[number] for number in group.rows]
        title = ": ".join(filter(None, (name, group.status, group.source, group.reason)))
        _suite(root, results, title, rows)


def _counts(name: str, runs: Sequence[Run]) -> dict[str, str]:
    errors = sum(run["status"] in NOT_A_TEST for run in runs)
    bad = sum(run["status"] != "success" for run in runs)
    return {
        "name": visible(name),
        "tests": str(len(runs)),
        "failures": str(bad - errors),
        "errors": str(errors),
        "time": f"{sum(run['seconds'] for run in runs):.3f}",
    }


def _suite(root: etree.Element, results: Results, name: str, runs: Sequence[Run]) -> None:
    if not runs:
        return
    suite = etree.SubElement(root, "testsuite", _counts(name, runs))
    for run in runs:
        case = etree.SubElement(
            suite,
            "testcase",
            {
                "classname": visible(results.identity["scenario"]),
                "name": f"row {run['number']}",
                "time": f"{run['seconds']:.3f}",
            },
        )
        if run["violations"]:
            out = etree.SubElement(case, "system-out")
            out.text = visible_lines("\n".join(run["violations"]))
        if run["status"] == "success":
            continue
        kind = "error" if run["status"] in NOT_A_TEST else "failure"
        found = etree.SubElement(
            case, kind, {"type": run["status"], "message": visible(run["reason"])}
        )
        values = "\n".join(f"{key} = {value}" for key, value in run["parameters"].items())
        place = f"\n{run['source']}" if run["source"] else ""
        found.text = visible_lines(
            f"{replay_command(results.place, run['number'])}{place}\n{values}"
        )


def visible_lines(text: str) -> str:
    """Return text without characters that XML forbids; line ends are kept."""
    return "\n".join(map(visible, text.splitlines()))

"""The report of a campaign: the data of its page, and the comparison with an earlier one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from osc2tx.campaigns.coverage import Item, overall
from osc2tx.campaigns.summary import Results, Run, replay_command, spread_of, summary_of
from osc2tx_runtime.report.page import render_campaign

MOST_ROWS = 10_000  # that are drawn
BINS = 24
DIGITS = 6  # significant digits of drawn values
VISIBLE = 1e-4  # of a value: less is rounding of computed ones


def render_report(results: Results, before: Results | None = None) -> str:
    """Return the page of a campaign, compared with an earlier one if there is one."""
    summary = summary_of(results)
    drawn = drawn_rows(results.runs)
    hidden = {"coverage", "measures", "failures"}
    identity = results.identity
    data: dict[str, object] = {
        "summary": {
            **{name: value for name, value in summary.items() if name not in hidden},
            "map": (identity["map"] or "")[:12],
        },
        "failures": [
            {
                "status": each.status,
                "reason": each.smallest["reason"],
                "source": each.source,
                "count": len(each.rows),
                "row": each.smallest["number"],
                "time": each.smallest["time"],
                "replay": replay_command(results.place, each.smallest["number"]),
            }
            for each in results.failures
        ],
        "items": [_item(item, results.runs) for item in results.items.values()],
        "measures": [_measure(each, results.runs) for each in summary["measures"]],
        "columns": _columns(drawn),
        "good": [int(run["status"] == "success") for run in drawn],
        "against": None if before is None else compared(results, before),
    }
    return render_campaign(data)


def drawn_rows(runs: Sequence[Run]) -> list[Run]:
    """Return the rows that are drawn: all that failed first, then as many others, in order."""
    failed = [run for run in runs if run["status"] != "success"][:MOST_ROWS]
    others = [run for run in runs if run["status"] == "success"][: MOST_ROWS - len(failed)]
    return sorted((*failed, *others), key=lambda run: int(run["number"]))


def _item(item: Item, runs: Sequence[Run]) -> dict[str, Any]:
    spread = spread_of(item.values)
    scope, _, short = item.name.rpartition(".")
    possible_cells = list(item.cells()) if item.is_graded else []
    return {
        "name": item.name,
        "short": short,
        "scope": scope,
        "kind": item.kind,
        "group": item.group.rpartition(".")[2],
        "unit": item.unit,
        "text": item.text,
        "target": item.target,
        "parts": [part.name for part in item.parts],
        "buckets": [str(bucket) for bucket in item.buckets],
        "hits": {_key(cell): count for cell, count in sorted(item.hits.items())},
        "impossible": [_key(cell) for cell in possible_cells if item.is_impossible(cell)],
        "holes": [_key(cell) for cell in item.holes()],
        "grade": item.grade,
        "samples": item.samples,
        "outside": item.outside,
        "values": None if spread is None else _distribution(spread, item.values, runs),
        "illegal": item.illegal,
    }


def _key(cell: Sequence[int]) -> str:
    return ",".join(map(str, cell))


def _measure(said: dict[str, Any], runs: Sequence[Run]) -> dict[str, Any]:
    values = [(run["measures"].get(said["name"]), run["number"]) for run in runs]
    return _distribution(said, [(value, row) for value, row in values if value is not None], runs)


def _distribution(
    spread: dict[str, Any], values: Sequence[tuple[float, int]], runs: Sequence[Run]
) -> dict[str, Any]:
    """Return least, mean and greatest of values with their histogram, rows that failed apart."""
    least, greatest = spread["least"], spread["greatest"]
    passed = {run["number"] for run in runs if run["status"] == "success"}
    bins = {True: [0] * BINS, False: [0] * BINS}
    for value, row in values:
        share = (value - least) / (greatest - least) if _differ(least, greatest) else 0.0
        bins[row in passed][min(int(share * BINS), BINS - 1)] += 1
    return {**spread, "good": bins[True], "bad": bins[False]}


def _columns(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """Return parameters and measures that differ between rows, as columns."""
    columns = []
    for source in ("parameters", "measures"):
        names = dict.fromkeys(name for run in runs for name in run[source])
        for name in names:
            values = [run[source].get(name) for run in runs]
            known = {_short(value) for value in values if value is not None}
            if len(known) < 2 or (source == "measures" and "(" in name):
                continue
            if all(map(_is_number, known)):
                if not _differ(min(known), max(known)):
                    continue
                columns.append({"name": name, "values": [_short(value) for value in values]})
            elif not any(map(_is_number, known)):
                labels = sorted({str(value) for value in known})
                places = [None if each is None else labels.index(str(each)) for each in values]
                columns.append({"name": name, "values": places, "labels": labels})
    return columns


def _differ(least: float, greatest: float) -> bool:
    """Whether the labels of an axis differ at its ends."""
    return greatest - least > VISIBLE * max(abs(least), abs(greatest))


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _short(value: Any) -> Any:
    """Return a number with the digits that a picture can show, other values unchanged."""
    if not _is_number(value):
        return value
    short = float(f"{value:.{DIGITS}g}")
    return int(short) if short.is_integer() else short


def compared(now: Results, before: Results) -> dict[str, Any]:
    """Return the differences from an earlier campaign."""
    groups = [{(e.status, e.source, e.reason) for e in each.failures} for each in (now, before)]
    hit = [_hit(each) for each in (now, before)]
    return {
        "name": before.place,
        "passed_now": _passed(now),
        "passed_before": _passed(before),
        "grade_now": overall(now.items.values()),
        "grade_before": overall(before.items.values()),
        "new_failures": [
            f"{each.status}: {each.smallest['reason']} ({len(each.rows)} rows;"
            f" {replay_command(now.place, each.smallest['number'])})"
            for each in now.failures
            if (each.status, each.source, each.reason) not in groups[1]
        ],
        "gone_failures": [
            f"{each.status}: {each.smallest['reason']} ({len(each.rows)} rows)"
            for each in before.failures
            if (each.status, each.source, each.reason) not in groups[0]
        ],
        "lost": [name for name in hit[1] if name not in hit[0]],
        "won": [name for name in hit[0] if name not in hit[1]],
    }


def _hit(results: Results) -> dict[str, None]:
    """Return the buckets that have their hits, by item and name."""
    return {
        f"{item.name}: {item.name_of(cell)}": None
        for item in results.items.values()
        if item.is_graded
        for cell in item.cells()
        if item.hits[cell] >= item.target
    }


def _passed(results: Results) -> float | None:
    if not results.runs:
        return None
    passed = len([run for run in results.runs if run["status"] == "success"])
    return 100.0 * passed / len(results.runs)

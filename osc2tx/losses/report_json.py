"""The loss report as JSON; `docs/xml-report.md` says what it holds.

It is reviewed with the documents, so it has neither line numbers nor counts: a place is the path of
labels to a construct and its text. Diagnostics of the same constructs have lines and columns.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.ir.source_text import one_line
from osc2tx.losses.entries import Entry, Grade
from osc2tx.losses.report import LossReport
from osc2tx_shared.text import in_json

FORMAT = 4


def report_json(report: LossReport) -> str | None:
    """Return the report of a scenario; none if all of it is exact and needs no remark."""
    exact = [entry for entry in report.entries if entry.grade is Grade.EXACT]
    lost = [_entry_data(entry, report.module) for entry in report.losses]
    notes = dict.fromkeys(f"{entry.construct}: {entry.reason}" for entry in exact if entry.reason)
    omitted = report.measured.omitted if report.measured is not None else ()
    if not (lost or notes or report.unmeasured or omitted):
        return None
    head: dict[str, object] = {
        "format": FORMAT,
        "scenario": report.scenario.name,
        "source": report.module.source,
        "xml_version": report.options.version,
        "xml_profile": report.options.profile,
        "allow_approx": report.options.allow_approx,
        "written": report.is_expressible,
    }
    if report.measured is not None:
        measured: dict[str, object] = {"runs": report.measured.runs, **report.measured.values()}
        head["measured"] = {**measured, "omitted": omitted} if omitted else measured
    elif report.unmeasured:
        head["unmeasured"] = report.unmeasured
    lists: dict[str, Sequence[object]] = {
        "notes": list(notes),
        "losses": list(_merged(lost)),
    }
    lines = [f"  {_text(key)}: {_text(value)}" for key, value in head.items()]
    lines += [f"  {_text(key)}: {_list(values)}" for key, values in lists.items()]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _merged(losses: Sequence[dict[str, object]]) -> Iterator[dict[str, object]]:
    """Yield losses, one for all constructs that differ in their text only."""
    texts: dict[str, list[object]] = {}
    for loss in losses:
        same = _text({**loss, "text": ""})
        texts.setdefault(same, []).append(loss["text"])
    for loss in losses:
        first, *others = texts.pop(_text({**loss, "text": ""}), (None,))
        if first is not None:
            yield {**loss, "also": others} if others else loss


def _list(values: Sequence[object]) -> str:
    """Return a list with a line for each of its members."""
    lines = ",\n".join(f"    {_text(value)}" for value in values)
    return f"[\n{lines}\n  ]" if values else "[]"


def _text(value: object) -> str:
    return in_json(json.dumps(value, ensure_ascii=False))


def _entry_data(entry: Entry, module: ir.Module) -> dict[str, object]:
    data: dict[str, object] = {"construct": entry.construct, "grade": entry.grade.value}
    if entry.span.source.name != module.source:
        data["file"] = entry.span.source.name
    data["within"] = _path(entry.span, module)
    data["text"] = one_line(entry.span.text)
    if entry.reason:
        data["reason"] = entry.reason
    if entry.bound:
        data["bound"] = str(entry.bound)
    if entry.remedy.instead:
        data["instead"] = entry.remedy.instead
    if entry.remedy.version is not None:
        data["expressible_in_version"] = entry.remedy.version
    if entry.remedy.profile is not None:
        data["expressible_in_profile"] = entry.remedy.profile
    return data


def _path(span: Span, module: ir.Module) -> str:
    """Return the scenario that holds a place and the labels of the members around it."""
    above = [
        s for s in module.scenarios if s.span.source is span.source and s.span.start <= span.start
    ]
    if not above:
        return ""
    scenario = max(above, key=lambda s: s.span.start)
    around = (n for n in ir.walk_behaviors(scenario.body) if n.span.holds(span))
    return ".".join((scenario.name, *(node.label for node in around if node.label is not None)))

"""An edit of a scenario changes the lines that say it, and few others, in all committed outputs."""

from pathlib import Path
from statistics import median

import pytest

from tests.end_to_end.single_edits import EDITS, Edit, costs

MOST = 10
"""Changed lines of outputs for each changed line of a scenario."""

TYPICAL = 5

LOUD = {
    "value capabilities/C31_overlaps": "when later members start follows from this length",
    "statement capabilities/C31_overlaps": "when later members start follows from this length",
    "statement capabilities/C16_automatic_lights": "XML cannot say it, so the document goes",
    "statement capabilities/C18_braking_distances": "one more name breaks an import into lines",
    "label capabilities/C04_duration": "the label names an act and the variables that stop it",
    "statement pedestrian_crossing: walker.walk": "one more curve, and the next begins elsewhere",
    "statement cut_in: wait": "a variable keeps an edge that the wait begins with",
    "statement cut_in: other.change_speed": "two elements wait for the new event",
    "statement capabilities/C32": "a variable keeps an edge that the drive begins with",
    "statement cut_in_and_evade: emit": "an event that is emitted twice is reset after each time",
    "actor cut_in": "a vehicle has a shape, axles and limits",
}
"""Edits that change more, and why."""


def why_loud(edit: Edit) -> str | None:
    return next((why for start, why in LOUD.items() if str(edit).startswith(start)), None)


@pytest.mark.slow
def test_edits_show_only_themselves(tmp_path: Path) -> None:
    found = costs(EDITS, tmp_path)
    assert len({edit.file for edit in EDITS}) >= 15
    loud = {edit for edit, cost in found.items() if cost.ratio > MOST}
    assert loud == {edit for edit in EDITS if why_loud(edit)}
    assert median(cost.ratio for cost in found.values()) <= TYPICAL


def test_a_comment_a_value_and_a_name(tmp_path: Path) -> None:
    edits = tuple(e for e in EDITS if e.file == "follow_leader" and e.kind in ("comment", "rename"))
    values = tuple(e for e in EDITS if e.file == "follow_leader" and e.kind == "value")
    found = costs((*edits, *values), tmp_path)
    comment, rename = (found[edit] for edit in sorted(edits, key=lambda edit: edit.kind))
    assert comment.outputs == {".py": 1, ".osc2tx-manifest.json": 2}
    assert rename.ratio <= MOST
    assert all(found[edit].ratio <= TYPICAL for edit in values)
    assert all(found[edit].outputs[".xosc.report.json"] == 0 for edit in values)

"""An edit of a scenario changes the lines that say it, and few others, in all committed outputs."""

from pathlib import Path
from statistics import median

import pytest

from tests.end_to_end.single_edits import EDITS, Edit, costs

MOST = 30
"""Changed lines of outputs for each changed line of a scenario: an event of XML has two dozen."""

TYPICAL = 4
"""The same, for the median of the edits."""

LOUD = {
    "statement follow_leader": (150, "played, the document is 0.3 m off: it goes"),
}
"""Edits that change more: how much, and why."""


def bound(edit: Edit) -> float:
    """Return how many lines an edit may change for each line of the scenario."""
    return next((most for start, (most, _) in LOUD.items() if str(edit).startswith(start)), MOST)


@pytest.mark.slow
def test_edits_show_only_themselves(tmp_path: Path) -> None:
    found = costs(EDITS, tmp_path)
    assert len({edit.file for edit in EDITS}) >= 15
    assert {edit: cost.outputs for edit, cost in found.items() if cost.ratio > bound(edit)} == {}
    assert sum(cost.ratio > MOST for cost in found.values()) == len(LOUD)
    assert median(cost.ratio for cost in found.values()) <= TYPICAL


def test_a_comment_a_value_and_a_name(tmp_path: Path) -> None:
    edits = tuple(e for e in EDITS if e.file == "follow_leader" and e.kind in ("comment", "rename"))
    values = tuple(e for e in EDITS if e.file == "follow_leader" and e.kind == "value")
    found = costs((*edits, *values), tmp_path)
    comment, rename = (found[edit] for edit in sorted(edits, key=lambda edit: edit.kind))
    assert comment.outputs == {".py": 1}
    assert rename.ratio <= MOST
    assert all(found[edit].ratio <= TYPICAL for edit in values)
    assert all(found[edit].outputs.keys() == {".py", ".xosc"} for edit in values)

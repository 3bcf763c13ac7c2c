"""One more statement in the source changes only what says it in the module."""

import difflib
import re
from pathlib import Path

import pytest

from osc2tx.backends.py_trees import emit
from tests.end_to_end.harness import SCENARIOS, asam

SOURCE = (SCENARIOS / "cut_in_and_evade.osc").read_text(encoding="utf-8").splitlines()
STATEMENTS = {
    "wait elapsed(1.25s)": "Wait(elapsed(1.25 * s)),",
    "emit crash_avoided": "Emit(self.crash_avoided),",
    "npc.drive(duration: 2s)": "self.npc.drive(duration=2 * s),",
}


def insertion_points() -> list[int]:
    """Return the lines before which a member of a `serial` may stand.

    Not before the members that place an actor: they must begin with the run.
    """
    member = re.compile(r" {12,16}(\w+: )?(hero\.|npc\.|emit |wait )")
    starts = [index for index, line in enumerate(SOURCE) if member.match(line)]
    return [index for index in starts if "at: start" not in "".join(SOURCE[index + 1 : index + 2])]


def module(lines: list[str], folder: Path) -> list[str]:
    return emit(asam("\n".join(lines) + "\n", folder)).python.splitlines()


def changes(before: list[str], after: list[str]) -> list[str]:
    """Return the lines that are new (`+`) or gone (`-`), without their indentation."""
    return [
        f"{line[0]} {line[1:].strip()}"
        for line in difflib.unified_diff(before, after, n=0, lineterm="")
        if line[:1] in "+-" and line[:3] not in ("+++", "---")
    ]


@pytest.fixture(scope="module")
def before(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    return module(SOURCE, tmp_path_factory.mktemp("before"))


@pytest.mark.parametrize("index", insertion_points())
def test_inserted_statements_are_new_lines(index: int, before: list[str], tmp_path: Path) -> None:
    indent = SOURCE[index][: len(SOURCE[index]) - len(SOURCE[index].lstrip())]
    inserted = [indent + statement for statement in STATEMENTS]
    after = module([*SOURCE[:index], *inserted, *SOURCE[index:]], tmp_path)
    assert changes(before, after) == [f"+ {line}" for line in STATEMENTS.values()]


def test_a_comment_on_top_is_one_new_line(before: list[str], tmp_path: Path) -> None:
    after = module(["# Seen twice", *SOURCE], tmp_path)
    assert changes(before, after) == ["+ Seen twice"]


def test_there_are_enough_edits() -> None:
    assert len(insertion_points()) * len(STATEMENTS) >= 30

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


@pytest.fixture(scope="module")
def before(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    return module(SOURCE, tmp_path_factory.mktemp("before"))


@pytest.mark.parametrize("statement", STATEMENTS)
@pytest.mark.parametrize("index", insertion_points())
def test_an_inserted_statement_is_one_new_line(
    index: int, statement: str, before: list[str], tmp_path: Path
) -> None:
    indent = SOURCE[index][: len(SOURCE[index]) - len(SOURCE[index].lstrip())]
    edited = [*SOURCE[:index], indent + statement, *SOURCE[index:]]
    after = module(edited, tmp_path)
    changed = [
        line[1:].strip()
        for line in difflib.unified_diff(before, after, n=0, lineterm="")
        if line[:1] in "+-" and line[:3] not in ("+++", "---")
    ]
    assert changed == [STATEMENTS[statement]]


def test_a_comment_on_top_is_one_new_line(before: list[str], tmp_path: Path) -> None:
    after = module(["# Seen twice", *SOURCE], tmp_path)
    assert [line for line in after if line not in before] == ["Seen twice"]
    assert len(after) == len(before) + 1


def test_there_are_enough_edits() -> None:
    assert len(insertion_points()) * len(STATEMENTS) >= 30

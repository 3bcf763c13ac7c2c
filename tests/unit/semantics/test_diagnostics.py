"""Each code has a faulty line that triggers it, and a neighbor that just does not."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.analysis import analyse
from osc2tx.diagnostics import CODES
from osc2tx.diagnostics.render import render_text
from tests.unit.semantics.support import build_file

CASES = sorted((Path(__file__).parents[2] / "golden" / "diagnostics").glob("semantic_*"))
FAMILIES = ("OSC2", "OSC3", "OSC4", "OSC6")
ANALYSIS = ("OSC42", "OSC43", "OSC44")  # see tests/unit/analysis
Golden = Callable[[str, Path], None]


def marks(path: Path) -> list[tuple[int, str]]:
    """The codes that comments `#! OSC203` announce, with their lines."""
    return [
        (number, code)
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        for code in re.findall(r"OSC\d{3}", line.partition("#!")[2])
    ]


@pytest.mark.parametrize("case", CASES, ids=lambda path: path.name)
def test_faulty(case: Path, golden: Golden) -> None:
    _, sink = build_file(case / "input.osc")
    found = {(d.primary.line, d.code) for d in sink.sorted() if d.primary is not None}
    assert sorted(found) == sorted(set(marks(case / "input.osc")))
    text = "\n".join(render_text(d) for d in sink.sorted())
    golden(text, case / "expected" / "diagnostics.txt")


@pytest.mark.parametrize("case", CASES, ids=lambda path: path.name)
def test_neighbor_is_valid(case: Path) -> None:
    model, sink = build_file(case / "valid.osc")
    assert [d.message for d in sink.sorted()] == []
    analyse(model, sink)
    assert not sink.has_errors, sink.sorted()


def test_every_code_has_a_case() -> None:
    announced = {code for case in CASES for _, code in marks(case / "input.osc")}
    ours = {code for code in CODES if code.startswith(FAMILIES) and not code.startswith(ANALYSIS)}
    assert ours - announced == set()

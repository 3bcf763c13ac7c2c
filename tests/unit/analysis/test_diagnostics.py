"""Each code has faulty lines that trigger it, and neighbors that just do not."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.analysis import analyse
from osc2tx.diagnostics import CODES, DiagnosticSink
from osc2tx.diagnostics.render import render_text
from tests.unit.semantics.support import build_file, build_text

CASES = sorted((Path(__file__).parents[2] / "golden" / "diagnostics").glob("analysis_*"))
FAMILIES = ("OSC42", "OSC43", "OSC44")
OF_FILES = {
    "OSC443"
}  # of the compilation, which knows folders: tests/unit/cli/test_check_command.py
Golden = Callable[[str, Path], None]


def analyse_file(path: Path) -> DiagnosticSink:
    """Analyse a file; it has no errors before that."""
    model, sink = build_file(path)
    assert [d.message for d in sink.sorted()] == []
    analyse(model, sink)
    return sink


def marks(path: Path) -> list[tuple[int, str]]:
    """The codes that comments `#! OSC420` announce, with their lines."""
    return [
        (number, code)
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        for code in re.findall(r"OSC\d{3}", line.partition("#!")[2])
    ]


@pytest.mark.parametrize("case", CASES, ids=lambda path: path.name)
def test_faulty(case: Path, golden: Golden) -> None:
    sink = analyse_file(case / "input.osc")
    found = {(d.primary.line, d.code) for d in sink.sorted() if d.primary is not None}
    assert sorted(found) == sorted(set(marks(case / "input.osc")))
    text = "\n".join(render_text(d) for d in sink.sorted())
    golden(text, case / "expected" / "diagnostics.txt")


@pytest.mark.parametrize("case", CASES, ids=lambda path: path.name)
def test_neighbor_is_valid(case: Path) -> None:
    sink = analyse_file(case / "valid.osc")
    assert [render_text(d) for d in sink.sorted()] == []


def test_every_code_has_a_case() -> None:
    announced = {code for case in CASES for _, code in marks(case / "input.osc")}
    assert {code for code in CODES if code.startswith(FAMILIES)} - OF_FILES == announced


def test_a_long_chain_of_global_parameters() -> None:
    """All global parameters are looked at once, together."""
    last = 2000
    chain = "".join(f"global g{i}: int = g{i - 1} + 1\n" for i in range(1, last + 1))
    broken = f"global h: int with:\n    keep(it == g{last})\n    keep(it < 9)\n"
    model, sink = build_text(f"global g0: int = 1\n{chain}{broken}")
    analyse(model, sink)
    assert [d.code for d in sink.sorted()] == ["OSC422"]

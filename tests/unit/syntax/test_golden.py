"""Golden files of the front end: ASTs and the messages for typical mistakes."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.diagnostics import DiagnosticSink
from osc2tx.diagnostics.render import render_text
from osc2tx.syntax import parse, read_source
from osc2tx.syntax.dump import dump_ast

GOLDEN = Path(__file__).parents[2] / "golden"
AST_CASES = sorted(path.parent for path in (GOLDEN / "ast").glob("*/input.osc"))
MISTAKES = sorted(path.parent for path in (GOLDEN / "diagnostics").glob("syntax_*/input.osc"))

Golden = Callable[[str, Path], None]


@pytest.mark.parametrize("case", AST_CASES, ids=lambda case: case.name)
def test_ast(case: Path, golden: Golden) -> None:
    sink = DiagnosticSink()
    source = read_source(case / "input.osc", "input.osc", sink)
    assert source is not None
    file = parse(source, sink)
    assert sink.sorted() == ()
    golden(dump_ast(file), case / "expected" / "ast.txt")


@pytest.mark.parametrize("case", MISTAKES, ids=lambda case: case.name)
def test_messages(case: Path, golden: Golden) -> None:
    sink = DiagnosticSink()
    source = read_source(case / "input.osc", "input.osc", sink)
    assert source is not None
    parse(source, sink)
    golden("".join(map(render_text, sink.sorted())), case / "expected" / "diagnostics.txt")


def test_there_are_cases() -> None:
    assert len(AST_CASES) >= 9
    assert len(MISTAKES) >= 25

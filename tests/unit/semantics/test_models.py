"""Golden dumps of semantic models."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.diagnostics import SourceFile
from osc2tx.diagnostics.render import render_text
from osc2tx.semantics import SemanticModel
from osc2tx.semantics.dump import dump_model
from osc2tx.semantics.types import ERROR
from tests.unit.semantics.support import build, build_file

GOLDEN = Path(__file__).parents[2] / "golden"
CASES = sorted((GOLDEN / "semantics").glob("*/input.osc"))
SEED = Path(__file__).parents[3] / "scenarios" / "hello_world.osc"
Golden = Callable[[str, Path], None]


def untyped(model: SemanticModel) -> list[str]:
    """Expressions of the user's files without a type."""
    return [
        node.span.text
        for node, type_ in model.types.items()
        if type_ == ERROR and not node.span.source.name.startswith("<library>")
    ]


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.parent.name)
def test_model(path: Path, golden: Golden) -> None:
    model, sink = build_file(path)
    assert [d.message for d in sink.sorted()] == []
    assert untyped(model) == []
    golden(dump_model(model), path.parent / "expected" / "model.txt")


@pytest.mark.parametrize("dialect", ["asam", "carla"])
def test_seed(dialect: str, golden: Golden) -> None:
    source = SourceFile(SEED.name, SEED.read_text(encoding="utf-8"), SEED)
    model, sink = build(source, dialect=dialect)
    assert sink.has_errors == (dialect == "asam")
    folder = GOLDEN / "semantics" / f"hello_world_{dialect}" / "expected"
    golden("\n".join(render_text(d) for d in sink.sorted()), folder / "diagnostics.txt")
    if dialect == "carla":
        assert untyped(model) == []
        golden(dump_model(model), folder / "model.txt")

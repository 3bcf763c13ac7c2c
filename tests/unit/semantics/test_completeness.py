"""In a valid program every expression has a type, every name a meaning, every call a binding."""

from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path
from typing import get_args

import pytest

from osc2tx.syntax import ast
from tests.unit.semantics.support import build_file

GOLDEN = Path(__file__).parents[2] / "golden"
PATHS = sorted(GOLDEN.glob("semantics/*/input.osc"))
PATHS += sorted(GOLDEN.glob("diagnostics/semantic_*/valid.osc"))

EXPRESSIONS = get_args(ast.Expression)
NAMES = ast.NameExpression | ast.MemberAccess | ast.EnumLiteral
CALLS = ast.Invocation | ast.ModifierApplication | ast.Call | ast.CallDirective | ast.EmitDirective


def walk(node: object) -> Iterator[ast.Node]:
    if isinstance(node, ast.Node):
        yield node
        for field in fields(node):
            yield from walk(getattr(node, field.name))
    elif isinstance(node, tuple):
        for item in node:
            yield from walk(item)


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.parent.name)
def test_tables_are_complete(path: Path) -> None:
    model, sink = build_file(path)
    assert not sink.has_errors
    nodes = list(walk(model.root))
    coverage = {n for c in nodes if isinstance(c, ast.CoverageDeclaration) for n in walk(c)}
    enum_values = {n.value for n in nodes if isinstance(n, ast.EnumMember)}
    callees = {n.callee for n in nodes if isinstance(n, ast.Call)}
    callees |= {n.method for n in nodes if isinstance(n, ast.CallDirective)}
    for node in nodes:
        where = f"{node.span}: {node.span.text}"
        if node in coverage:
            continue  # names of items and units are no expressions there
        if isinstance(node, EXPRESSIONS) and node not in callees and node not in enum_values:
            assert node in model.types, where
        if isinstance(node, NAMES):
            assert node in model.references, where
        if isinstance(node, ast.PhysicalLiteral):
            assert node in model.units, where
        if isinstance(node, CALLS):
            assert node in model.bindings, where
        if isinstance(node, ast.Invocation):
            assert node.behavior in model.references, where
        if isinstance(node, ast.NamedType):
            name = node.name.name
            primitives = ("int", "uint", "float", "bool", "string")
            assert name in model.references or name.text in primitives, where

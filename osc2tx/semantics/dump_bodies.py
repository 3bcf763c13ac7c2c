"""The side tables of the semantic model as text, line by line of the source."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.diagnostics import SourceFile
from osc2tx.semantics.model import Binding, SemanticModel
from osc2tx.semantics.symbols import (
    ActionSymbol,
    EnumMemberSymbol,
    EventSymbol,
    FieldSymbol,
    LabelSymbol,
    MethodSymbol,
    ModifierSymbol,
    ParameterSymbol,
    ScenarioSymbol,
    Symbol,
)
from osc2tx.syntax import ast

Node = ast.Node

LONGEST = 72


def dump_tables(model: SemanticModel, source: SourceFile) -> Iterator[str]:
    """Yield one line for each reference, typed expression, unit and binding of a file."""
    entries: list[tuple[int, int, str, str]] = []
    for node in _nodes_of(model, source):
        text = _describe(model, node)
        if text:
            line = node.span.line
            entries.append((node.span.start, -node.span.end, f"{line}:{node.span.column}", text))
    for _, _, place, text in sorted(entries):
        yield f"{place} {text}"


def _nodes_of(model: SemanticModel, source: SourceFile) -> Iterator[Node]:
    seen: set[Node] = set()
    for table in (model.types, model.references, model.bindings):
        for node in table:
            if node.span.source is source and node not in seen:
                seen.add(node)
                yield node


def _describe(model: SemanticModel, node: Node) -> str | None:
    match node:
        case ast.BoolLiteral() | ast.IntegerLiteral() | ast.FloatLiteral() | ast.StringLiteral():
            return None
        case ast.Name():
            symbol = model.references.get(node)
            return f"{node} -> {describe_symbol(symbol)}" if symbol else None
        case ast.PhysicalLiteral():
            unit = model.units.get(node)
            return f"{_source(node)} : {model.types.get(node)}" if unit else None
        case ast.Invocation() | ast.ModifierApplication() | ast.CallDirective():
            return f"bind {describe_binding(model.bindings[node])}"
        case ast.EmitDirective():
            return f"bind {describe_binding(model.bindings[node])}"
    if node not in model.types or isinstance(node, ast.NamedType | ast.ListType | ast.RangeType):
        return None
    text = f"{_source(node)} : {model.types[node]}"
    if node in model.references:
        text += f" -> {describe_symbol(model.references[node])}"
    if node in model.bindings:
        text += f"; bind {describe_binding(model.bindings[node])}"
    return text


def _source(node: Node) -> str:
    text = " ".join(node.span.text.split())
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 3]}..."


def describe_binding(binding: Binding) -> str:
    """Return a binding as text."""
    receiver = f" on {_source(binding.receiver)}" if binding.receiver is not None else ""
    arguments = ", ".join(f"{p.name}={_source(v)}" for p, v in binding.arguments)
    return f"{describe_symbol(binding.callee)}{receiver} ({arguments})"


def describe_symbol(symbol: Symbol) -> str:
    """Return kind and full name of a symbol."""
    match symbol:
        case EnumMemberSymbol():
            return f"{symbol.enum.name}!{symbol.name}={symbol.value}"
        case FieldSymbol():
            kind = "var" if symbol.is_variable else "field"
            return f"{kind} {symbol.owner.name + '.' if symbol.owner else ''}{symbol.name}"
        case EventSymbol() | MethodSymbol() | LabelSymbol():
            kind = type(symbol).__name__.removesuffix("Symbol").lower()
            return f"{kind} {symbol.owner.name + '.' if symbol.owner else ''}{symbol.name}"
        case ScenarioSymbol() | ActionSymbol() | ModifierSymbol():
            kind = type(symbol).__name__.removesuffix("Symbol").lower()
            return f"{kind} {symbol.qualified_name}"
        case ParameterSymbol():
            return f"parameter {symbol.name}"
        case _:
            kind = type(symbol).__name__.removesuffix("Symbol").lower()
            return f"{kind} {symbol.name}"

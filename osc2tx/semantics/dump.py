"""The semantic model as text, for goldens and `--emit model`."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.diagnostics import SourceFile
from osc2tx.semantics.model import Binding, SemanticModel
from osc2tx.semantics.scope import base_of
from osc2tx.semantics.symbols import (
    ActionSymbol,
    BehaviorSymbol,
    EnumMemberSymbol,
    EnumSymbol,
    EventSymbol,
    FieldSymbol,
    LabelSymbol,
    Member,
    MethodSymbol,
    ModifierSymbol,
    ParameterSymbol,
    PhysicalTypeSymbol,
    ScenarioSymbol,
    Symbol,
    TypeSymbol,
    UnitSymbol,
)
from osc2tx.semantics.types import VOID
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


INDENT = "  "


def dump_model(model: SemanticModel) -> str:
    """Return the symbols of the user's files, then the meaning of each expression and call."""
    lines: list[str] = []
    namespace = None
    for symbol in model.symbols:
        if symbol.namespace != namespace:
            namespace = symbol.namespace
            lines.append(f"namespace {namespace}")
        lines += (INDENT + line for line in _dump_symbol(symbol))
    for file in model.files:
        lines.append(f"file {file.span.source.name}")
        lines += (INDENT + line for line in dump_tables(model, file.span.source))
    return "\n".join(lines) + "\n"


def _dump_symbol(symbol: Symbol) -> Iterator[str]:
    match symbol:
        case PhysicalTypeSymbol():
            yield f"type {symbol.name}: {symbol.dimension}"
        case UnitSymbol():
            yield (
                f"unit {symbol.name} of {symbol.type}: "
                f"factor {symbol.factor!r} offset {symbol.offset!r}"
            )
        case EnumSymbol():
            members = ", ".join(f"{m.name}={m.value}" for m in symbol.members.values())
            yield f"enum {symbol.name}: {members}"
        case FieldSymbol():
            yield f"global {_member(symbol)}"
        case TypeSymbol():
            yield _head(symbol)
            for member in symbol.members.values():
                yield INDENT + _member(member)
        case _:
            yield f"symbol {symbol.name}"


def _head(symbol: TypeSymbol) -> str:
    kind = type(symbol).__name__.removesuffix("Symbol").lower()
    if isinstance(symbol, ModifierSymbol):
        target = f" of {symbol.target.qualified_name}" if symbol.target else ""
        return f"modifier {symbol.qualified_name}{target}"
    base = base_of(symbol)
    derived = f" inherits {_full_name(base)}" if base else ""
    return f"{kind} {_full_name(symbol)}{derived}"


def _full_name(symbol: TypeSymbol) -> str:
    return symbol.qualified_name if isinstance(symbol, BehaviorSymbol) else symbol.name


def _member(member: Member) -> str:
    match member:
        case FieldSymbol():
            return f"{'var ' if member.is_variable else ''}{member.name}: {member.type}"
        case EventSymbol():
            implicit = " implicit" if member.is_implicit else ""
            return f"event {member.name}{_parameters(member.parameters)}{implicit}"
        case MethodSymbol():
            result = "" if member.result == VOID else f" -> {member.result}"
            return f"def {member.name}{_parameters(member.parameters) or '()'}{result}"
        case LabelSymbol():
            return f"label {member.name}: {member.type}"


def _parameters(parameters: tuple[ParameterSymbol, ...]) -> str:
    if not parameters:
        return ""
    return "(" + ", ".join(f"{p.name}: {p.type}" for p in parameters) + ")"

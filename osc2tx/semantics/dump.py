"""The semantic model as text, for goldens and `--emit model`."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.semantics.dump_bodies import dump_tables
from osc2tx.semantics.model import SemanticModel
from osc2tx.semantics.scope import base_of
from osc2tx.semantics.symbols import (
    BehaviorSymbol,
    EnumSymbol,
    EventSymbol,
    FieldSymbol,
    LabelSymbol,
    Member,
    MethodSymbol,
    ModifierSymbol,
    ParameterSymbol,
    PhysicalTypeSymbol,
    Symbol,
    TypeSymbol,
    UnitSymbol,
)
from osc2tx.semantics.types import VOID

INDENT = "  "


def dump_model(model: SemanticModel) -> str:
    """Return the symbols of the user's files, then what each expression and call means."""
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

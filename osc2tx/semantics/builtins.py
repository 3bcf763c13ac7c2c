"""Built-in symbols: life-cycle events, arguments of compositions."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.diagnostics import SourceFile, Span
from osc2tx.semantics.scope import NULL
from osc2tx.semantics.symbols import (
    EnumMemberSymbol,
    EnumSymbol,
    EventSymbol,
    FieldSymbol,
    MethodSymbol,
    ModifierSymbol,
    ParameterSymbol,
    ScenarioSymbol,
)
from osc2tx.semantics.types import (
    BOOL,
    ERROR,
    INT,
    SI_BASES,
    UINT,
    Dimension,
    EnumType,
    ListType,
    PhysicalType,
    RangeType,
    Type,
)
from osc2tx.syntax import ast

SPAN = Span(SourceFile("<built-in>", ""), 0, 0)
BUILTIN = "builtin"

TIME_DIMENSION = Dimension(tuple(int(base == "s") for base in SI_BASES))
TIME = PhysicalType("time", TIME_DIMENSION)


def _enum(name: str, *members: str) -> EnumSymbol:
    symbol = EnumSymbol(name=name, namespace=NULL, span=SPAN, origin=BUILTIN)
    for value, text in enumerate(members):
        symbol.members[text] = EnumMemberSymbol(
            name=text, namespace=NULL, span=SPAN, origin=BUILTIN, enum=symbol, value=value
        )
    return symbol


def _scenario(name: str) -> ScenarioSymbol:
    identifier = ast.Name(span=SPAN, text=name)
    node = ast.ScenarioDeclaration(
        span=SPAN,
        name=ast.BehaviorName(span=SPAN, actor=None, name=identifier),
        base=None,
        condition=None,
        members=(),
    )
    return ScenarioSymbol(name=name, namespace=NULL, span=SPAN, origin=BUILTIN, node=node)


def builtin_field(name: str, type_: Type) -> FieldSymbol:
    """Make a field without a declaration."""
    return FieldSymbol(name=name, namespace=NULL, span=SPAN, origin=BUILTIN, owner=None, type=type_)


DURATION = builtin_field("duration", TIME)
LIFE_CYCLE: Mapping[str, EventSymbol] = {
    name: EventSymbol(name=name, namespace=NULL, span=SPAN, origin=BUILTIN, owner=None)
    for name in ("start", "end", "fail")
}

BEHAVIOR = _scenario("behavior")
"""The type of `it` in a modifier for any behavior."""

COMPOSITION = _scenario("composition")
DIRECTIVE = _scenario("directive")
"""The types of labels of compositions and of `wait`, `emit`, `call`."""

OVERLAP = _enum("overlap", "equal", "start", "end", "initial", "final", "inside", "full", "any")
OVERRIDE_MODE = _enum("override_mode", "on_start", "when_active")

COMPOSITION_FIELDS: Mapping[str, FieldSymbol] = {
    "duration": DURATION,
    "overlap": builtin_field("overlap", EnumType(OVERLAP)),
    "start_to_start": builtin_field("start_to_start", TIME),
    "end_to_end": builtin_field("end_to_end", TIME),
}


def _override() -> ModifierSymbol:
    """The modifier `override(overridden, by, mode)` of the language (§7.3.12.1.1)."""
    identifier = ast.Name(span=SPAN, text="override")
    node = ast.ModifierDeclaration(
        span=SPAN,
        name=ast.BehaviorName(span=SPAN, actor=None, name=identifier),
        behavior=None,
        members=(),
    )
    symbol = ModifierSymbol(name="override", namespace=NULL, span=SPAN, origin=BUILTIN, node=node)
    for name, type_ in (
        ("overridden", ERROR),
        ("by", ERROR),
        ("mode", EnumType(OVERRIDE_MODE)),
    ):
        symbol.members[name] = builtin_field(name, type_)
    return symbol


OVERRIDE = _override()


def _method(name: str, result: Type, parameter: Type | None = None) -> MethodSymbol:
    parameters = (
        (ParameterSymbol(name="element", namespace=NULL, span=SPAN, type=parameter),)
        if parameter is not None
        else ()
    )
    return MethodSymbol(
        name=name,
        namespace=NULL,
        span=SPAN,
        origin=BUILTIN,
        owner=None,
        parameters=parameters,
        result=result,
    )


LIST_METHODS: Mapping[str, MethodSymbol] = {
    "size": _method("size", UINT),
    "filter": _method("filter", ERROR, BOOL),
    "first_index": _method("first_index", INT, BOOL),
    "count": _method("count", UINT, BOOL),
    "has": _method("has", BOOL, BOOL),
    "map": _method("map", ERROR, ERROR),
}
"""Operators of lists (§7.4.2.7); their argument is evaluated per element, which is `it`."""

RANGE_METHODS: Mapping[str, MethodSymbol] = {
    "lower": _method("lower", ERROR),
    "upper": _method("upper", ERROR),
}
"""Operators of ranges (2.2); the result is the type of the bounds."""


def list_method_result(name: str, receiver: ListType, argument: Type) -> Type:
    """Return the result type of a list operator."""
    match name:
        case "filter":
            return receiver
        case "map":
            return ERROR if argument == ERROR else ListType(argument)
        case _:
            return LIST_METHODS[name].result


def range_method_result(receiver: RangeType) -> Type:
    """Return the result type of `lower()` and `upper()`."""
    return receiver.element

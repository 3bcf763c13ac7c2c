"""Types and units as the IR has them."""

from __future__ import annotations

import math
from collections.abc import Iterable

from osc2tx import ir
from osc2tx.semantics import SemanticModel, types
from osc2tx.semantics import symbols as sym

PRIMITIVES = {
    name: ir.ValueType(kind, name)
    for name, kind in (
        ("bool", ir.Kind.BOOL),
        ("int", ir.Kind.INTEGER),
        ("uint", ir.Kind.INTEGER),
        ("float", ir.Kind.FLOAT),
        ("string", ir.Kind.STRING),
    )
}
BOOL = PRIMITIVES["bool"]
SCENARIO = ir.ValueType(ir.Kind.STRUCT, "scenario")

# Sorts of values that a setting of a run can give.
PLAIN = frozenset(
    {ir.Kind.BOOL, ir.Kind.INTEGER, ir.Kind.FLOAT, ir.Kind.STRING, ir.Kind.QUANTITY, ir.Kind.ENUM}
)


def lower_type(type_: types.Type) -> ir.ValueType:
    """Return the IR's view of a type."""
    match type_:
        case types.PrimitiveType(name=name):
            return PRIMITIVES[name]
        case types.PhysicalType():
            return ir.ValueType(ir.Kind.QUANTITY, str(type_))
        case types.EnumType(symbol=enum):
            return ir.ValueType(ir.Kind.ENUM, str(type_), members=_own_members(enum))
        case types.ActorType():
            return ir.ValueType(ir.Kind.ACTOR, str(type_))
        case types.ListType(element=element):
            return ir.ValueType(ir.Kind.LIST, str(type_), lower_type(element))
        case types.RangeType(element=element):
            return ir.ValueType(ir.Kind.RANGE, str(type_), lower_type(element))
        case _:
            return ir.ValueType(ir.Kind.STRUCT, str(type_))


def _own_members(enum: sym.EnumSymbol) -> tuple[str, ...]:
    """Return the members of an enum that is not completely in the library.

    Members of equal value are one member with the first name, as in `ir.EnumValue`.
    """
    if all(member.origin == "library" for member in enum.members.values()):
        return ()
    return tuple({m.value: m.name for m in reversed(enum.members.values())}.values())[::-1]


def lower_unit(unit: sym.UnitSymbol) -> ir.Unit:
    """Return the IR's view of a unit."""
    return ir.Unit(unit.name, unit.factor, unit.offset, is_standard=unit.origin == "library")


def number_in(unit: sym.UnitSymbol, si: float) -> int | float:
    """Return how many of a unit a value in SI is; a whole number as such.

    Ten digits, where they are the value but for rounding: `x == 80kph` must hold of 80 km/h in m/s.
    """
    exact = (si - unit.offset) / unit.factor
    short = float(f"{exact:.10g}")
    number = short if math.isclose(short, exact, rel_tol=1e-14) else exact
    return int(number) if number.is_integer() else number


def authored_unit(
    model: SemanticModel, type_: ir.ValueType, written: Iterable[ir.Expression | None]
) -> ir.Unit | None:
    """Return the unit of the first literal of the type; without one the SI unit of the library.

    Args:
        model: Knows the units.
        type_: Type of the parameter.
        written: The text in the source.

    Returns:
        `None` if it has no unit: it is no physical type, or one of the user without a literal.
    """
    if type_.kind is not ir.Kind.QUANTITY:
        return None
    for expression in written:
        for part in ir.walk(expression) if expression is not None else ():
            if isinstance(part, ir.Quantity) and part.type == type_:
                return part.unit
    plain = (unit for unit in model.known_units if (unit.factor, unit.offset) == (1.0, 0.0))
    found = [unit for unit in plain if str(unit.type) == type_.name and unit.origin == "library"]
    return lower_unit(min(found, key=lambda unit: len(unit.name))) if found else None

"""Types and units as the IR has them."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types

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
    """Return the members of an enum that the library does not have, or not all of them.

    Members of one value are one: the first name stands for it, as in `ir.EnumValue`.
    """
    if all(member.origin == "library" for member in enum.members.values()):
        return ()
    return tuple({m.value: m.name for m in reversed(enum.members.values())}.values())[::-1]


def lower_unit(unit: sym.UnitSymbol) -> ir.Unit:
    """Return the IR's view of a unit."""
    return ir.Unit(unit.name, unit.factor, unit.offset, is_standard=unit.origin == "library")


def number_in(unit: sym.UnitSymbol, si: float) -> int | float:
    """Return how many of a unit a value in SI is, to ten digits; a whole number as such."""
    number = float(f"{(si - unit.offset) / unit.factor:.10g}")
    return int(number) if number.is_integer() else number

"""The unit in which a source speaks of a parameter."""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx import ir
from osc2tx.lowering.value_types import lower_unit
from osc2tx.semantics import SemanticModel

__all__ = ["authored_unit"]


def authored_unit(
    model: SemanticModel, type_: ir.ValueType, written: Iterable[ir.Expression | None]
) -> ir.Unit | None:
    """Return the unit of the first literal of the type; without one the SI unit of the library.

    Args:
        model: Knows the units.
        type_: Type of the parameter.
        written: What the source says of it.

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

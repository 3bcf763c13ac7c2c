"""Conversion of authored values to SI (§7.3.4).

The library's units are converted with the factor and offset of their declaration, which a test
compares with pint. Units that a program declares are converted by pint, which also checks the
declaration. Its registry starts empty: only declared units exist, and the plane angle is a
dimension of its own, as in the language. pint is slow to import, so it is loaded on first use.
"""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING

from osc2tx.diagnostics import InternalCompilerError
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.symbols import UnitSymbol
from osc2tx.semantics.types import SI_BASES, Dimension, PhysicalType
from osc2tx.syntax import ast

if TYPE_CHECKING:
    import pint


LARGEST, SMALLEST = 1e15, 1e-30
"""Sizes of a quantity in SI units: products and quotients of several stay numbers."""


def is_measurable(factor: float, offset: float) -> bool:
    """Whether quantities in a unit of this factor and offset stay numbers in SI units."""
    return SMALLEST <= abs(factor) <= LARGEST and abs(offset) <= LARGEST


def constant_number(r: Resolution, expression: ast.Expression) -> float | None:
    """Return the value of a number, in SI if it has a unit; `None` for anything else."""
    sign = 1
    if isinstance(expression, ast.Unary) and expression.operator is ast.UnaryOperator.NEGATE:
        sign, expression = -1, expression.operand
    match expression:
        case ast.IntegerLiteral(value=value) | ast.FloatLiteral(value=value):
            return sign * value
        case ast.PhysicalLiteral(value=value) if unit := r.units.get(expression):
            return to_si(sign * value, unit)  # the sign belongs to the literal: -3 celsius
        case _:
            return None


_BASES = {base: f"si_{base}" for base in SI_BASES}


def to_si(value: float, unit: UnitSymbol) -> float:
    """Return a value of a unit in SI base units: `value * factor + offset`.

    pint takes no unit whose declaration is an error (OSC516), and no value that is not finite.
    """
    is_sound = math.isfinite(value) and is_measurable(unit.factor, unit.offset)
    if unit.origin != "user" or not is_sound:
        return value * unit.factor + unit.offset
    return to_si_with_pint(value, unit)


def to_si_with_pint(value: float, unit: UnitSymbol) -> float:
    """Return the same, computed by pint."""
    registry = _registry()
    if not isinstance(unit.type, PhysicalType):
        raise InternalCompilerError(f"unit {unit.name} has no physical type")
    name = _define(registry, unit.factor, unit.offset, unit.type.dimension)
    quantity = registry.Quantity(value, name).to_base_units()
    return float(quantity.magnitude)


@cache
def _registry() -> pint.UnitRegistry[float]:
    """Return a registry that knows the SI base units and nothing else."""
    import pint

    registry: pint.UnitRegistry[float] = pint.UnitRegistry(None)
    for base, name in _BASES.items():
        registry.define(f"{name} = [osc_{base}]")
    return registry


@cache
def _define(
    registry: pint.UnitRegistry[float], factor: float, offset: float, dimension: Dimension
) -> str:
    """Define a unit under a name of our own: authored names need not suit pint."""
    powers = zip(SI_BASES, dimension.exponents, strict=True)
    product = "".join(f" * {_BASES[base]} ** {power}" for base, power in powers if power)
    name = f"osc_unit_{_define.cache_info().currsize}"
    shift = f"; offset: {offset!r}" if offset else ""
    registry.define(f"{name} = {factor!r}{product}{shift}")
    return name

"""Numbers written in the text as literals."""

from __future__ import annotations

from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.units import to_si
from osc2tx.syntax import ast


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

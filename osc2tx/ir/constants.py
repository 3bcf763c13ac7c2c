"""Values known at compile time: numbers and quantities in SI units."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping

from osc2tx.ir.expressions import Binary, Expression, Literal, Quantity, Unary

OPERATIONS: Mapping[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}


def constant(expression: Expression) -> float | None:
    """Return the value of an expression of numbers alone; `None` if it has others in it."""
    values: list[float] = []
    for part in _postfix(expression):
        match part:
            case Literal(value=int() | float() as value) if not isinstance(value, bool):
                values.append(value)
            case Quantity():
                values.append(part.si)
            case Unary(operator="-"):
                values.append(-values.pop())
            case Binary(operator=sign) if sign in OPERATIONS:
                right, left = values.pop(), values.pop()
                if sign == "/" and right == 0.0:
                    return None
                values.append(OPERATIONS[sign](left, right))
            case _:
                return None
    return values[0]


def _postfix(expression: Expression) -> list[Expression]:
    """Return the parts, operands before operators; without recursion, for chains are long."""
    ordered: list[Expression] = []
    pending = [expression]
    while pending:
        current = pending.pop()
        ordered.append(current)
        match current:
            case Unary(operand=operand):
                pending.append(operand)
            case Binary(left=left, right=right):
                pending.extend((left, right))
            case _:
                pass
    ordered.reverse()
    return ordered

"""Differences of dates: `environment.datetime - t0` needs no date if `t0` is the same one.

The date of an environment is that of the start of the scenario (§8.10.2), a constant. Where a sum
or comparison adds it as often as it takes it away, its value does not matter and may be left open.
"""

from __future__ import annotations

from collections import Counter

from osc2tx import ir

DATE = ("environment", "datetime")
COMPARISONS = frozenset({"==", "!=", "<", "<=", ">", ">="})


def without_dates(expression: ir.Binary) -> ir.Expression:
    """Return a sum or comparison without the dates that cancel out."""
    if expression.operator not in COMPARISONS | {"+", "-"}:
        return expression
    totals: Counter[str] = Counter()
    _count(expression, 1, totals)
    if not totals or any(totals.values()):
        return expression
    return ir.rewrite(expression, _zero)


def _count(part: ir.Expression, sign: int, totals: Counter[str]) -> None:
    match part:
        case ir.Binary(operator="+", left=left, right=right):
            _count(left, sign, totals)
            _count(right, sign, totals)
        case ir.Binary(operator=operator, left=left, right=right) if (
            operator == "-" or operator in COMPARISONS
        ):
            _count(left, sign, totals)
            _count(right, -sign, totals)
        case ir.Unary(operator="-", operand=operand):
            _count(operand, -sign, totals)
        case ir.Attribute(base=ir.FieldRef(name=name)) if _is_date(part):
            totals[name] += sign
        case _ if holds_date(part):
            totals["elsewhere"] += 1


def holds_date(part: ir.Expression) -> bool:
    """Whether the date of an environment is read anywhere in an expression."""
    return any(_is_date(inner) for inner in ir.walk(part))


def _is_date(part: ir.Expression) -> bool:
    return isinstance(part, ir.Attribute) and (part.owner, part.name) == DATE


def _zero(part: ir.Expression) -> ir.Expression | None:
    return ir.Literal(span=part.span, type=part.type, value=0.0) if _is_date(part) else None

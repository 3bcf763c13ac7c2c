"""Arithmetic on the times of a `do` tree: sums, rests, bounds, and how messages show them."""

from __future__ import annotations

from functools import reduce
from math import isinf
from typing import TypeAlias

from osc2tx import ir
from osc2tx.lowering.value_types import BOOL, PRIMITIVES, lower_type
from osc2tx.semantics import types
from osc2tx.semantics.builtins import TIME
from osc2tx_shared.classes import replace

SLACK = 1e-9  # s

TIMES = lower_type(types.RangeType(TIME))

Terms: TypeAlias = tuple[ir.Expression, ...]
"""Times that add up to a length."""

Times: TypeAlias = tuple[float, float]
"""Least and most seconds."""


def is_range(duration: ir.Expression | None) -> bool:
    """Return whether a duration is a range."""
    return duration is not None and duration.type.kind is ir.Kind.RANGE


def ends_of(time: ir.Expression) -> tuple[ir.Expression | None, ir.Expression | None]:
    """Return the bounds of a range, `None` for an open one; of a time, the time twice."""
    match time:
        case ir.RangeValue(lower=lower, upper=upper):
            return lower, upper
        case ir.HalfRange(bound=bound, is_lower=is_lower):
            return (bound, None) if is_lower else (None, bound)
        case _:
            return time, time


def lies_within(found: Times | None, wanted: Times | None) -> bool:
    """Return whether times are known to lie within others."""
    if found is None or wanted is None:
        return False
    return wanted[0] - SLACK <= found[0] and found[1] <= wanted[1] + SLACK


def resolved(
    expression: ir.Expression, values: dict[str, ir.Expression], depth: int = 0
) -> ir.Expression:
    """Return an expression with computed parameters replaced by their definitions."""

    def computed(part: ir.Expression) -> ir.Expression | None:
        value = values.get(part.name) if isinstance(part, ir.FieldRef) else None
        if value is None or isinstance(value, ir.RangeValue | ir.HalfRange | ir.Choices):
            return None
        return resolved(value, values, depth + 1) if depth < len(values) else None

    return ir.rewrite(expression, computed)


def names_in(terms: Terms) -> set[str]:
    """Return the names of the fields that terms read."""
    parts = [part for term in terms for part in ir.walk(term)]
    return {part.name for part in parts if isinstance(part, ir.FieldRef)}


def sum_of(terms: Terms) -> ir.Expression:
    """Return the sum of times."""
    return reduce(lambda left, right: _binary("+", left, right), terms)


def rest_of(whole: ir.Expression, others: Terms) -> ir.Expression:
    """Return the rest of a whole without other times."""
    return reduce(lambda left, right: _binary("-", left, right), others, whole)


def part_of(whole: ir.Expression, count: int) -> ir.Expression:
    """Return one of several equal parts of a time."""
    if count == 1:
        return whole
    divisor = ir.Literal(span=whole.span, type=PRIMITIVES["uint"], value=count)
    return _binary("/", whole, divisor)


def solved_for(name: str, terms: Terms, whole: ir.Expression) -> ir.Expression | None:
    """Return the value of a field with which times add up to a whole, given the rest.

    `None` if it does not occur in them, or not in a linear way.
    """
    shares = [(-1.0, whole), *((1.0, term) for term in terms)]
    factor = 0.0
    rest: ir.Expression | None = None
    for sign, term in shares:
        found = _linear(name, term)
        if found is None:
            return None
        factor += sign * found[0]
        if found[1] is not None:
            zero = time_like(0.0, found[1]) if rest is None and sign > 0 else rest
            rest = found[1] if zero is None else _binary("-" if sign > 0 else "+", zero, found[1])
    if not factor or rest is None:
        return None
    divisor = ir.Literal(span=whole.span, type=PRIMITIVES["float"], value=factor)
    return rest if factor == 1.0 else replace(_binary("/", rest, divisor), type=whole.type)


def _linear(name: str, expression: ir.Expression) -> tuple[float, ir.Expression | None] | None:
    """Return the factor of a field in an expression, and the rest of it."""
    match expression:
        case _ if name not in names_in((expression,)):
            return 0.0, expression
        case ir.FieldRef():
            return 1.0, None
        case ir.Binary(operator="+" | "-" as sign, left=left, right=right):
            one, other = _linear(name, left), _linear(name, right)
            if one is None or other is None:
                return None
            factor = one[0] + (other[0] if sign == "+" else -other[0])
            if other[1] is None:
                return factor, one[1]
            if one[1] is None and sign == "+":
                return factor, other[1]
            first = time_like(0.0, other[1]) if one[1] is None else one[1]
            return factor, _binary(sign, first, other[1])
        case ir.Binary(operator="*", left=left, right=right) if isinstance(left, ir.Literal):
            return _scaled(_linear(name, right), "*", left)
        case ir.Binary(operator="*" | "/" as sign, left=left, right=right) if isinstance(
            right, ir.Literal
        ):
            return _scaled(_linear(name, left), sign, right)
        case _:
            return None


def _scaled(
    found: tuple[float, ir.Expression | None] | None, sign: str, by: ir.Literal
) -> tuple[float, ir.Expression | None] | None:
    if found is None or not isinstance(by.value, int | float) or (sign == "/" and not by.value):
        return None
    factor, rest = found
    scaled = factor * by.value if sign == "*" else factor / by.value
    return scaled, None if rest is None else _binary(sign, rest, by)


def about(time: ir.Expression) -> ir.RangeValue:
    """Return the range around a time that allows for the rounding of sums."""
    slack = ir.Literal(span=time.span, type=time.type, value=SLACK)
    lower, upper = (_binary(sign, time, slack) for sign in "-+")
    return ir.RangeValue(span=time.span, type=time.type, lower=lower, upper=upper)


def _binary(operator: str, left: ir.Expression, right: ir.Expression) -> ir.Binary:
    return ir.Binary(span=left.span, type=left.type, operator=operator, left=left, right=right)


def at_least(time: ir.Expression) -> ir.HalfRange:
    """Return the range of times from one on."""
    return ir.HalfRange(span=time.span, type=TIMES, bound=time, is_lower=True)


def at_most(time: ir.Expression) -> ir.HalfRange:
    """Return the range of times up to one."""
    return ir.HalfRange(span=time.span, type=TIMES, bound=time, is_lower=False)


def range_between(
    low: ir.Expression | None, high: ir.Expression | None
) -> ir.RangeValue | ir.HalfRange:
    """Return the range of times between two, of which one may be missing."""
    if low is not None and high is not None:
        return ir.RangeValue(span=low.span, type=TIMES, lower=low, upper=high)
    if low is not None:
        return at_least(low)
    assert high is not None
    return at_most(high)


def greater_of(one: ir.Expression, other: ir.Expression) -> ir.Expression:
    """Return the greater one of two times."""
    test = ir.Binary(span=one.span, type=BOOL, operator=">=", left=one, right=other)
    return ir.Conditional(
        span=one.span, type=one.type, condition=test, when_true=one, when_false=other
    )


def with_duration(
    members: tuple[ir.Behavior, ...], index: int, duration: ir.Expression
) -> tuple[ir.Behavior, ...]:
    """Return members of which one has another duration."""
    member = members[index]
    assert isinstance(member, ir.Invoke | ir.Serial | ir.Parallel | ir.OneOf)
    return (*members[:index], replace(member, duration=duration), *members[index + 1 :])


def time_like(seconds: float, like: ir.Expression) -> ir.Expression:
    """Return a time, in the unit of another one."""
    if isinstance(like, ir.Quantity) and not like.unit.offset:
        value = round(seconds / like.unit.factor, 12)
        return replace(like, value=value)
    return ir.Literal(span=like.span, type=like.type, value=seconds)


def shown(times: Times | None) -> str:
    """Return times as messages show them."""
    if times is None:
        return "a time"
    low, high = times
    if isinf(high):
        return f"at least {low:g} s"
    return f"{low:g} s" if low == high else f"{low:g} s to {high:g} s"

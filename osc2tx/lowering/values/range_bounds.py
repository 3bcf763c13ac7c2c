"""Ranges by their bounds."""

from __future__ import annotations

from osc2tx import ir


def with_bounds(value: ir.Expression) -> ir.Expression:
    """Return a value; a range of any origin by its bounds (§7.3.5.2.2)."""
    lower: ir.Expression
    upper: ir.Expression
    match value:
        case ir.RangeValue() | ir.HalfRange() | ir.Choices():
            return value
        case ir.Conditional(condition=condition, when_true=one, when_false=other) if isinstance(
            first := with_bounds(one), ir.RangeValue
        ) and isinstance(second := with_bounds(other), ir.RangeValue):
            ends = (first.lower, second.lower), (first.upper, second.upper)
            lower, upper = (
                ir.Conditional(
                    span=value.span, type=a.type, condition=condition, when_true=a, when_false=b
                )
                for a, b in ends
            )
        case _ if value.type.kind is ir.Kind.RANGE:
            lower, upper = (_end_of(value, which) for which in ("lower", "upper"))
        case _:
            return value
    return ir.RangeValue(span=value.span, type=value.type, lower=lower, upper=upper)


def _end_of(range_: ir.Expression, which: str) -> ir.MethodCall:
    assert range_.type.element is not None
    return ir.MethodCall(
        span=range_.span,
        type=range_.type.element,
        base=range_,
        owner="range",
        method=which,
        arguments=(),
        is_pure=True,
    )

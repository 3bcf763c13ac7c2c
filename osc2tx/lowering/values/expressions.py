"""Expressions: names become references to their meanings, types become plain data."""

from __future__ import annotations

from typing import assert_never

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import lower_type, lower_unit
from osc2tx.lowering.values.calls import lower_call
from osc2tx.lowering.values.references import element_of, lower_key, lower_member, lower_name
from osc2tx.lowering.values.type_conversions import (
    holds_date,
    lower_cast,
    lower_type_test,
    without_dates,
)
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace


def lower_expression(ctx: LoweringContext, node: ast.Expression) -> ir.Expression | None:
    """Lower an expression; `None` if a part of it was refused."""
    span, type_ = node.span, lower_type(ctx.model.type_of(node))
    match node:
        case ast.StringLiteral() if node in ctx.model.quantities:
            return lower_expression(ctx, ctx.model.quantities[node])
        case (
            ast.BoolLiteral(value=value)
            | ast.IntegerLiteral(value=value)
            | ast.FloatLiteral(value=value)
            | ast.StringLiteral(value=value)
        ):
            return ir.Literal(span=span, type=type_, value=value)
        case ast.PhysicalLiteral(value=number):
            unit = lower_unit(ctx.model.units[node])
            return ir.Quantity(span=span, type=type_, value=number, unit=unit)
        case ast.EnumLiteral() | ast.NameExpression():
            return lower_name(ctx, node, type_)
        case ast.MemberAccess(base=base, name=name):
            return lower_member(ctx, node, base, name, type_)
        case ast.Call():
            return lower_call(ctx, node)
        case ast.Cast():
            return lower_cast(ctx, node)
        case ast.TypeTest():
            return lower_type_test(ctx, node)
        case ast.Index() if (object_ := element_of(ctx, node)) is not None:
            return object_
        case ast.Index(base=base, index=index):
            lowered, which = lower_expression(ctx, base), lower_expression(ctx, index)
            if lowered is None or which is None:
                return None
            return ir.Index(span=span, type=type_, base=lowered, index=which)
        case ast.Unary(operator=operator, operand=operand):
            inner = lower_expression(ctx, operand)
            if inner is None:
                return None
            if isinstance(inner, ir.Quantity) and inner.unit.offset and _is_sign(node, operand):
                return replace(inner, span=span, value=-inner.value)  # -3 degrees, not -276 K
            return ir.Unary(span=span, type=type_, operator=operator.value, operand=inner)
        case ast.Binary():
            return _lower_binary(ctx, node)
        case ast.Conditional():
            return _lower_conditional(ctx, node, type_)
        case ast.ListLiteral(elements=elements):
            parts: list[ir.Expression] = []
            for element in elements:
                part = lower_expression(ctx, element)
                if part is None:
                    return None
                parts.extend(part.elements if isinstance(part, ir.ListValue) else [part])
            return ir.ListValue(span=span, type=type_, elements=tuple(parts))
        case ast.RangeLiteral(lower=lower, upper=upper):
            bounds = lower_expression(ctx, lower), lower_expression(ctx, upper)
            if bounds[0] is None or bounds[1] is None:
                return None
            return ordered_range(span, type_, bounds[0], bounds[1])
        case ast.ItExpression() if ctx.it is not None:
            return replace(ctx.it, span=span)
        case ast.ItExpression() if ctx.place is not None and ctx.place.it is not None:
            return lower_key(ctx, ctx.place.it, span)
        case ast.ItExpression():
            return ir.ScenarioSelf(span=span, type=type_)
        case _:
            assert_never(node)


def ordered_range(
    span: Span, type_: ir.ValueType, one: ir.Expression, other: ir.Expression
) -> ir.RangeValue:
    """Return a range, the lower bound first if both are known (§7.4.2.8)."""
    first, second = ir.constant(one), ir.constant(other)
    if first is not None and second is not None and second < first:
        one, other = other, one
    return ir.RangeValue(span=span, type=type_, lower=one, upper=other)


def _is_sign(node: ast.Unary, operand: ast.Expression) -> bool:
    """Return whether a minus directly precedes a number, so that it belongs to the literal."""
    is_minus = node.operator is ast.UnaryOperator.NEGATE
    return is_minus and operand.span.start == node.span.start + 1


LOGICAL = (ast.BinaryOperator.AND, ast.BinaryOperator.OR, ast.BinaryOperator.IMPLIES)


def _lower_binary(ctx: LoweringContext, node: ast.Binary) -> ir.Expression | None:
    """Lower a chain of operators; its left spine may be long, so it is walked in a loop."""
    spine = [node]
    while isinstance(spine[-1].left, ast.Binary):
        spine.append(spine[-1].left)
    left = lower_expression(ctx, spine[-1].left)
    has_dates = left is not None and holds_date(left)
    for current in reversed(spine):
        right = lower_expression(ctx, current.right)
        if left is None or right is None:
            return None
        # Dates cancel out in sums and comparisons alone; a chain of `=>` is as deep as it is long.
        is_logical = current.operator in LOGICAL
        has_dates = not is_logical and (has_dates or holds_date(right))
        known = _known_logic(current.operator, left, right)
        if known is not None:
            left = known
            continue
        combined = ir.Binary(
            span=current.span,
            type=lower_type(ctx.model.type_of(current)),
            operator=current.operator.value,
            left=left,
            right=right,
        )
        left = without_dates(combined) if has_dates else combined
    return left


def _known_logic(
    operator: ast.BinaryOperator, left: ir.Expression, right: ir.Expression
) -> ir.Expression | None:
    """Return the value of `and` or `or` if one side is known at compile time, such as `.is(T)`."""
    if operator not in (ast.BinaryOperator.AND, ast.BinaryOperator.OR):
        return None
    decisive = operator is ast.BinaryOperator.OR
    for side, other in ((left, right), (right, left)):
        if isinstance(side, ir.Literal) and isinstance(side.value, bool):
            return side if side.value is decisive else other
    return None


def _lower_conditional(
    ctx: LoweringContext, node: ast.Conditional, type_: ir.ValueType
) -> ir.Expression | None:
    condition = lower_expression(ctx, node.condition)
    when_true = lower_expression(ctx, node.when_true)
    when_false = lower_expression(ctx, node.when_false)
    if condition is None or when_true is None or when_false is None:
        return None
    return ir.Conditional(
        span=node.span, type=type_, condition=condition, when_true=when_true, when_false=when_false
    )

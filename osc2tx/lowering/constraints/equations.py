"""Solves equalities for one parameter: `a + b == 10m` is `b = 10m - a`."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.analysis.tree_walk import nodes_below
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import types
from osc2tx.syntax import ast

Op = ast.BinaryOperator

# Operator, with the unknown on its left: the inverse operation on the other side.
LEFT = {Op.ADD: Op.SUBTRACT, Op.SUBTRACT: Op.ADD, Op.MULTIPLY: Op.DIVIDE, Op.DIVIDE: Op.MULTIPLY}
# The same with the unknown on its right, where that is one step: `k - x == e` is `x == k - e`.
RIGHT = {Op.ADD: Op.SUBTRACT, Op.MULTIPLY: Op.DIVIDE}
RIGHT_SWAPPED = {Op.SUBTRACT: Op.SUBTRACT, Op.DIVIDE: Op.DIVIDE}


def solve_for(
    ctx: LoweringContext, node: ast.Expression, constraint: Constraint, key: Key
) -> ir.Expression | None:
    """Return the value of a parameter for which an equality holds; `None` if it is not simple.

    Only reals are solved for, and only if the parameter occurs once, below the four operators of
    arithmetic.
    """
    if not isinstance(node, ast.Binary) or node.operator is not Op.EQUAL:
        return None
    sides = [side for side in (node.left, node.right) if _occurrences(side, constraint, key)]
    if len(sides) != 1 or _occurrences(sides[0], constraint, key) > 1:
        return None
    unknown, known = sides[0], node.right if sides[0] is node.left else node.left
    result = lower_expression(ctx, known)
    while result is not None and constraint.place.locate(unknown) != key:
        if not isinstance(unknown, ast.Binary) or unknown.operator not in LEFT:
            return None
        if not _is_real(ctx.model.type_of(unknown)):
            return None
        if _occurrences(unknown.left, constraint, key):
            other = lower_expression(ctx, unknown.right)
            result = _binary(ctx, unknown.left, LEFT[unknown.operator], result, other)
            unknown = unknown.left
        else:
            other = lower_expression(ctx, unknown.left)
            if unknown.operator in RIGHT:
                result = _binary(ctx, unknown.right, RIGHT[unknown.operator], result, other)
            else:
                operator = RIGHT_SWAPPED[unknown.operator]
                result = _binary(ctx, unknown.right, operator, other, result)
            unknown = unknown.right
    return result if _is_real(ctx.model.type_of(unknown)) else None


def _occurrences(node: ast.Expression, constraint: Constraint, key: Key) -> int:
    return sum(
        constraint.place.locate(part) == key
        for part in nodes_below(node)
        if isinstance(part, ast.NameExpression | ast.MemberAccess | ast.ItExpression)
    )


def _is_real(type_: types.Type) -> bool:
    return isinstance(type_, types.PhysicalType) or type_ == types.FLOAT


def _binary(
    ctx: LoweringContext,
    node: ast.Expression,
    operator: Op,
    left: ir.Expression | None,
    right: ir.Expression | None,
) -> ir.Binary | None:
    if left is None or right is None:
        return None
    type_ = lower_type(ctx.model.type_of(node))
    return ir.Binary(span=left.span, type=type_, operator=operator.value, left=left, right=right)

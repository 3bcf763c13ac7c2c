"""Entry of type inference: one type for each expression, kept in a side table."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from osc2tx.semantics.expressions import access, literals, names, operators
from osc2tx.semantics.expressions.methods import infer_call
from osc2tx.semantics.resolution import Environment, Resolution
from osc2tx.semantics.types import BOOL, FLOAT, STRING, UINT, Type
from osc2tx.syntax import ast


def infer(
    r: Resolution, expression: ast.Expression, env: Environment, expected: Type | None = None
) -> Type:
    """Return the type of an expression; `expected` decides the enum of a member without one.

    Long chains (`a + b + …`, `not not …`) are typed from their far end in a loop, so that their
    length does not matter to the Python stack.
    """
    known = r.types.get(expression)
    if known is not None:
        return known
    if isinstance(expression, _CHAINED):
        for inner in reversed(list(_spine(expression))):
            if inner not in r.types:
                r.types[inner] = _infer_one(r, inner, env, None)
    type_ = _infer_one(r, expression, env, expected)
    r.types[expression] = type_
    return type_


def _spine(expression: ast.Expression) -> Iterator[ast.Expression]:
    """Yield the operands below an expression that are chains themselves, outermost first."""
    current: ast.Expression | None = _next_in_chain(expression)
    while current is not None:
        yield current
        current = _next_in_chain(current)


def _next_in_chain(expression: ast.Expression) -> ast.Expression | None:
    match expression:
        case ast.Binary(operator=ast.BinaryOperator.IMPLIES):
            following: ast.Expression = expression.right
        case ast.Binary():
            following = expression.left
        case ast.Unary():
            following = expression.operand
        case ast.MemberAccess() | ast.Cast() | ast.TypeTest() | ast.Index():
            following = expression.base
        case ast.Call(callee=ast.MemberAccess() as callee):
            following = callee.base
        case _:
            return None
    return following if isinstance(following, _CHAINED) else None


_CHAINED = (
    *(ast.Binary, ast.Unary, ast.MemberAccess),
    *(ast.Cast, ast.TypeTest, ast.Index, ast.Call),
)


def _infer_one(
    r: Resolution, expression: ast.Expression, env: Environment, expected: Type | None
) -> Type:
    match expression:
        case ast.BoolLiteral():
            return BOOL
        case ast.IntegerLiteral():
            return UINT
        case ast.FloatLiteral():
            return FLOAT
        case ast.StringLiteral():
            return STRING
        case ast.PhysicalLiteral():
            return literals.infer_physical(r, expression)
        case ast.EnumLiteral():
            return names.infer_enum_literal(r, expression, env)
        case ast.NameExpression():
            return names.infer_name(r, expression, env, expected)
        case ast.ItExpression():
            return names.infer_it(r, expression, env)
        case ast.MemberAccess():
            return access.infer_member(r, expression, env)
        case ast.Cast():
            return access.infer_cast(r, expression, env)
        case ast.TypeTest():
            return access.infer_type_test(r, expression, env)
        case ast.Index():
            return access.infer_index(r, expression, env)
        case ast.Call():
            return infer_call(r, expression, env)
        case ast.Unary():
            return operators.infer_unary(r, expression, env)
        case ast.Binary():
            return operators.infer_binary(r, expression, env)
        case ast.Conditional():
            return operators.infer_conditional(r, expression, env, expected)
        case ast.ListLiteral():
            return literals.infer_list(r, expression, env, expected)
        case ast.RangeLiteral():
            return literals.infer_range(r, expression, env, expected)
        case _:
            assert_never(expression)

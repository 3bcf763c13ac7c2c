"""What `keep` fixes or bounds (§7.3.11), for the values a module writes down.

Only two forms have an effect that needs no solver: an equality and a range, each with a path
alone on its left side. Any other form is refused, never ignored.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.expressions import lower_expression
from osc2tx.syntax import ast

Operator = ast.BinaryOperator


@dataclass(frozen=True, slots=True)
class Bound:
    """One equality or range constraint.

    Attributes:
        root: The field it is about; `None` if the path starts at `it`.
        path: What follows the root.
        value: The value, or a range.
        is_default: Declared with `default`, so that it may be overridden.
    """

    root: str | None
    path: tuple[str, ...]
    value: ir.Expression
    is_default: bool
    span: Span
    comments: tuple[str, ...]


def lower_constraints(
    ctx: LoweringContext, constraints: tuple[ast.KeepConstraint, ...]
) -> tuple[Bound, ...]:
    """Lower constraints, conjunctions taken apart."""
    return tuple(bound for keep in constraints for bound in _lower_keep(ctx, keep))


def _lower_keep(ctx: LoweringContext, keep: ast.KeepConstraint) -> Iterator[Bound]:
    comments = statement_comments(keep)
    for part in _conjuncts(keep.expression):
        bound = _lower_bound(ctx, keep, part, comments)
        if bound is not None:
            yield bound
        comments = ()


def _conjuncts(expression: ast.Expression) -> tuple[ast.Expression, ...]:
    """Return the operands of a chain of `and`, left to right."""
    parts: list[ast.Expression] = []
    while isinstance(expression, ast.Binary) and expression.operator is Operator.AND:
        parts.append(expression.right)
        expression = expression.left
    return (expression, *reversed(parts))


def _lower_bound(
    ctx: LoweringContext, keep: ast.KeepConstraint, part: ast.Expression, comments: tuple[str, ...]
) -> Bound | None:
    if isinstance(part, ast.Binary) and part.operator in (Operator.EQUAL, Operator.IN):
        path = _path(part.left)
        is_range = isinstance(part.right, ast.RangeLiteral)
        if path is not None and is_range == (part.operator is Operator.IN):
            value = lower_expression(ctx, part.right)
            if value is None:
                return None
            is_default = keep.strength is ast.KeepStrength.DEFAULT
            return Bound(path[0], path[1:], value, is_default, part.span, comments)
    ctx.unsupported(
        "OSC502",
        part.span,
        "this constraint neither fixes nor bounds a value",
        help="write `path == value` or `path in [low..high]`",
    )
    return None


def _path(expression: ast.Expression) -> tuple[str | None, *tuple[str, ...]] | None:
    """Return root and members of a path; the root is `None` for `it`."""
    members: list[str] = []
    while isinstance(expression, ast.MemberAccess):
        members.append(expression.name.text)
        expression = expression.base
    members.reverse()
    match expression:
        case ast.ItExpression():
            return (None, *members)
        case ast.NameExpression(name=name):
            return (name.text, *members)
        case _:
            return None

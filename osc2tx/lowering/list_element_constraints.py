"""Constraints on elements of an actor's list by index: `keep(it.axles[0].… == …)`.

Such a list has a length of its own: what is not said of it is as the runtime knows it.
"""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.analysis.collect import Constraint
from osc2tx.analysis.operation_list import Key
from osc2tx.lowering.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

LISTS = frozenset({"vehicle.axles", "traffic_participant.intended_infrastructure"})
"""Lists of the library whose elements are fixed one by one."""


def fixed_elements(
    ctx: LoweringContext, constraints: ConstraintLowering, object_: sym.FieldSymbol
) -> Iterator[ir.FieldValue]:
    """Yield what constraints fix about elements; their paths have numbers behind the lists.

    Args:
        ctx: The checked program.
        constraints: Those of the scenario; the ones that are found count as written.
        object_: The object.
    """
    for constraint in constraints.found.in_force.constraints:
        node = constraint.node
        if not isinstance(node, ast.KeepConstraint) or constraint.is_default:
            continue
        part = node.expression
        if not isinstance(part, ast.Binary) or part.operator is not ast.BinaryOperator.EQUAL:
            continue
        for side, other in ((part.left, part.right), (part.right, part.left)):
            path = _path(ctx, constraints, constraint, object_, side)
            if path is not None:
                value = lower_expression(ctx.at(constraint.place), other)
                constraints.use(constraint)
                if value is not None:
                    yield ir.FieldValue(
                        path=path, value=value, span=value.span, comments=statement_comments(node)
                    )
                break


def _path(
    ctx: LoweringContext,
    constraints: ConstraintLowering,
    constraint: Constraint,
    object_: sym.FieldSymbol,
    expression: ast.Expression,
) -> tuple[str, ...] | None:
    """Return the path of an element or of a member of it; `None` for anything else."""
    members: list[str] = []
    current = expression
    while isinstance(current, ast.MemberAccess):
        symbol = ctx.model.symbol_of(current)
        if not isinstance(symbol, sym.FieldSymbol) or symbol.is_variable:
            return None
        members.insert(0, symbol.name)
        current = current.base
    if not isinstance(current, ast.Index) or not isinstance(current.index, ast.IntegerLiteral):
        return None
    key = constraint.place.locate(current.base)
    if key is None or len(key) != 2 or key[0] is not object_ or _is_whole(constraints, key):
        return None
    field = key[1]
    if not isinstance(field, sym.FieldSymbol) or field.owner is None:
        return None
    if f"{field.owner.name}.{field.name}" not in LISTS:
        return None
    return field.name, str(current.index.value), *members


def _is_whole(constraints: ConstraintLowering, key: Key) -> bool:
    """Whether the list has a value as a whole."""
    about = constraints.found.by_key.get(key, ())
    return any(c.subject == key and c.value is not None for c in about)

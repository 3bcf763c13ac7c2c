"""Constraints that neither a constant nor a domain makes true: they are checked before the run."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.lowering.behavior.composed_behaviors import is_composed
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.declarations.map_fields import NOT_SEARCHED_BY, SEARCHED_BY, reads_map
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast


def is_about_others(ctx: LoweringContext, constraint: Constraint) -> bool:
    """Whether a constraint refers to objects that are made elsewhere, and not known there.

    Known are constraints on a single member of an object that the invocation names.
    """
    roots = {key[0] for key in constraint.operations.keys if len(key) > 1}
    is_relation = len(constraint.operations.keys) > 1
    return bool(roots & (ctx.program.handed_in if is_relation else ctx.program.computed))


def checks_itself(ctx: LoweringContext, invoked: ast.Invocation) -> bool:
    """Whether an invoked behavior checks its own constraints: all but actions of the user."""
    callee = ctx.model.binding_of(invoked).callee
    is_action = isinstance(callee, sym.ActionSymbol) and callee.origin == "user"
    return not is_action or is_composed(callee)


def lower_check(
    ctx: LoweringContext, constraint: Constraint, comments: tuple[str, ...]
) -> ir.Constraint | None:
    """Lower a constraint to a check; `None` if it is no `keep`, or cannot be checked then.

    Args:
        ctx: The checked program.
        constraint: The constraint.
        comments: Its comment lines.
    """
    node = constraint.node
    if not isinstance(node, ast.KeepConstraint):
        return None
    expression = lower_expression(ctx.at(constraint.place), node.expression)
    if expression is None:
        return None
    if ir.is_live(expression):
        if reads_map(expression):
            what, instead = NOT_SEARCHED_BY, SEARCHED_BY
        else:
            what = "this constraint depends on the state of the world"
            instead = (
                "constraints relate values that are known before the run; "
                "wait for the condition, or end a member with `until`"
            )
        ctx.unsupported("OSC502", constraint.span, what, help=instead)
        return None
    return ir.Constraint(expression=expression, span=constraint.span, comments=comments)

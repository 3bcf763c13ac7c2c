"""Placements by modifiers that are members of a scenario."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.modifiers.modifiers import is_override
from osc2tx.lowering.modifiers.standing_modifiers import StandingModifiers, stands
from osc2tx.lowering.placement.carla_paths import is_path_member
from osc2tx.lowering.placement.initial_placement import can_place, owner_of
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace


def member_placements(
    ctx: LoweringContext,
    statements: tuple[ast.Statement, ...],
    standing: StandingModifiers,
) -> tuple[ir.Placement, ...]:
    """Lower modifiers that are members: only those that place an actor."""
    placements = []
    for statement in statements:
        if not isinstance(statement, ast.ModifierApplication):
            continue
        if is_override(ctx, statement) or is_path_member(ctx, statement):
            continue
        if _is_method_call(ctx, statement):
            continue
        for applied in standing.of_member(statement):
            modifier, actor = applied.call, applied.actor
            is_start = modifier.at == "start" and can_place(modifier)
            is_placing = is_start or bool(owner_of(modifier))
            if stands(modifier) and (actor is None or isinstance(actor, ir.FieldRef)):
                continue  # it belongs to each of them
            if not is_placing or not isinstance(actor, ir.FieldRef):
                whose = "" if statement.actor is None else f" of `{statement.actor.span.text}`"
                ctx.unsupported(
                    "OSC508",
                    statement.span,
                    f"modifier `{modifier.name}`{whose} is not supported in a whole scenario",
                    help="apply it in the `with` of the actions that it is to modify",
                )
                continue
            placements.append(
                ir.Placement(
                    actor=actor.name,
                    modifiers=(replace(modifier, comments=()),),
                    span=statement.span,
                    comments=modifier.comments,
                    of_map=owner_of(modifier) == "map",
                )
            )
    return tuple(placements)


def _is_method_call(ctx: LoweringContext, statement: ast.ModifierApplication) -> bool:
    """Whether a member calls a method, as a dialect allows; a computation has no effect."""
    callee = ctx.model.binding_of(statement).callee
    if not isinstance(callee, sym.MethodSymbol):
        return False
    if callee.node is not None and isinstance(callee.node.body, ast.ExternalBody):
        ctx.unsupported(
            "OSC503",
            statement.span,
            "an external method is called at an instant of the scenario",
            help=f"write `call {statement.span.text}` in its `do`",
        )
    return True

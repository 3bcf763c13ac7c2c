"""Actors that stand still during the whole run: their heading is known in advance."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.context import Context

STILL = frozenset({"remain_stationary"})
"""Actions that neither move nor turn who stands."""


def standing_heading(ctx: Context, entity: str) -> float | None:
    """Return the heading (rad) of an actor that stands from start to end; `None` if it may turn."""
    state = ctx.at_start.get(entity)
    if state is None or state.pose is None or state.speed is None:
        return None
    if not state.speed.is_known or state.speed.low != 0.0:
        return None
    for scope in ctx.root.all():
        for node in ir.walk_behaviors(scope.scenario.body):
            if not isinstance(node, ir.Invoke) or node.action in STILL:
                continue
            member = (
                scope.cast.get(node.actor.name) if isinstance(node.actor, ir.FieldRef) else None
            )
            if member is None or member.name == entity:
                return None
    return state.pose.h

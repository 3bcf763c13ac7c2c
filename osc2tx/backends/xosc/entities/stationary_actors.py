"""Headings of actors that are known in advance: of who stands still, or drives along its lane."""

from __future__ import annotations

from math import cos

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
    return state.pose.h if stands(ctx, entity) else None


def stands(ctx: Context, entity: str) -> bool:
    """Whether who stands at the start is told nothing that moves or turns it."""
    for scope in ctx.root.all():
        for node in ir.walk_behaviors(scope.scenario.body):
            if not isinstance(node, ir.Invoke) or node.action in STILL:
                continue
            member = (
                scope.cast.get(node.actor.name) if isinstance(node.actor, ir.FieldRef) else None
            )
            if member is None or member.name == entity:
                return False
    return True


def faces_along(ctx: Context, me: str, other: str) -> bool:
    """Whether two actors surely look the same way along their road, wherever they are on it."""
    ways = [_way_along(ctx, name) for name in (me, other)]
    return ways[0] is not None and ways[0] == ways[1]


def _way_along(ctx: Context, entity: str) -> tuple[str, bool] | None:
    """Return road and direction in which an actor set out along its lane; `None` if unknown."""
    state, roads = ctx.at_start.get(entity), ctx.roads
    if state is None or state.lane is None or roads is None:
        return None
    if state.pose is not None and cos(state.pose.h - roads.pose(state.lane).h) < 0.999:
        return None
    return state.lane.road, roads.map.travel_direction(state.lane.road, state.lane.lane) > 0

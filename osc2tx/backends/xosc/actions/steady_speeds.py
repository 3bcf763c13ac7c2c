"""Actors whose speed stays what it is."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.leaf import Arguments, Leaf
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.catalogue import catalogue


def steady_speed(leaf: Leaf, actor: CastMember) -> float | None:
    """Return the speed (m/s) that an actor has all the time; `None` if it may change."""
    start = leaf.ctx.at_start[actor.name].speed
    if start is None or not start.is_known:
        return None
    for node in ir.walk_behaviors(leaf.ctx.scenario.body):
        if isinstance(node, ir.InvokeScenario):
            return None
        if not isinstance(node, ir.Invoke) or not isinstance(node.actor, ir.FieldRef):
            continue
        if node.actor.name == actor.actor.name and not _leaves_speed(leaf, node, start.low):
            return None
    return start.low


def _leaves_speed(leaf: Leaf, node: ir.Invoke, speed: float) -> bool:
    entry = catalogue().actions.get(node.qualified_name)
    if entry is None or (entry.paces and node.action != "keep_speed"):
        return False
    for call in node.modifiers:
        if call.name in ("keep_speed", "keep_lane", "lane", "lateral", "change_lane"):
            continue
        if call.name != "speed":
            return False
        arguments = Arguments(leaf.ctx, call.arguments, call)
        if any(name in arguments for name in ("faster_than", "slower_than", "same_as")):
            return False
        if arguments.number("speed") != speed:
            return False
    return True

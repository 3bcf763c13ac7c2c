"""Actors whose speed stays what it is."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.leaf import Arguments, Leaf
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.actors import TOP_SPEED
from osc2tx.backends.xosc.report import Remedy
from osc2tx.catalogue import catalogue

_BESIDE_SPEED = ("keep_lane", "lane", "lateral", "change_lane")
"""Modifiers that say nothing of the speed."""


def note_open_speed(leaf: Leaf) -> None:
    """Report that a driver who is told no speed slows down for bends, which no XML says."""
    roads, speed = leaf.ctx.roads, leaf.state.speed
    if roads is None or leaf.member.walks:
        return
    if any(call.name not in _BESIDE_SPEED for call in leaf.node.modifiers):
        return
    fastest = TOP_SPEED if speed is None else max(map(abs, speed))
    if fastest**2 * roads.sharpest_bend > leaf.limits.lateral:
        bound = f"{fastest:.4g} m/s are too fast for the sharpest bend of the map"
        if speed is None:
            bound = "none where its speed, which only the run shows, suits the bends of the map"
        leaf.ctx.report.approximate(
            leaf.construct,
            leaf.node.span,
            "no speed is stated: it slows down for bends in the world, but not in the XML",
            bound,
            Remedy(instead="`keep_speed()` holds the speed in both"),
        )


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
        if call.name in _BESIDE_SPEED or call.name == "keep_speed":
            continue
        if call.name != "speed":
            return False
        arguments = Arguments(leaf.ctx, call.arguments, call)
        if any(name in arguments for name in ("faster_than", "slower_than", "same_as")):
            return False
        if arguments.number("speed") != speed:
            return False
    return True

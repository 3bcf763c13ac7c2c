"""Gaps and headways to another actor (§8.8.3.4 to §8.8.3.11).

A gap counts between facing ends or sides, as a distance with free space does in the XML; a headway
counts between fronts, the XML between reference points. A gap that is to be kept is the one that
there is, which the XML cannot ask for: it has to be known from what stands before.
"""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action, apply_modifiers, to_goal
from osc2tx.backends.xosc.actions.speed.gap_elements import Between, Gap, reach
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx_shared.classes import replace

OPPOSITE = {"ahead": "behind", "behind": "ahead", "left": "right", "right": "left"}


@action("change_space_gap", "change_time_gap", "change_space_headway", "change_time_headway")
def _change_gap(leaf: Leaf) -> Performance:
    gap = _asked_for(leaf, leaf.node, leaf.arguments)
    change = reach(leaf, gap, keeps=False)
    if leaf.node.duration is not None:
        leaf.ctx.report.approximate(
            leaf.construct,
            leaf.node.duration.span,
            "an action on a distance takes as long as the tool wants",
            "the distance is reached, but not at that time",
        )
    return to_goal(leaf, change)


@action("keep_space_gap", "keep_time_gap", "keep_space_headway", "keep_time_headway")
def _keep_gap(leaf: Leaf) -> Performance:
    reference = leaf.arguments.required_entity("reference")
    direction = leaf.arguments.member("direction", "longitudinal")
    found = _reached_before(leaf, reference, direction)
    missing: float | None = 0.0
    if found is None and direction == "longitudinal" and leaf.is_start:
        found = _at_start(leaf, reference)
        same = leaf.state.speed == leaf.ctx.at_start[reference.name].speed
        missing = 0.0 if same else None
    if found is None:
        raise Inexpressible(
            "the present gap is not known before the run, and the XML has no action that keeps it",
        )
    change = reach(leaf, found, keeps=True, missing=missing)
    return Performance((change, *apply_modifiers(leaf)), "open")


def _asked_for(leaf: Leaf, node: ir.Invoke, arguments: Arguments) -> Gap:
    """Return the gap that a `change_…` asks for; a negative one is on the other side."""
    target, reference = arguments.required("target"), arguments.required_entity("reference")
    side = arguments.member("direction", "")
    if side in ("inside", "outside"):
        roads, lane = leaf.ctx.roads, leaf.state.lane
        is_right_hand = roads is None or lane is None or roads.is_right_hand(lane.road)
        side = "left" if (side == "inside") is is_right_hand else "right"
    if target < 0.0:
        target, side = -target, OPPOSITE[side]
    return Gap(reference, side, target, *_counted(node))


def _counted(node: ir.Invoke) -> tuple[bool, Between]:
    """Return whether an action is about a time, and between what the gap of it counts."""
    return "_time_" in node.action, "fronts" if node.action.endswith("headway") else "ends"


def _reached_before(leaf: Leaf, reference: CastMember, direction: str) -> Gap | None:
    """Return the gap that the invocation before has made."""
    is_time, between = _counted(leaf.node)
    before = ir.predecessor(leaf.ctx.scenario.body, leaf.node)
    if before is None or not before.action.startswith(("change_space_", "change_time_")):
        return None
    if before.until or before.actor is None:
        return None
    if leaf.ctx.values.actor(before.actor) != leaf.member.actor.name:
        return None
    gap = _asked_for(leaf, before, Arguments(leaf.ctx, before))
    same = (gap.reference.name, gap.is_time, gap.is_lateral)
    if same != (reference.name, is_time, direction == "lateral"):
        return None
    if gap.between == between:
        return gap
    if is_time:
        return None
    leading = (reference if gap.side == "behind" else leaf.member).shape.length
    size = gap.size + leading if between == "fronts" else gap.size - leading
    return replace(gap, size=size, between=between)


def _at_start(leaf: Leaf, reference: CastMember) -> Gap | None:
    """Return the gap of the initial placement."""
    is_time, between = _counted(leaf.node)
    apart = leaf.ctx.init_gaps.get((leaf.member.name, reference.name))
    if apart is None:
        return None
    me, other = leaf.member.shape, reference.shape
    side = "behind" if apart > 0.0 else "ahead"
    behind, ahead = (me, other) if side == "behind" else (other, me)
    size = abs(apart) - behind.front + (ahead.front if between == "fronts" else -ahead.rear)
    if is_time:
        trailing = leaf.state if side == "behind" else leaf.ctx.at_start[reference.name]
        speed = trailing.known_speed
        if speed is None or speed <= 0.0:
            return None
        size /= speed
    return Gap(reference, side, max(size, 0.0), is_time, between)

"""Modifiers of lane and lateral position (§8.9.9, §8.9.14 to §8.9.16)."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.arguments import Call
from osc2tx.backends.xosc.actions.lateral.lanes import drawn_side, lane_change, lanes_to
from osc2tx.backends.xosc.actions.lateral.lateral_offsets import offset_change, offset_in_lane
from osc2tx.backends.xosc.actions.leaf import Change, Changes, Leaf
from osc2tx.backends.xosc.actions.registry import modifier
from osc2tx.backends.xosc.actions.speed.gap_elements import Gap, reach
from osc2tx.backends.xosc.actions.speed.speed_changes import may_jump
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.report import Inexpressible, Remedy
from osc2tx.backends.xosc.state import known


@modifier("change_lane")
def _change_lane(leaf: Leaf, call: Call) -> Changes:
    count = call.count("lane")
    side = call.member("side", "") or drawn_side(leaf, call.node, count)
    return (_to(leaf, call, count if side == "left" else -count),)


@modifier("lane")
def _lane(leaf: Leaf, call: Call) -> Changes:
    reference = call.entity("same_as") or call.entity("side_of")
    if reference is None:
        return _numbered(leaf, call)
    lanes = call.lanes_to_left() if "side_of" in call else 0
    own = lanes_to(leaf, reference, lanes)
    if own == 0:
        return ()
    return (_to(leaf, call, lanes, reference.name, own),)


def _numbered(leaf: Leaf, call: Call) -> Changes:
    """Return the change to a lane with a number, counted from an edge of the road."""
    number, edge = call.count("lane"), call.member("from", "right")
    roads, here = leaf.ctx.roads, leaf.state.lane
    if roads is None or here is None:
        raise Inexpressible("which lane it is in is only known during the run")
    target = roads.with_number(here, number, edge)
    lanes = None if target is None else roads.lanes_between(here, target)
    if lanes is None:
        raise Inexpressible(f"there is no such lane beside lane {here.lane}")
    if lanes == 0:
        return ()
    return (_to(leaf, call, lanes),)


def _to(
    leaf: Leaf, call: Call, lanes: int, reference: str | None = None, own_lanes: int | None = None
) -> Change:
    """Return the change to a lane beside that of the actor or of a reference."""
    if any(other.name == "lateral" and other.at != "start" for other in leaf.node.modifiers):
        instead = "the action `change_lane` with its `offset` is exact"
        remedy = Remedy(instead=instead, asks=("LaneChangeActionDynamics",))
        raise Inexpressible("a lane change and an offset are two lateral actions", remedy=remedy)
    pace = leaf.in_time(call, call.shape()[0])
    return lane_change(leaf, lanes, pace, reference, own_lanes=own_lanes, jumps=may_jump(leaf))


@modifier("lateral")
def _lateral(leaf: Leaf, call: Call) -> Changes:
    reference = call.entity("side_of")
    if reference is not None:
        return _beside_another(leaf, call, reference)
    offset = offset_in_lane(leaf.ctx, call, leaf.member, leaf.state.lane)
    pace = leaf.in_time(call, call.shape()[0])
    return () if leaf.state.offset == known(offset) else (offset_change(leaf, offset, pace),)


def _beside_another(leaf: Leaf, call: Call, reference: CastMember) -> Changes:
    distance = call.size("distance")
    if distance is None:
        raise Inexpressible("no distance is stated")
    side = "left" if call.member("side", "left") == "left" else "right"
    gap = Gap(reference, side, distance, is_time=False, is_headway=False)
    return _beside(leaf, call, gap)


def _beside(leaf: Leaf, call: Call, gap: Gap) -> Changes:
    """Return the control of the distance across the road from another actor."""
    measured = call.member("measure_by", "center_to_center")
    facing = ("left_to_right", "closest") if gap.side == "right" else ("right_to_left", "closest")
    half = 0.5 * (leaf.member.shape.width + gap.reference.shape.width)
    size = gap.size
    if measured == "center_to_center":
        size -= half
    elif measured not in facing:
        raise Inexpressible(f"a distance from `{measured}` across the road")
    if size < 0.0:
        raise Inexpressible("they would overlap, and the XML counts between their sides")
    gap = Gap(gap.reference, gap.side, size, is_time=False, is_headway=False)
    return (reach(leaf, gap, keeps=call.at != "end"),)

"""Lateral positions: in a lane, from edges and centers (§8.9.8), and in lanes beside it.

The modifiers of lane and lateral position are those of §8.9.9 and §8.9.14 to §8.9.16.
"""

from __future__ import annotations

import math

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.lateral.lanes import (
    LANE_WIDTH,
    NO_ONE_SIDE,
    along_t,
    lane_change,
    lanes_aside,
    lanes_to,
    lanes_to_segment,
    lateral,
    offset_of,
    shift,
)
from osc2tx.backends.xosc.actions.leaf import Change, Changes, Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action, apply_modifiers, modifier
from osc2tx.backends.xosc.actions.speed.gaps import Gap, reach
from osc2tx.backends.xosc.actions.speed.speed_changes import may_jump
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.declared_roads import segment_of
from osc2tx.backends.xosc.facts.actors import Pace
from osc2tx.backends.xosc.facts.maps import LanePosition, is_oncoming, lane_from_edge
from osc2tx.backends.xosc.state import LATERAL, known
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import replace

INSIDE = 1.2
"""Metres from the centre that are inside of any lane: there what is cut short goes on."""


@action("follow_lane")
def _follow_lane(leaf: Leaf) -> Performance:
    arguments = leaf.arguments
    offset, pace = arguments.number("offset") or 0.0, arguments.pace()
    target = segment_of(leaf.ctx, arguments.get("target"))
    if target is not None and lanes_to_segment(leaf, target) != 0:
        raise Inexpressible("it is in another lane; a lane change has to come before")
    changes = apply_modifiers(leaf)
    if leaf.state.offset == known(offset):
        return Performance(changes, "open")
    return Performance((offset_change(leaf, offset, pace), *changes), "open")


def offset_change(leaf: Leaf, offset: float, pace: Pace) -> Change:
    """Return the change of the place in the lane to an offset (m) to the left of the centre.

    Raises:
        Inexpressible: It is in a lane of oncoming traffic, or reaches over the line to one.
    """
    roads, lane = leaf.ctx.roads, leaf.state.lane
    if roads is not None and lane is not None:
        reached = lane._replace(offset=lane.offset + offset_of(leaf.state))
        if is_oncoming(roads.map, lane) or is_oncoming(roads.map, reached):
            raise Inexpressible(NO_ONE_SIDE)
    way, here = abs(offset - offset_of(leaf.state)), leaf.state.offset
    if here is None or not here.is_known:
        way = abs(offset) + 0.5 * LANE_WIDTH
        leaf.arguments.doubt(
            "how far it is from its place in the lane is only known during the run, and the XML"
            f" states no length for a change of the offset: it takes so long for {way:.3g} m"
        )
    shape, time = shift(leaf, way, pace)
    # The XML gives no time, only the peak of the lateral acceleration: that of the shape.
    half_turn = math.pi / time
    peak_rate = 0.5 * way * half_turn * half_turn
    dynamics = xml.LaneOffsetActionDynamics(dynamicsShape=shape, maxLateralAcc=round(peak_rate, 6))
    target = xml.LaneOffsetTarget(xml.AbsoluteTargetLaneOffset(value=along_t(leaf, offset)))
    action = lateral(xml.LaneOffsetAction(dynamics, target, continuous=False))
    after = replace(leaf.state, offset=known(offset)).finished(LATERAL)
    during = replace(after, offset=None)
    return Change(LATERAL, (action,), time, during, after, goes_on=abs(offset) < INSIDE)


EDGES = {"left": 0.5, "center": 0.0, "right": -0.5}
"""Widths from the centre to what `lat_measure_by` names."""


def offset_in_lane(
    ctx: Context, arguments: Arguments, member: CastMember, place: LanePosition | None
) -> float:
    """Return how far (m) left of the centre of its lane `lateral` puts an actor.

    Raises:
        Inexpressible: It says no distance, or the width of the lane is not known.
    """
    width = None
    if ctx.roads is not None and place is not None:
        width = ctx.roads.map.lane_width(place.road, place.lane, place.s)
    return left_of(arguments, member.shape.width, width)


def left_of(arguments: Arguments, own: float, theirs: float | None) -> float:
    """Return how far (m) left of the centre of a lane or an actor `lateral` puts an actor.

    The own width and theirs, which may be unknown, are in metres; it refuses as `offset_in_lane`.
    """
    distance = arguments.distance()
    side = arguments.member("side", "left")
    left = -distance if side == "right" else distance
    measured = arguments.member("measure_by", "center_to_center")
    if measured == "center_to_center":
        return left
    if theirs is None:
        raise Inexpressible("how wide the lane is is only known during the run")
    if measured == "closest":
        reach = 0.5 * (own + theirs)
        return left + (reach if left > 0.0 or (left == 0.0 and side == "left") else -reach)
    edge, _, other_edge = measured.split("_")
    return round(left + EDGES[other_edge] * theirs - EDGES[edge] * own, 6)


@modifier("change_lane")
def _change_lane(leaf: Leaf, call: Arguments) -> Changes:
    return (_to(leaf, call, lanes_aside(leaf, call, "lane")),)


@modifier("lane")
def _lane(leaf: Leaf, call: Arguments) -> Changes:
    reference, lanes = call.beside_lane()
    if reference is None:
        return _numbered(leaf, call)
    own = lanes_to(leaf, reference, lanes)
    if own == 0:
        return ()
    return (_to(leaf, call, lanes, reference, own),)


def _numbered(leaf: Leaf, call: Arguments) -> Changes:
    """Return the change to a lane with a number, counted from an edge of the road."""
    number, edge = call.count("lane"), call.member("from", "right")
    roads, here = leaf.ctx.roads, leaf.state.lane
    if roads is None or here is None:
        raise Inexpressible("which lane it is in is only known during the run")
    target = roads.with_number(here, lane_from_edge(number, edge))
    lanes = None if target is None else roads.lanes_between(here, target)
    if lanes is None:
        raise Inexpressible(f"there is no such lane beside lane {here.lane}")
    if lanes == 0:
        return ()
    return (_to(leaf, call, lanes),)


def _to(
    leaf: Leaf,
    call: Arguments,
    lanes: int,
    reference: CastMember | None = None,
    own_lanes: int | None = None,
) -> Change:
    """Return the change to a lane beside that of the actor or of a reference."""
    if any(other.name == "lateral" and other.at != "start" for other in leaf.node.modifiers):
        instead = "the action `change_lane` with its `offset` is exact"
        remedy = Remedy(instead=instead, asks=("LaneChangeActionDynamics",))
        raise Inexpressible("a lane change and an offset are two lateral actions", remedy=remedy)
    pace = leaf.in_time(call, call.shape()[0])
    return lane_change(leaf, lanes, pace, reference, own_lanes=own_lanes, jumps=may_jump(leaf))


@modifier("lateral")
def _lateral(leaf: Leaf, call: Arguments) -> Changes:
    reference = call.entity("side_of")
    if reference is not None:
        return _beside(leaf, call, reference)
    offset = offset_in_lane(leaf.ctx, call, leaf.member, leaf.state.lane)
    pace = leaf.in_time(call, call.shape()[0])
    return () if leaf.state.offset == known(offset) else (offset_change(leaf, offset, pace),)


def _beside(leaf: Leaf, call: Arguments, reference: CastMember) -> Changes:
    """Return the control of the distance across the road from another actor."""
    size = call.distance()
    side = "left" if call.member("side", "left") == "left" else "right"
    measured = call.member("measure_by", "center_to_center")
    facing = ("left_to_right", "closest") if side == "right" else ("right_to_left", "closest")
    if measured == "center_to_center":
        size -= 0.5 * (leaf.member.shape.width + reference.shape.width)
    elif measured not in facing:
        raise Inexpressible(f"a distance from `{measured}` across the road")
    if size < 0.0:
        raise Inexpressible("they would overlap, and the XML counts between their sides")
    return (reach(leaf, Gap(reference, side, size), keeps=call.at != "end"),)

"""Starts in a lane, across it and turned in it (§8.9.9, §8.9.10).

Headings are known in advance of who stands still, or drives along its lane.
"""

from __future__ import annotations

import math

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.lateral.lateral_offsets import left_of, offset_in_lane
from osc2tx.backends.xosc.actions.registry import at_start
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.start_statements import Start, StartPlace
from osc2tx.backends.xosc.facts.maps import Lane, LanePosition, Pose, lane_from_edge, offset_from
from osc2tx.backends.xosc.state import ActorState, known
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc import elements as xml


def in_lane(ctx: Context, start: Start, place: LanePosition) -> StartPlace:
    """Return the place in a lane; where it is across the lane and turned to comes from others.

    Who walks is put to the point: tools would take it along the lane, and it goes straight on.
    """
    offset = lateral_of(ctx, start, place)
    if ctx.roads is not None and goes_straight(ctx, start):
        pose = ctx.roads.map.pose(place._replace(offset=offset))
        heading, pitch, roll = turned(ctx, start, pose.h)
        there = Pose(round(pose.x, 6), round(pose.y, 6), round(pose.z, 6), round(heading, 9))
        return at_pose(there, pitch, roll)
    right_hand = 1 if place.lane < 0 else -1  # where there is no map to ask
    sign = right_hand if ctx.roads is None else ctx.roads.leftwards(place) or right_hand
    element_ = xml.LanePosition(
        orientation_in_lane(ctx, start, place),
        roadId=place.road,
        laneId=place.lane,
        s=place.s,
        offset=round(sign * offset, 6),
    )
    known_lane = place if ctx.roads is not None else None
    return element_, ActorState(speed=known(0.0), offset=known(offset), lane=known_lane)


def at_pose(pose: Pose, pitch: float | None, roll: float | None) -> StartPlace:
    """Return a point in the world, on a lane or not."""
    position = xml.WorldPosition(
        x=pose.x, y=pose.y, z=pose.z, h=pose.h, p=pitch or None, r=roll or None
    )
    return position, ActorState(speed=known(0.0), offset=None, pose=pose)


def goes_straight(ctx: Context, start: Start) -> bool:
    """Whether an actor moves, and follows no lane."""
    return start.member.walks and not stands(ctx, start.id)


def lateral_of(ctx: Context, start: Start, place: LanePosition | None) -> float:
    """Return how far (m) left of the centre of its lane an actor starts."""
    lateral = start.modifiers.get("lateral")
    if lateral is None:
        return 0.0 if place is None else round(place.offset, 6)
    other = lateral.entity("side_of")
    if other is None:
        return offset_in_lane(ctx, lateral, start.member, place)
    pose = ctx.start_poses.get(other.name)
    if pose is None or place is None or ctx.roads is None:
        raise Inexpressible(f"where {other.name} is in its lane is only known during the run")
    theirs = offset_from(ctx.roads.map, place._replace(offset=0.0), pose.x, pose.y)
    return round(theirs + left_of(lateral, start.member.shape.width, other.shape.width), 6)


def lane_number(start: Start) -> Lane | None:
    """Return the lane that is said by its number, and not beside another actor."""
    lane = start.modifiers.get("lane")
    if lane is None or lane.beside_lane()[0] is not None:
        return None
    return lane_from_edge(round(lane.number("lane") or 1), lane.member("from", "right"))


# --- how an actor is turned -----------------------------------------------------------------------

AXES = {"length_to_width": 0.5 * math.pi, "width_to_length": -0.5 * math.pi}
"""Angle (rad) between the lines that `yaw_measure_by` names."""

at_start("yaw", "orientation")

STRAIGHT = 1e-6
"""Sine of an angle to a lane that counts as none."""


def turned(ctx: Context, start: Start, along: float) -> tuple[float, float | None, float | None]:
    """Return heading, pitch and roll of who starts where the road has a heading (rad)."""
    yaw, orientation = start.modifiers.get("yaw"), start.modifiers.get("orientation")
    given = yaw or orientation
    if given is None:
        return along, None, None
    if yaw is not None:
        angle, pitch, roll = yaw.size("angle"), None, None
        measured = yaw.member("measure_by", "relative_to_road")
        base = 0.5 * math.pi if measured == "relative_to_north" else along
        base += AXES.get(measured, 0.0)
    else:
        angle, pitch, roll = (given.number(name) for name in ("yaw", "pitch", "roll"))
        measured = given.member("measure_by", "relative_to_road")
        base = along if measured == "relative_to_road" else 0.0
    other = given.entity("relative_to")
    if other is not None and measured != "absolute":
        base = _heading_of(ctx, other, given) + AXES.get(measured, 0.0)
    return base + (angle or 0.0), pitch, roll


def _heading_of(ctx: Context, other: CastMember, source: Arguments) -> float:
    pose = ctx.start_poses.get(other.name)
    if pose is None:
        raise Inexpressible(f"the heading of {other.name} is not known", source.source.span)
    return pose.h


def orientation_in_lane(
    ctx: Context, start: Start, place: LanePosition | None
) -> xml.Orientation | None:
    """Return how an actor on a lane is turned; `None`: along the lane.

    Raises:
        Inexpressible: Where the lane leads is not known.
    """
    if "yaw" not in start.modifiers and "orientation" not in start.modifiers:
        return None
    if ctx.roads is None or place is None:
        raise Inexpressible("where the lane leads is only known during the run", start.span)
    heading, pitch, roll = turned(ctx, start, ctx.roads.map.pose(place).h)
    return xml.Orientation(type="absolute", h=round(heading, 9), p=pitch or None, r=roll or None)


def note_turn(ctx: Context, start: Start) -> None:
    """Report that who drives and is turned in its lane comes into its direction in a curve.

    Raises:
        Inexpressible: It looks so far away from the lane that it does not come into it at all.
    """
    roads, member, pose = ctx.roads, start.member, ctx.start_poses.get(start.id)
    lane = None if pose is None or roads is None else roads.locate(*pose[:3])
    if member.walks or pose is None or roads is None or lane is None:
        return
    angle = math.remainder(pose.h - roads.map.pose(lane).h, math.tau)
    speed = ctx.states[member.name].speed
    v = 0.0 if speed is None else speed.low
    if abs(math.sin(angle)) < STRAIGHT or (v == 0.0 and stands(ctx, member.name)):
        return
    given = start.modifiers.get("yaw") or start.modifiers.get("orientation")
    span = start.span if given is None else given.source.span
    if math.cos(angle) <= 0.0:
        along = Remedy(instead="a heading along its lane is exact")
        raise Inexpressible("it looks away from its lane, in which a tool may keep it", span, along)
    reason = "it comes into the direction of its lane in a curve; a tool may turn it at once"
    ctx.report.doubt("orientation at the start", span, reason)


STILL = frozenset({"remain_stationary"})
"""Actions that neither move nor turn who stands."""


def standing_heading(ctx: Context, entity: str) -> float | None:
    """Return the heading (rad) of an actor that stands from start to end; `None` if it may turn."""
    state = ctx.at_start.get(entity)
    if state is None or state.pose is None or state.known_speed != 0.0:
        return None
    return state.pose.h if stands(ctx, entity) else None


def stands(ctx: Context, entity: str) -> bool:
    """Whether who stands at the start is told nothing that moves or turns it."""
    for scope in ctx.root.all():
        for node in ir.invocations(scope.scenario.body):
            member = scope.cast.get(node.actor_name or "")
            if node.action not in STILL and (member is None or member.name == entity):
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
    if state.pose is not None and math.cos(state.pose.h - roads.map.pose(state.lane).h) < 0.999:
        return None
    return state.lane.road, roads.map.travel_direction(state.lane.road, state.lane.lane) > 0

"""Starts in a lane, and across it."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.lateral.lateral_offsets import left_of, offset_in_lane
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.start_orientations import orientation_in_lane, turned
from osc2tx.backends.xosc.entities.start_statements import Start
from osc2tx.backends.xosc.entities.stationary_actors import stands
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx.backends.xosc.facts.start_places import LaneNumber
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.state import ActorState, known
from osc2tx.xosc import elements as xml


def in_lane(ctx: Context, start: Start, place: LanePosition) -> tuple[xml.PositionPart, ActorState]:
    """Return the place in a lane; where it is across the lane and turned to comes from others.

    Who walks is put to the point: tools would take it along the lane, and it goes straight on.
    """
    offset = lateral_of(ctx, start, place)
    if ctx.roads is not None and goes_straight(ctx, start):
        pose = ctx.roads.pose(place._replace(offset=offset))
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


def at_pose(
    pose: Pose, pitch: float | None, roll: float | None
) -> tuple[xml.PositionPart, ActorState]:
    """Return a point in the world, on a lane or not."""
    position = xml.WorldPosition(
        x=pose.x,
        y=pose.y,
        z=pose.z,
        h=pose.h,
        p=pitch or None,
        r=roll or None,
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
    theirs = ctx.roads.offset_from(place._replace(offset=0.0), pose)
    return round(theirs + left_of(lateral, start.member.shape.width, other.shape.width), 6)


def lane_number(start: Start) -> LaneNumber | None:
    """Return the lane that is said by its number."""
    lane = start.modifiers.get("lane")
    if lane is None:
        return None
    return LaneNumber(round(lane.number("lane") or 1), lane.member("from", "right"))

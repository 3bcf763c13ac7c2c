"""The path that an actor is to follow beyond the next step, for controllers that look ahead."""

from __future__ import annotations

import math

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap

from .actor_motion import CommandedActor
from .state import ActorState

__all__ = ["pose_ahead"]

_SLOW = 1.0  # m/s: slower ones look ahead as if they had this speed


def pose_ahead(member: CommandedActor, state: ActorState, way: float, road_map: RoadMap) -> Pose:
    """Where an actor will be after so many metres, if it goes on as it is commanded.

    Args:
        member: The actor, whose commands have reached `state`.
        state: Where to look from.
        way: Metres along its path; negative: backwards.
        road_map: The map.
    """
    if member.bound is not None:
        return _along_lane(member, member.bound, state, way, road_map)
    ahead = member.course_ahead(way)
    if ahead is not None:
        return ahead
    if member.home is not None:
        on = road_map.advance(member.home, way, member.route)
        return _straight(road_map.pose(on.position), way - on.travelled)
    return _straight(Pose(state.x, state.y, state.z, state.h), way)


def _along_lane(
    member: CommandedActor, lane: LanePosition, state: ActorState, way: float, road_map: RoadMap
) -> Pose:
    on = road_map.advance(lane, way, member.route)
    place = on.position
    seconds = abs(way) / max(abs(state.v), _SLOW)
    offset = member.offset_after(seconds, state.lateral_speed) if way > 0.0 else lane.offset
    pose = road_map.pose(LanePosition(place.road, place.lane, place.s, offset))
    return _straight(pose, way - on.travelled)


def _straight(pose: Pose, way: float) -> Pose:
    if abs(way) < 1e-6:
        return pose
    x, y = pose.x + way * math.cos(pose.h), pose.y + way * math.sin(pose.h)
    return pose._replace(x=x, y=y)

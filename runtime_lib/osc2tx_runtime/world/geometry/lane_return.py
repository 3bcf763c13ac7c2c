"""Return of a vehicle to the nearest lane after moving off the lanes."""

from __future__ import annotations

import math

from osc2tx_runtime.opendrive import LanePosition, RoadMap, Route
from osc2tx_runtime.world.state import ActorState

from .curve import turn_between

_BACK = 5.0  # m beside a lane within which a vehicle returns to it


def lane_near(road_map: RoadMap, state: ActorState) -> LanePosition | None:
    """The driving lane to return to; None without a close one in this direction."""
    on = road_map.locate(state.x, state.y, state.z, state.h, max_distance=_BACK)
    if on is None or math.cos(turn_from(road_map, on, state)) <= 0.0:
        return None
    return LanePosition(on.road, on.lane, on.s)


def abreast(
    road_map: RoadMap, lane: LanePosition, state: ActorState, route: Route | None
) -> LanePosition | None:
    """Position of an actor along a lane; None beyond its end."""
    pose = road_map.pose(lane)
    along = (state.x - pose.x) * math.cos(pose.h) + (state.y - pose.y) * math.sin(pose.h)
    step = road_map.advance(lane, along, route)
    return step.position if abs(step.travelled - along) < 1e-3 else None


def turn_from(road_map: RoadMap, lane: LanePosition, state: ActorState) -> float:
    """Heading of an actor relative to its lane (rad), positive to the left."""
    return turn_between(road_map.pose(lane).h, state.h)

"""Route coordinates: lanes measured along their centre line in direction of travel, and roads.

A lane is measured from where it begins on its road, over all lane sections it continues in; it
goes by the id it has there.
"""

from __future__ import annotations

import math

from osc2tx_runtime import opendrive
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap
from osc2tx_runtime.poses import road_entry
from osc2tx_runtime.road_graph import RoadGraph
from osc2tx_runtime.road_parts import RoadPart
from osc2tx_runtime.values import RoadRoute, RoutePoint

__all__ = ["along_lane", "place_of_route", "route_point_at"]


def along_lane(road_map: RoadMap, place: LanePosition) -> float:
    """Arc length (m) along the centre line of the lane, from where it begins on its road."""
    return road_map.route_distance(road_entry(road_map, place), place) or 0.0


def route_point_at(road_map: RoadMap, place: LanePosition) -> RoutePoint:
    """A place on a lane in the coordinates of the lane."""
    entry = road_entry(road_map, place)
    along = road_map.route_distance(entry, place) or 0.0
    return RoutePoint(RoadRoute(entry.road, entry.lane), along, place.offset)


def place_of_route(road_map: RoadMap, point: RoutePoint) -> LanePosition | opendrive.Pose:
    """Place of a point in route coordinates; beyond the end of its lane on the ones that follow.

    Raises:
        PlacementError: There is no such place.
    """
    route = point.route
    if route is None:
        raise PlacementError("a point without a route is relative; it needs a reference")
    if isinstance(route, RoadPart) and route.kind == "road":
        route = RoadRoute(route.found.road)
    try:
        if isinstance(route, RoadPart):
            begin = RoadGraph(road_map).begin(route.found)
        elif route.lane_id is None:
            return road_map.road_pose(route.road_id, point.s, point.t)
        else:
            begin = _begin(road_map, route.road_id, route.lane_id)
        step = road_map.advance(begin, point.s)
    except MapError as error:
        raise PlacementError(error.message) from error
    if abs(step.travelled - point.s) > 1e-6:
        raise PlacementError(
            f"lane {begin.lane} of road {begin.road} ends after {step.travelled:.1f} m,"
            f" before s = {point.s:g} m"
        )
    on = step.position
    return LanePosition(on.road, on.lane, on.s, point.t)


def _begin(road_map: RoadMap, road: str, lane: int) -> LanePosition:
    """Where a lane begins: in the first section, in direction of travel, that has it."""
    with_s = road_map.travel_direction(road, lane) > 0
    sections = road_map.roads[road].sections
    for section in sections if with_s else reversed(sections):
        if lane in section.lanes:
            s = section.begin if with_s else math.nextafter(section.end, section.begin)
            return LanePosition(road, lane, s)
    raise PlacementError(f"road {road} has no lane {lane}")

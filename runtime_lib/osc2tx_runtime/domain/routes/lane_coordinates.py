"""Conversion between route coordinates (s, t), road coordinates and lane positions.

A lane is measured from its start on its road, over all its lane sections; it is identified by its
id at its start.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from operator import attrgetter

from osc2tx_runtime import opendrive
from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.domain.points_and_poses import OdrPoint, RoadRoute, RoutePoint
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import LanePosition, LaneSection, MapError, RoadMap

_AT_END = 1e-5  # m: closer positions are at the end of a lane
_MISS = 1e-6  # m by which a point may miss its road
_EXACT = 1e-7  # m: precision of a distance along the road
_ATTEMPTS = 20  # to reach it

_begin_of = attrgetter("begin")


def position_along_road(road_map: RoadMap, place: LanePosition) -> float:
    """Metres along the reference line of the road, from where the traffic of the lane enters it.

    It is the position that the modifier `position` states without a reference (DSL 8.3.6, 8.9.2).
    """
    forwards = road_map.travel_direction(place.road, place.lane) > 0
    return place.s if forwards else road_map.roads[place.road].length - place.s


def place_along_road(
    road_map: RoadMap, place: LanePosition, position: float
) -> LanePosition | None:
    """The position on a lane at a distance along its road; None if the lane does not lead there.

    Args:
        road_map: The map.
        place: A place on the lane.
        position: As of `position_along_road` (m); beyond the end of the road, along the lanes that
            follow.
    """
    length = road_map.roads[place.road].length
    forwards = road_map.travel_direction(place.road, place.lane) > 0
    on_road = min(max(position, 0.0), length)
    found = _in_section_at(road_map, place, on_road if forwards else length - on_road)
    if found is None or on_road == position:
        return found
    step = road_map.advance(found, position - on_road)
    return step.position if abs(step.travelled - (position - on_road)) < _MISS else None


def _in_section_at(road_map: RoadMap, place: LanePosition, s: float) -> LanePosition | None:
    """The position at an s (m) of the road on a lane, whose id may differ there."""
    sections = road_map.roads[place.road].sections
    key, wanted = road_map.lane_key(place), max(bisect_right(sections, s, key=_begin_of) - 1, 0)
    forwards = road_map.travel_direction(place.road, place.lane) > 0
    while key.section != wanted:
        step = 1 if wanted > key.section else -1
        joined = road_map.successors if forwards == (step > 0) else road_map.predecessors
        beyond = (key.road, key.section + step)
        found = [other for other in joined(key) if (other.road, other.section) == beyond]
        if not found:
            section = sections[key.section]
            return LanePosition(key.road, key.lane, _last_in(section)) if s == section.end else None
        key = found[0]
    return LanePosition(key.road, key.lane, s)


def position_from(road_map: RoadMap, origin: LanePosition, place: LanePosition) -> float:
    """As `position_along_road`, from the road of an origin: beyond its end along the lanes.

    Args:
        road_map: The map.
        origin: A position on the road at whose start the result is zero.
        place: A position on it, or on a road to which it leads; on others the result counts along
            that road.
    """
    if place.road == origin.road:
        return position_along_road(road_map, place)
    length = road_map.roads[origin.road].length
    forwards = road_map.travel_direction(origin.road, origin.lane) > 0
    ends = road_map.lanes(origin.road, length if forwards else 0.0, like=origin.lane)
    end = LanePosition(origin.road, ends[0], length if forwards else 0.0) if ends else origin
    beyond = road_map.route_distance(end, place)
    if beyond is None:
        return position_along_road(road_map, place)
    return position_along_road(road_map, end) + beyond


def way_to_position(
    road_map: RoadMap, origin: LanePosition, here: LanePosition, position: float
) -> float:
    """Metres along the lane from a place to a position from the road of an origin.

    It is negative if the position is behind. If the lane ends before, the rest counts along the
    road.
    """
    there = place_along_road(road_map, here if here.road == origin.road else origin, position)
    way = None if there is None else road_map.route_distance(here, there)
    return position - position_from(road_map, origin, here) if way is None else way


def place_at_distance(
    road_map: RoadMap, start: LanePosition, origin: LanePosition, distance: float
) -> LanePosition | None:
    """The position on a lane at a distance (m) along the road; None: the lane ends before.

    Args:
        road_map: The map.
        start: A place on the lane.
        origin: Origin of the distance; it may be on another lane.
        distance: Positive ahead.
    """
    place = start
    for _ in range(_ATTEMPTS):
        measured = road_map.route_distance(origin, place)
        if measured is None:
            return None
        if abs(distance - measured) < _EXACT:
            return place
        step = road_map.advance(place, distance - measured)
        if abs(step.travelled - (distance - measured)) > _MISS:
            return None
        place = step.position
    return None


def route_point_at(road_map: RoadMap, place: LanePosition) -> RoutePoint:
    """A position on a lane in the coordinates of the lane."""
    entry = road_entry(road_map, place)
    along = road_map.route_distance(entry, place) or 0.0
    return RoutePoint(RoadRoute(entry.road, entry.lane), along, place.offset)


def place_of_route(road_map: RoadMap, point: RoutePoint) -> LanePosition | opendrive.Pose:
    """Position of a point in route coordinates; beyond the end of its lane on its successors.

    Raises:
        PlacementError: There is no such place.
    """
    route = point.route
    if route is None:
        raise PlacementError("a point without a route is relative; it needs a reference")
    way = None
    if isinstance(route, Path):
        return _beside_path(route, point)
    if isinstance(route, RoadPart):
        found = route.found
        if found.line is not None:
            return opendrive.Pose(*found.line.at(point.s, point.t), found.line.heading)
        if found.kind == "road":
            route = RoadRoute(found.road)
    try:
        if isinstance(route, RoadPart):
            graph = graph_of(road_map)
            begin = graph.begin(route.found)
            if found.kind == "compound_route":
                way = road_map.route_to(graph.end(route.found))
        elif not isinstance(route, RoadRoute):
            raise PlacementError("nothing can be measured along such a route")
        elif route.lane_id is None:
            return road_map.road_pose(route.road_id, point.s, point.t)
        else:
            begin = _begin(road_map, route.road_id, route.lane_id)
        step = road_map.advance(begin, point.s, way)
    except MapError as error:
        raise PlacementError(error.message) from error
    if abs(step.travelled - point.s) > _AT_END:
        raise PlacementError(
            f"lane {begin.lane} of road {begin.road} ends after {step.travelled:.1f} m,"
            f" before s = {point.s:g} m"
        )
    on = step.position
    return LanePosition(on.road, on.lane, on.s, point.t)


def _beside_path(path: Path, point: RoutePoint) -> opendrive.Pose:
    curve = path.curve
    if not 0.0 <= point.s <= curve.length + _AT_END:
        raise PlacementError(
            f"the path is {curve.length:.1f} m long, so it has no s = {point.s:g} m"
        )
    at = curve.at_length(point.s)
    (x, y, z), heading = curve.point(at), curve.heading(at) or 0.0
    x, y = x - point.t * math.sin(heading), y + point.t * math.cos(heading)
    return opendrive.Pose(x, y, z, heading)


def _begin(road_map: RoadMap, road: str, lane: int) -> LanePosition:
    """Start of a lane: in its first section in direction of travel."""
    with_s = road_map.travel_direction(road, lane) > 0
    sections = road_map.roads[road].sections
    for section in sections if with_s else reversed(sections):
        if lane in section.lanes:
            return LanePosition(road, lane, section.begin if with_s else _last_in(section))
    raise PlacementError(f"road {road} has no lane {lane}")


def road_entry(road_map: RoadMap, place: LanePosition) -> LanePosition:
    """Start of the lane of a position on its road, in direction of travel."""
    key = road_map.lane_key(place)
    sections = road_map.roads[place.road].sections
    with_s = road_map.travel_direction(place.road, place.lane) > 0
    while True:
        wanted = (key.road, key.section + (-1 if with_s else 1))
        before = [k for k in road_map.predecessors(key) if (k.road, k.section) == wanted]
        if not before:
            break
        key = before[0]
    section = sections[key.section]
    if with_s:
        return LanePosition(key.road, key.lane, section.begin)
    last = key.section == len(sections) - 1
    return LanePosition(key.road, key.lane, section.end if last else _last_in(section))


def _last_in(section: LaneSection) -> float:
    """The last s (m) that belongs to a section before another one."""
    return math.nextafter(section.end, section.begin)


def place_of_odr(road_map: RoadMap, point: OdrPoint) -> LanePosition | opendrive.Pose:
    """Position of a point in road coordinates."""
    try:
        lane = point.lane
        if lane is None:
            pose = road_map.road_pose(point.road_id, point.s, point.t)
            _check_length(road_map, point)
            return pose
        place = LanePosition(point.road_id, lane, point.s)
        road_map.pose(place)
        _check_length(road_map, point)
        left = point.t * road_map.travel_direction(point.road_id, lane)
        return LanePosition(point.road_id, lane, point.s, left)
    except MapError as error:
        raise PlacementError(error.message) from error


def _check_length(road_map: RoadMap, point: OdrPoint) -> None:
    length = road_map.roads[point.road_id].length
    if not -_MISS <= point.s <= length + _MISS:
        raise PlacementError(
            f"road {point.road_id} is {length:.1f} m long, so there is no s = {point.s:g} m"
        )

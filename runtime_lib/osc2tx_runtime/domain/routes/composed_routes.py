"""Routes composed of roads, lanes, crossings and points (DSL 8.5.7).

Each element offers paths through itself: a crossing one, a road one for each of its lanes. The
first paths that can be joined are used. Gaps between lanes for vehicles are filled by a path along
lanes, with lane changes where there is room; other gaps by a straight line. A lane that is entered
or left between its ends, by a crossing or at a point, is used from there or up to there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise

from osc2tx_runtime.domain.map.lane_types import LANE_TYPES
from osc2tx_runtime.domain.map.road_graph import RoadGraph, graph_of
from osc2tx_runtime.domain.map.route_elements import Route
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.paths.path_curves import PathError
from osc2tx_runtime.domain.paths.path_values import NetworkPath, Path
from osc2tx_runtime.domain.points_and_poses import NetworkPoint, Pose, RoadRoute
from osc2tx_runtime.domain.routes.road_paths import way_between
from osc2tx_runtime.enums import ConnectRoutePoints
from osc2tx_runtime.opendrive import DRIVING, LanePosition, RoadMap
from osc2tx_runtime.opendrive import Pose as MapPose
from osc2tx_shared.classes import dataclass, replace

Place = LanePosition | MapPose
Element = Place | MapSegment | Path
"""A point, a part of the map, or a path through poses."""

_STEP = 2.0  # m between points of a path
_NEAR = 0.05  # m: closer positions are equal


@dataclass(frozen=True, slots=True)
class MadeRoute(NetworkPath):
    """A route that a scenario has composed; without its positions.

    Attributes:
        route_elements: Its elements, in order.
        connect_points_by: Meaning of its points.
    """

    route_elements: Sequence[NetworkPoint | Route | Path | RoadRoute] = ()
    connect_points_by: ConnectRoutePoints = "waypoint"


@dataclass(frozen=True)
class _Way:
    """A path through an element.

    Attributes:
        places: Its positions on lanes, or poses.
        lanes: The lanes that it follows, if any.
    """

    places: tuple[Place, ...]
    lanes: tuple[MapSegment, ...] = ()


def poses_of_route(
    road_map: RoadMap, elements: Sequence[Element], connect_by: ConnectRoutePoints = "waypoint"
) -> tuple[Pose, ...]:
    """Poses along a route.

    Args:
        road_map: The map.
        elements: Its elements, in order; at least one with an extent, or two points.
        connect_by: Meaning of a point.

    Raises:
        PathError: An element cannot be reached from the one before.
    """
    graph = graph_of(road_map)
    if not elements:
        raise PathError("the route has no elements")
    parts = [_of_point(graph, each, connect_by) for each in elements]
    offers = [list(_ways(graph, part)) for part, _ in groupby(parts)]  # two points of one lane
    found = _join(graph, offers, [])
    if isinstance(found, PathError):
        raise found
    points: list[Pose] = []
    for place in found:
        pose = place if isinstance(place, MapPose) else road_map.pose(place)
        if not points or math.hypot(pose.x - points[-1].x, pose.y - points[-1].y) > _NEAR:
            points.append(Pose(pose.x, pose.y, pose.z))
    return tuple(points)


# --- elements ---------------------------------------------------------------------------------


def _of_point(graph: RoadGraph, element: Element, connect_by: ConnectRoutePoints) -> Element:
    """The element that a point stands for; other elements unchanged."""
    if not isinstance(element, LanePosition | MapPose) or connect_by == "waypoint":
        return element
    pose = element if isinstance(element, MapPose) else graph.map.pose(element)
    if connect_by == "crossing":
        for crossing in graph.crossings:
            line = crossing.line
            assert line is not None
            along, aside = line.place_of(pose.x, pose.y)
            if 0.0 <= along <= line.length and abs(aside) <= 0.5 * (line.width or 0.0):
                return crossing
        raise PathError(f"there is no crossing at ({pose.x:.1f}, {pose.y:.1f})")
    place = element if isinstance(element, LanePosition) else _on_lane(graph, element)
    if place is None:
        raise PathError(f"there is no lane at ({pose.x:.1f}, {pose.y:.1f})")
    lane = graph.segment_of(graph.map.lane_key(place))
    if connect_by == "lane":
        return lane
    section = lane.section if connect_by == "lane_section" else None
    return MapSegment(connect_by, lane.road, section, forwards=lane.forwards)


def _ways(graph: RoadGraph, element: Element) -> Iterator[_Way]:
    """Paths through an element, in order of trial."""
    match element:
        case LanePosition():
            yield _Way((element,))
        case MapPose():
            yield _Way((_on_lane(graph, element) or element,))
        case Path(points=points):
            yield _Way(tuple(MapPose(p.x, p.y, p.z, p.yaw or 0.0) for p in points))
        case MapSegment(line=line) if line is not None:
            ends = (MapPose(*line.at(s), line.heading) for s in (0.0, line.length))
            yield _Way(tuple(ends))
        case MapSegment(kind="lane"):
            yield _along(graph, (element,))
        case MapSegment(kind="compound_lane", parts=lanes):
            yield _along(graph, lanes)
        case MapSegment(kind="lane_section" | "path"):
            yield from (_along(graph, (lane,)) for lane in graph.lanes_of(element))
        case _:
            yield from (_along(graph, chain) for chain in graph.chains_of(element))


def _on_lane(graph: RoadGraph, pose: MapPose) -> LanePosition | None:
    """The position on a lane, preferably a drivable one; None off the lanes."""
    for types in (DRIVING, LANE_TYPES):
        on = graph.map.locate(pose.x, pose.y, pose.z, lane_types=types, max_distance=1e-3)
        if on is not None:
            return on
    return None


def _along(graph: RoadGraph, lanes: tuple[MapSegment, ...]) -> _Way:
    """The path along the centre lines of lanes."""
    return _Way((graph.begin(lanes[0]), graph.end(lanes[-1])), lanes)


# --- joining ----------------------------------------------------------------------------------


def _join(
    graph: RoadGraph, offers: Sequence[Sequence[_Way]], taken: list[_Way]
) -> list[Place] | PathError:
    """Positions along the first paths that can be joined; else why the last one cannot."""
    failure = PathError("an element of the route cannot be traversed")
    for way in offers[len(taken)]:
        found = _places(graph, [*taken, way])
        if not isinstance(found, PathError) and len(taken) + 1 < len(offers):
            found = _join(graph, offers, [*taken, way])
        if not isinstance(found, PathError):
            return found
        failure = found
    return failure


def _places(graph: RoadGraph, ways: Sequence[_Way]) -> list[Place] | PathError:
    """Positions along paths, with filled gaps."""
    used = [_used(graph, ways, number) for number in range(len(ways))]
    try:
        places = list(_within(graph, used[0]))
        for before, after in pairwise(used):
            places.extend(_between(graph, before.places[-1], after.places[0]))
            places.extend(_within(graph, after))
    except PathError as error:
        return error
    return places


def _used(graph: RoadGraph, ways: Sequence[_Way], number: int) -> _Way:
    """The part of a path from its entry to its exit."""
    way = ways[number]
    if not way.lanes:
        return way
    begin, end = way.places[0], way.places[-1]
    if number > 0:
        begin = _on_way(graph, way, ways[number - 1].places[-1]) or begin
    if number + 1 < len(ways):
        end = _on_way(graph, way, ways[number + 1].places[0]) or end
    return replace(way, places=(begin, end))


def _on_way(graph: RoadGraph, way: _Way, place: Place) -> LanePosition | None:
    """Position of a neighbour on the centre of its lanes; None if it is not on them."""
    keys = {graph.key(lane) for lane in way.lanes}
    if isinstance(place, MapPose):
        types = frozenset(graph.lane(lane).type for lane in way.lanes)
        found = graph.map.locate(place.x, place.y, place.z, lane_types=types, max_distance=_NEAR)
        if found is None:
            return None
        place = found
    if graph.map.lane_key(place) not in keys:
        return None
    return LanePosition(place.road, place.lane, place.s)


def _within(graph: RoadGraph, way: _Way) -> Iterator[Place]:
    """Positions along a path itself."""
    yield way.places[0]
    for before, after in pairwise(way.places):
        if way.lanes:
            yield from _between(graph, before, after)
        yield after


def _between(graph: RoadGraph, before: Place, after: Place) -> Iterator[Place]:
    """Positions between two others: along lanes, else none (a straight line)."""
    if isinstance(before, MapPose) or isinstance(after, MapPose):
        return
    if _same(graph, before, after):
        return
    if graph.map.lane_key(before) == graph.map.lane_key(after) and not _drivable(graph, before):
        count = max(1, math.ceil(abs(after.s - before.s) / _STEP))
        for i in range(1, count):
            s = before.s + (after.s - before.s) * i / count
            offset = before.offset + (after.offset - before.offset) * i / count
            yield LanePosition(before.road, before.lane, s, offset)
    elif _drivable(graph, before) and _drivable(graph, after):
        for pose in way_between(graph.map, before, after)[1:-1]:
            yield MapPose(pose.x, pose.y, pose.z, 0.0)


def _same(graph: RoadGraph, before: LanePosition, after: LanePosition) -> bool:
    one, other = graph.map.pose(before), graph.map.pose(after)
    return math.hypot(one.x - other.x, one.y - other.y) <= _NEAR


def _drivable(graph: RoadGraph, place: LanePosition) -> bool:
    return graph.map.lane_type(place.road, place.lane, place.s) in DRIVING

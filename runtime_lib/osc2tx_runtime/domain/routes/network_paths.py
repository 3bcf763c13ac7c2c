"""Conversion of paths and trajectories through points of the road network to poses.

Scenarios create them before the map is loaded, so the conversion takes place when an action uses
the path.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from osc2tx_runtime.domain.map.geodetic_points import place_of_geodetic
from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.map.roads_and_lanes import Route
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.paths.path_curves import PathError
from osc2tx_runtime.domain.paths.path_values import (
    NetworkPath,
    NetworkTrajectory,
    Path,
    Trajectory,
)
from osc2tx_runtime.domain.points_and_poses import (
    GeodeticPoint,
    NetworkPoint,
    OdrPoint,
    Pose,
    RoadRoute,
    RoutePoint,
    XyzPoint,
)
from osc2tx_runtime.domain.routes.composed_routes import Element, MadeRoute, poses_of_route
from osc2tx_runtime.domain.routes.lane_coordinates import place_of_odr, place_of_route
from osc2tx_runtime.domain.routes.road_paths import way_through, ways_through
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import DRIVING, LanePosition, MapError, RoadMap
from osc2tx_runtime.opendrive import Pose as MapPose


def path_in_world(road_map: RoadMap, path: Path) -> Path:
    """The path through poses.

    Raises:
        PathError: A point is not on the map, or no way along lanes leads to it.
    """
    if not isinstance(path, NetworkPath):
        return path
    if isinstance(path, MadeRoute):
        return _route_in_world(road_map, path)
    places = _places(road_map, path.places)
    if path.on_road_network:
        return Path(way_through(road_map, [_on_lane(road_map, p) for p in places]), "smooth")
    return Path(tuple(_pose(road_map, place) for place in places), path.interpolation)


def _route_in_world(road_map: RoadMap, route: MadeRoute) -> Path:
    elements = [part for each in route.route_elements for part in _elements(road_map, each)]
    poses = poses_of_route(road_map, elements, route.connect_points_by)
    drives = all(not isinstance(each, MapPose) and _is_driven(road_map, each) for each in elements)
    return Path(poses, "smooth" if drives else "straight_line")


def _is_driven(road_map: RoadMap, element: Element) -> bool:
    """Whether an element is on lanes for vehicles: paths along those are smooth."""
    match element:
        case Path():
            return False
        case MapSegment():
            graph = graph_of(road_map)
            lanes = [lane for each in element.parts or (element,) for lane in graph.lanes_of(each)]
            return element.line is None and all(graph.lane(lane).type in DRIVING for lane in lanes)
        case _:
            return isinstance(element, LanePosition)


def _elements(
    road_map: RoadMap, element: NetworkPoint | Route | Path | RoadRoute
) -> Iterator[Element]:
    """The parts of an element of a route; elements in junctions fill gaps in any case."""
    if isinstance(element, Path):
        yield path_in_world(road_map, element)
    elif isinstance(element, Route):
        found = element.found
        parts = found.parts if found.kind == "compound_route" else (found,)
        yield from (part for part in parts if road_map.roads[part.road].junction is None)
    elif isinstance(element, RoadRoute):
        yield _whole(road_map, element)
    else:
        (place,) = _places(road_map, [element])
        yield place


def _whole(road_map: RoadMap, route: RoadRoute) -> MapSegment:
    """The whole road that is the axis of a point, or its lane over the whole road."""
    if route.lane_id is None:
        return MapSegment("road", route.road_id)
    for lane in graph_of(road_map).compound_lanes:
        if (lane.road, lane.lane) == (route.road_id, route.lane_id):
            return lane
    raise PathError(f"road {route.road_id} has no lane {route.lane_id}")


def trajectory_in_world(road_map: RoadMap, trajectory: Trajectory) -> Trajectory:
    """The trajectory through poses.

    Along lanes the time between points is proportional to the distance.

    Raises:
        PathError: A point is not on the map, or no way along lanes leads to it.
    """
    if not isinstance(trajectory, NetworkTrajectory):
        return trajectory
    times = trajectory.time_stamps
    places = _places(road_map, trajectory.places)
    if not trajectory.on_road_network or len(times) != len(places):  # the action reports these
        poses = tuple(_pose(road_map, place) for place in places)
        return Trajectory(poses, times, trajectory.interpolation)
    lanes = [_on_lane(road_map, place) for place in places]
    ways = list(ways_through(road_map, lanes))
    on_way: list[Pose] = [*ways[0][:1]] if ways else []
    stamps: list[float] = [*times[:1]] if ways else []
    for way, (begin, end) in zip(ways, pairwise(times), strict=True):
        steps = len(way) - 1
        on_way.extend(way[1:])
        stamps.extend(begin + (end - begin) * i / steps for i in range(1, steps + 1))
    return Trajectory(tuple(on_way), tuple(stamps), "smooth")


def _places(road_map: RoadMap, points: Sequence[NetworkPoint]) -> list[LanePosition | MapPose]:
    try:
        return [_place(road_map, point) for point in points]
    except (PlacementError, MapError) as error:
        raise PathError(error.message) from error


def _place(road_map: RoadMap, point: NetworkPoint) -> LanePosition | MapPose:
    match point:
        case OdrPoint():
            return place_of_odr(road_map, point)
        case RoutePoint():
            return place_of_route(road_map, point)
        case XyzPoint(position=position):
            return MapPose(position.x, position.y, position.z, 0.0)
        case GeodeticPoint():
            return place_of_geodetic(road_map, point)


def _pose(road_map: RoadMap, place: LanePosition | MapPose) -> Pose:
    there = road_map.pose(place) if isinstance(place, LanePosition) else place
    return Pose(there.x, there.y, there.z)


def _on_lane(road_map: RoadMap, place: LanePosition | MapPose) -> LanePosition:
    if isinstance(place, LanePosition):
        return place
    on = road_map.locate(place.x, place.y, place.z, max_distance=1e-3)
    if on is None:
        raise PathError(f"there is no driving lane at ({place.x:.1f}, {place.y:.1f})")
    return on

"""Paths and trajectories through points of the road network, brought into the world.

Scenarios make them before the map is loaded, so the points stay what they are until an action
uses the path.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from osc2tx_runtime.along import way_through
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap
from osc2tx_runtime.opendrive import Pose as MapPose
from osc2tx_runtime.paths import PathError
from osc2tx_runtime.poses import place_of_odr
from osc2tx_runtime.routes import place_of_route
from osc2tx_runtime.values import (
    NetworkPath,
    NetworkPoint,
    NetworkTrajectory,
    OdrPoint,
    Path,
    Pose,
    RoutePoint,
    Trajectory,
    XyzPoint,
)

__all__ = ["path_in_world", "trajectory_in_world"]


def path_in_world(road_map: RoadMap, path: Path) -> Path:
    """The path through poses.

    Raises:
        PathError: A point is not on the map, or no way along lanes leads to it.
    """
    if not isinstance(path, NetworkPath):
        return path
    places = _places(road_map, path.places)
    if path.on_road_network:
        return Path(way_through(road_map, [_on_lane(road_map, p) for p in places]), "smooth")
    return Path(tuple(_pose(road_map, place) for place in places), path.interpolation)


def trajectory_in_world(road_map: RoadMap, trajectory: Trajectory) -> Trajectory:
    """The trajectory through poses; along lanes the time between points is shared by the way.

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
    ways = [way_through(road_map, pair) for pair in pairwise(lanes)]
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


def _pose(road_map: RoadMap, place: LanePosition | MapPose) -> Pose:
    there = road_map.pose(place) if isinstance(place, LanePosition) else place
    return Pose(there.x, there.y, there.z)


def _on_lane(road_map: RoadMap, place: LanePosition | MapPose) -> LanePosition:
    if isinstance(place, LanePosition):
        return place
    on = road_map.locate(place.x, place.y, place.z, max_distance=1e-3)
    if on is None:
        raise PathError(f"no driving lane is at ({place.x:.1f}, {place.y:.1f})")
    return on

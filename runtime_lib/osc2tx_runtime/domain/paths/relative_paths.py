"""Conversion of relative path points to poses in the world, in a frame of the reference.

- `world_relative`: axes of the world, from its reference point; not for points in s and t;
- `object_relative`: axes of the object, from its reference point; s and t along its lane, t from
  its position in it;
- `lane_relative`: along its lane, and to the left of the lane centre;
- `road_relative`: along the reference line of its road, and to the left of that line.

Points in road coordinates (`odr`) count from the `s` of the reference on its road.

A smooth path in coordinates of a lane or a road is smooth in these coordinates: along a lane at a
constant distance it lies on an arc where the lane does. Straight lines are chords.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from osc2tx_runtime.domain.paths.path_curves import PathError, path_curve
from osc2tx_runtime.domain.paths.path_values import PathPoint
from osc2tx_runtime.domain.points_and_poses import OdrPoint, Pose, RoutePoint
from osc2tx_runtime.enums import PathInterpolation, RelativeTransform
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap
from osc2tx_runtime.opendrive import Pose as MapPose
from osc2tx_runtime.world.state import ActorState

_STRETCH = 2.0  # m between points of a smooth path along a lane


def absolute(
    road_map: RoadMap,
    points: Sequence[PathPoint],
    reference: ActorState,
    transform: RelativeTransform,
    interpolation: PathInterpolation = "straight_line",
) -> tuple[Pose, ...]:
    """Poses in the world of points relative to an object.

    Args:
        road_map: The map.
        points: The points.
        reference: The object.
        transform: The frame of the points.
        interpolation: Of a path; a smooth one along a lane or a road has further points.

    Raises:
        PathError: The reference has no such frame, or a point is beyond its lane.
    """
    try:
        if interpolation == "smooth" and len(points) > 1:
            points = tuple(_smooth(points, transform))
        return tuple(_absolute(road_map, point, reference, transform) for point in points)
    except MapError as error:
        raise PathError(error.message) from error


def _smooth(points: Sequence[PathPoint], transform: RelativeTransform) -> Iterator[PathPoint]:
    """Yield the points of a smooth path, with those between them along a lane or a road."""
    on_route = all(isinstance(each, RoutePoint) for each in points)
    in_frame = [
        Pose(each.s, each.t, 0.0) if isinstance(each, RoutePoint) else each
        for each in points
        if isinstance(each, RoutePoint | Pose)
    ]
    along = on_route or transform in ("lane_relative", "road_relative")
    if not along or len(in_frame) < len(points):
        yield from points
        return
    curve = path_curve(in_frame, "smooth")
    for i, begin in enumerate(curve.knots):
        end = curve.knots[i + 1] if i + 1 < len(curve.knots) else begin
        count = max(math.ceil((end - begin) / _STRETCH), 1)
        for k in range(count):
            at = begin + (end - begin) * k / count
            x, y, z = curve.point(at)
            yield RoutePoint(None, x, y) if on_route else Pose(x, y, z, yaw=curve.yaw(at))


def _absolute(
    road_map: RoadMap, point: PathPoint, reference: ActorState, transform: RelativeTransform
) -> Pose:
    if isinstance(point, OdrPoint):
        return _beside_odr(road_map, point, reference)
    if isinstance(point, RoutePoint):
        if transform == "world_relative":
            raise PathError("points in s and t have no transform world_relative")
        return _beside_route(road_map, point.s, point.t, None, reference, transform)
    match transform:
        case "world_relative":
            c, s, turn = 1.0, 0.0, 0.0
        case "object_relative":
            c, s, turn = math.cos(reference.h), math.sin(reference.h), reference.h
        case _:
            return _beside_route(road_map, point.x, point.y, point.yaw, reference, transform)
    return Pose(
        reference.x + point.x * c - point.y * s,
        reference.y + point.x * s + point.y * c,
        reference.z + point.z,
        yaw=None if point.yaw is None else point.yaw + turn,
    )


def _beside_route(
    road_map: RoadMap,
    s: float,
    t: float,
    yaw: float | None,
    reference: ActorState,
    transform: RelativeTransform,
) -> Pose:
    place = _place(reference)
    if transform == "road_relative":
        there = road_map.road_pose(place.road, _on_road(road_map, place.road, place.s + s), t)
    else:
        aside = t + (place.offset if transform == "object_relative" else 0.0)
        ahead = road_map.advance(LanePosition(place.road, place.lane, place.s), s)
        if abs(ahead.travelled - s) > 1e-6:
            raise PathError(
                f"lane {place.lane} of road {place.road} ends {ahead.travelled:.1f} m on, before"
                f" the point at {s:g} m"
            )
        on = ahead.position
        there = road_map.pose(LanePosition(on.road, on.lane, on.s, aside))
    return _pose(there, yaw)


def _beside_odr(road_map: RoadMap, point: OdrPoint, reference: ActorState) -> Pose:
    place = _place(reference)
    if point.road_id not in ("", place.road):
        raise PathError(f"the reference is on road {place.road}, not on {point.road_id}")
    s = _on_road(road_map, place.road, place.s + point.s)
    lane = point.lane
    if lane is None:
        return _pose(road_map.road_pose(place.road, s, point.t), None)
    left = point.t * road_map.travel_direction(place.road, lane)
    return _pose(road_map.pose(LanePosition(place.road, lane, s, left)), None)


def _place(reference: ActorState) -> LanePosition:
    place = reference.lane_position
    if place is None:
        raise PathError("the reference is on no road, so nothing can be relative to its lane")
    return place


def _on_road(road_map: RoadMap, road: str, s: float) -> float:
    length = road_map.roads[road].length
    if not 0.0 <= s <= length:
        raise PathError(f"road {road} is {length:.1f} m long, so there is no s = {s:.1f} m")
    return s


def _pose(there: MapPose, yaw: float | None) -> Pose:
    return Pose(there.x, there.y, there.z, yaw=None if yaw is None else there.h + yaw)

"""Points of a path along lanes between positions, with lane changes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from osc2tx_runtime.domain.paths.path_curves import PathError
from osc2tx_runtime.domain.points_and_poses import Pose
from osc2tx_runtime.opendrive import LanePosition, RoadMap, Route

_STEP = 2.0  # m between points
_CHANGE = 60.0  # m over which a lane change is spread, if there is room
_LEAST_CHANGE = 15.0  # m


def way_through(road_map: RoadMap, places: Sequence[LanePosition]) -> tuple[Pose, ...]:
    """Points of a path along lanes through positions, in order.

    Raises:
        PathError: A position cannot be reached from the one before.
    """
    points: list[Pose] = []
    for start, goal in pairwise(places):
        part = way_between(road_map, start, goal)
        points.extend(part if not points else part[1:])
    return tuple(points)


def way_between(road_map: RoadMap, start: LanePosition, goal: LanePosition) -> tuple[Pose, ...]:
    """Points of a path along lanes, from the offset of the start to that of the goal.

    A lane change is spread over the last stretch on which both lanes are on one road.

    Raises:
        PathError: There is no path, or no room for the lane change.
    """
    length = road_map.route_distance(start, goal)
    if length is None or length <= 0.0:
        raise PathError(
            f"no route along lanes leads from lane {start.lane} of road {start.road} to lane"
            f" {goal.lane} of road {goal.road}, s = {goal.s:.1f} m"
        )
    route = road_map.route_to(goal)
    count = max(2, math.ceil(length / _STEP))
    distances = [length * i / count for i in range(count + 1)]
    forth = _walk(road_map, LanePosition(start.road, start.lane, start.s), distances, route)
    back = _walk(
        road_map, LanePosition(goal.road, goal.lane, goal.s), [d - length for d in distances], None
    )
    first, last = _window(road_map, forth, back, distances)
    points = []
    for distance, here, there in zip(distances, forth, back, strict=True):
        w = 0.0 if distance <= first else 1.0
        if first < distance < last:
            w = _smooth((distance - first) / (last - first))
        end = _smooth(distance / length)
        aside = start.offset + end * (goal.offset - start.offset)
        a, b = (
            road_map.pose(LanePosition(p.road, p.lane, p.s, aside)) if p is not None else None
            for p in (here, there)
        )
        a, b = a or b, b or a
        assert a is not None and b is not None  # the window lies where both exist
        points.append(Pose(a.x + w * (b.x - a.x), a.y + w * (b.y - a.y), a.z + w * (b.z - a.z)))
    return tuple(points)


def _walk(
    road_map: RoadMap, start: LanePosition, distances: Sequence[float], route: Route | None
) -> list[LanePosition | None]:
    """Positions along the lane; None after its end."""
    steps = [road_map.advance(start, distance, route) for distance in distances]
    return [
        step.position if abs(step.travelled - distance) < 1e-3 else None
        for step, distance in zip(steps, distances, strict=True)
    ]


def _window(
    road_map: RoadMap,
    forth: Sequence[LanePosition | None],
    back: Sequence[LanePosition | None],
    distances: Sequence[float],
) -> tuple[float, float]:
    """Distances between which the lane change takes place."""
    same = [
        a is not None and b is not None and a.road == b.road
        for a, b in zip(forth, back, strict=True)
    ]
    last = len(same) - 1
    while last >= 0 and not same[last]:
        last -= 1
    first = last
    while first > 0 and same[first - 1]:
        first -= 1
    if last < 0 or any(p is None for p in forth[:first]) or any(p is None for p in back[last:]):
        raise PathError("the route along lanes is not connected")
    at_end, goal = forth[last], back[last]
    assert at_end is not None and goal is not None
    if at_end.lane == goal.lane:
        return distances[last], distances[last]  # the same lane: nothing to change
    end = distances[last]
    begin = max(distances[first], end - _CHANGE)
    if end - begin < _LEAST_CHANGE:
        raise PathError(
            f"there are only {end - begin:.1f} m to change from lane {at_end.lane} to lane"
            f" {goal.lane} of road {goal.road}"
        )
    return begin, end


def _smooth(tau: float) -> float:
    return tau**3 * (10.0 + tau * (6.0 * tau - 15.0))

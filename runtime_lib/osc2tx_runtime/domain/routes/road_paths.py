"""Points of a path along lanes between positions, with lane changes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from osc2tx_runtime import opendrive
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
    for part in ways_through(road_map, places):
        points.extend(part if not points else part[1:])
    return tuple(points)


def ways_through(road_map: RoadMap, places: Sequence[LanePosition]) -> Iterator[tuple[Pose, ...]]:
    """The parts of such a path, from each position to the next.

    It follows the lanes in their direction of travel, except for lanes of the same road that carry
    oncoming traffic: it moves over to a position ahead in such a lane, and on along it, as for
    overtaking.

    Raises:
        PathError: A position cannot be reached from the one before.
    """
    sense = 0
    for start, goal in pairwise(places):
        own, other = (road_map.travel_direction(each.road, each.lane) for each in (start, goal))
        sense = sense or own
        is_ahead = start.road == goal.road and (goal.s - start.s) * sense > 0.0
        if is_ahead and (own != sense or other != sense):
            yield _along_road(road_map, start, goal)
            continue
        if own != sense:
            raise PathError(
                f"lane {start.lane} of road {start.road} carries oncoming traffic: a path leaves it"
                " only towards a position ahead on the same road"
            )
        yield way_between(road_map, start, goal)
        sense = other


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
        points.append(_between(a, b, w))
    return tuple(points)


def _along_road(road_map: RoadMap, start: LanePosition, goal: LanePosition) -> tuple[Pose, ...]:
    """Points of a path along a road, of whose lanes one at least carries oncoming traffic."""
    length = abs(goal.s - start.s)
    begin = 0.0 if start.lane == goal.lane else max(0.0, length - _CHANGE)
    if length - begin < _LEAST_CHANGE and start.lane != goal.lane:
        raise _too_short(length - begin, start, goal)
    count = max(2, math.ceil(length / _STEP))
    points = []
    for i in range(count + 1):
        distance = length * i / count
        s = start.s + (goal.s - start.s) * i / count
        a, b = (road_map.pose(LanePosition(p.road, p.lane, s, p.offset)) for p in (start, goal))
        w = _smooth(max(0.0, (distance - begin) / (length - begin)))
        points.append(_between(a, b, w))
    return tuple(points)


def _too_short(room: float, start: LanePosition, goal: LanePosition) -> PathError:
    return PathError(
        f"there are only {room:.1f} m to change from lane {start.lane} to lane {goal.lane} of road"
        f" {goal.road}"
    )


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
        raise _too_short(end - begin, at_end, goal)
    return begin, end


def _between(a: opendrive.Pose, b: opendrive.Pose, share: float) -> Pose:
    x, y, z = (start + share * (end - start) for start, end in ((a.x, b.x), (a.y, b.y), (a.z, b.z)))
    return Pose(x, y, z)


def _smooth(tau: float) -> float:
    return tau**3 * (10.0 + tau * (6.0 * tau - 15.0))

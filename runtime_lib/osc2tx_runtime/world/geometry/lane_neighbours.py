"""Neighbouring lanes: numbers, neighbours, offsets between them."""

from __future__ import annotations

import math
from collections.abc import Iterator

from osc2tx_runtime.enums import SideLeftRight
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap


def lane_with_number(
    road_map: RoadMap, place: LanePosition, number: int, edge: SideLeftRight
) -> LanePosition | None:
    """Centre of the lane with a number (1: outermost on `edge`), abreast of `place`."""
    lanes = road_map.lanes(place.road, place.s, like=place.lane)
    if not 1 <= number <= len(lanes):
        return None
    lane = lanes[number - 1] if edge == "right" else lanes[-number]
    return place._replace(lane=lane, offset=0.0)  # the same `s`: a number of XML has its origin


def number_of_lane(road_map: RoadMap, place: LanePosition, edge: SideLeftRight) -> int:
    """Number of the lane of `place`, counted from `edge`; 0 if it is not a driving lane."""
    lanes = road_map.lanes(place.road, place.s, like=place.lane)
    if place.lane not in lanes:
        return 0
    index = lanes.index(place.lane)
    return index + 1 if edge == "right" else len(lanes) - index


def lanes_to_left(road_map: RoadMap, place: LanePosition, lane: LanePosition) -> int:
    """Number of driving lanes from `place` to the left to `lane`; negative: to the right.

    On different roads both are counted from the right edge.

    Raises:
        ScenarioError: One of them is not a driving lane, or they are opposite lanes of one road
            with another lane between them.
    """
    numbers = [number_of_lane(road_map, each, "right") for each in (lane, place)]
    for each, number in zip((lane, place), numbers, strict=True):
        if number == 0:
            raise ScenarioError(f"lane {each.lane} of road {each.road} is not a driving lane")
    over, beyond = _lanes_beyond(road_map, lane), _lanes_beyond(road_map, place)
    if not are_opposed(road_map, place, lane):
        return numbers[0] + over - numbers[1] - beyond
    for lanes, found in _around(road_map, place):
        if found.lane == lane.lane:
            return lanes - over - beyond
    raise ScenarioError(
        f"lane {lane.lane} of road {lane.road} is not a driving lane beside lane {place.lane}"
    )


def are_opposed(road_map: RoadMap, place: LanePosition, other: LanePosition) -> bool:
    """Whether two positions on one road are on lanes of opposite direction."""
    ways = [road_map.travel_direction(each.road, each.lane) for each in (place, other)]
    return place.road == other.road and ways[0] != ways[1]


def lane_beside(road_map: RoadMap, place: LanePosition, lanes: int) -> LanePosition | None:
    """Centre of the driving lane `count` lanes to the left of a position; None without one.

    An actor in a lane of oncoming traffic continues in its own direction: that lane is given as an
    offset from the innermost lane of the own direction, which then counts as the lane of the actor.

    Args:
        road_map: The map.
        place: In a driving lane, or beside the innermost one in a lane of oncoming traffic.
        lanes: Number of lanes; negative: to the right.
    """
    beyond = _lanes_beyond(road_map, place)
    wanted = beyond + lanes
    target = _beside(road_map, place, wanted)
    own = LanePosition(place.road, place.lane, place.s)
    if target is None and wanted * beyond > 0 and abs(wanted) <= abs(beyond):
        return own._replace(offset=wanted * road_map.lane_width(own.road, own.lane, own.s))
    if target is None or not are_opposed(road_map, place, target):
        return target
    step = 1 if wanted > 0 else -1
    while (further := road_map.neighbour(own, _side(step))) is not None:
        own = further
    centre = road_map.pose(target)
    return own._replace(offset=offset_from(road_map, own, centre.x, centre.y))


def actual_lane(road_map: RoadMap, place: LanePosition) -> LanePosition:
    """Centre of the actual lane of a position, which may be one of oncoming traffic."""
    lane = _beside(road_map, place, _lanes_beyond(road_map, place))
    return LanePosition(place.road, place.lane, place.s) if lane is None else lane


def seen_along(road_map: RoadMap, place: LanePosition, heading: float) -> LanePosition:
    """A position on a road from the perspective of an actor with a heading (rad).

    In a lane of oncoming traffic it is relative to the innermost lane of the own direction (as in
    `lane_beside`); without such a lane it is unchanged.
    """
    pose = road_map.pose(place)
    if math.cos(heading - pose.h) >= 0.0:
        return place
    for _, own in _around(road_map, place):
        if are_opposed(road_map, place, own):
            return own._replace(offset=offset_from(road_map, own, pose.x, pose.y))
    return place


def width_at(road_map: RoadMap, place: LanePosition) -> float:
    """Width (m) of the actual lane of a position, which may be one of oncoming traffic."""
    lane = actual_lane(road_map, place)
    return road_map.lane_width(lane.road, lane.lane, lane.s)


def offset_from(road_map: RoadMap, lane: LanePosition, x: float, y: float) -> float:
    """Distance (m) of a point to the left of a lane centre, along the surface."""
    centre = road_map.pose(lane)
    left = (y - centre.y) * math.cos(centre.h) - (x - centre.x) * math.sin(centre.h)
    return left / math.cos(centre.roll) if centre.roll else left


def lane_under(road_map: RoadMap, bound: LanePosition, pose: Pose) -> LanePosition:
    """The lane under the reference point: during a lane change beside the bound lane."""
    while True:
        half = 0.5 * road_map.lane_width(bound.road, bound.lane, bound.s)
        if abs(bound.offset) <= half:
            return bound
        beside = road_map.neighbour(bound, "left" if bound.offset > 0.0 else "right")
        if beside is None:
            return bound
        offset = offset_from(road_map, beside, pose.x, pose.y)
        if abs(offset) >= abs(bound.offset):
            return bound
        bound = LanePosition(beside.road, beside.lane, beside.s, offset)


def _side(lanes: int) -> SideLeftRight:
    return "left" if lanes > 0 else "right"


def _beside(road_map: RoadMap, place: LanePosition, lanes: int) -> LanePosition | None:
    """Centre of the driving lane a number of lanes to the left of a position, of any direction."""
    if lanes == 0:
        return LanePosition(place.road, place.lane, place.s)
    return road_map.neighbour(place, _side(lanes), abs(lanes), either_way=True)


def _around(road_map: RoadMap, place: LanePosition) -> Iterator[tuple[int, LanePosition]]:
    """Yield the lanes beside a position, of any direction, nearest first, with their number."""
    for lanes in range(1, len(road_map.roads[place.road].section_at(place.s).lanes)):
        for signed in (lanes, -lanes):
            lane = _beside(road_map, place, signed)
            if lane is not None:
                yield signed, lane


def _lanes_beyond(road_map: RoadMap, place: LanePosition) -> int:
    """Number of lanes of oncoming traffic between the offset of a position and its lane.

    In junctions, whose roads have no such lanes, the width of its own lane counts.
    """
    width = road_map.lane_width(place.road, place.lane, place.s)
    if abs(place.offset) <= 0.5 * width:
        return 0
    here, lanes, apart = road_map.pose(place), 0, abs(place.offset)
    step = 1 if place.offset > 0.0 else -1
    while True:
        further = _beside(road_map, place, lanes + step)
        if further is None and lanes == 0 and road_map.roads[place.road].junction is not None:
            return round(place.offset / width)
        if further is None or not are_opposed(road_map, place, further):
            return lanes
        nearer = abs(offset_from(road_map, further, here.x, here.y))
        if nearer >= apart:
            return lanes
        lanes, apart = lanes + step, nearer

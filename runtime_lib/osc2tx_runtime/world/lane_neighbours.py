"""Neighbouring lanes: numbers, neighbours, offsets between them."""

from __future__ import annotations

import math

from osc2tx_runtime.enums import SideLeftRight
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap

__all__ = [
    "lane_under",
    "lane_with_number",
    "lanes_to_left",
    "neighbouring",
    "number_of_lane",
    "offset_from",
]


def lane_with_number(
    road_map: RoadMap, place: LanePosition, number: int, edge: SideLeftRight
) -> LanePosition | None:
    """Centre of the lane with a number (1: outermost on `edge`), at the height of `place`."""
    lanes = road_map.lanes(place.road, place.s, like=place.lane)
    if not 1 <= number <= len(lanes):
        return None
    lane = lanes[number - 1] if edge == "right" else lanes[-number]
    return LanePosition(place.road, lane, place.s)


def number_of_lane(road_map: RoadMap, place: LanePosition, edge: SideLeftRight) -> int:
    """Number of the lane of `place`, counted from `edge`; 0 if it is no driving lane."""
    lanes = road_map.lanes(place.road, place.s, like=place.lane)
    if place.lane not in lanes:
        return 0
    index = lanes.index(place.lane)
    return index + 1 if edge == "right" else len(lanes) - index


def lanes_to_left(road_map: RoadMap, place: LanePosition, lane: LanePosition) -> int:
    """How many driving lanes `lane` is to the left of `place`; negative: to the right.

    On different roads both are counted from the right edge.

    Raises:
        ScenarioError: One of them is no driving lane.
    """
    numbers = [number_of_lane(road_map, each, "right") for each in (lane, place)]
    for each, number in zip((lane, place), numbers, strict=True):
        if number == 0:
            raise ScenarioError(f"lane {each.lane} of road {each.road} is no driving lane")
    return numbers[0] - numbers[1]


def neighbouring(road_map: RoadMap, place: LanePosition, lanes: int) -> LanePosition | None:
    """The drivable lane so many to the left (negative: right) of a place; None without one."""
    if lanes == 0:
        return place
    return road_map.neighbour(place, "left" if lanes > 0 else "right", abs(lanes))


def offset_from(road_map: RoadMap, lane: LanePosition, x: float, y: float) -> float:
    """How far (m) a point is to the left of the centre of a lane, along its surface."""
    centre = road_map.pose(lane)
    left = (y - centre.y) * math.cos(centre.h) - (x - centre.x) * math.sin(centre.h)
    return left / math.cos(centre.roll) if centre.roll else left


def lane_under(road_map: RoadMap, bound: LanePosition, pose: Pose) -> LanePosition:
    """The lane under the reference point: beside the bound one during a lane change."""
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

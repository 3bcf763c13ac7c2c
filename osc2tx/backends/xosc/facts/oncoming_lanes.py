"""Lanes of oncoming traffic, as places beside the innermost lane of the own direction."""

from __future__ import annotations

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.opendrive.model import LaneKey
from osc2tx_runtime.world.geometry.lane_neighbours import actual_lane, lane_beside

CLOSE = 5.0
"""Metres between places where a lane is looked at."""

SAME_PLACE = 0.01
"""Metres: less is no difference."""


def is_oncoming(road_map: RoadMap, place: LanePosition) -> bool:
    """Whether a place is by its offset in a lane of oncoming traffic."""
    return actual_lane(road_map, place).lane != place.lane


def number_of_oncoming(road_map: RoadMap, place: LanePosition) -> int | None:
    """Return the number of a lane of oncoming traffic; `None` if it does not stay beside its own.

    It does if both numbers and the distance stay the same on all of the way ahead.
    """
    number = actual_lane(road_map, place).lane
    ahead = [road_map.lane_key(place)]
    for key in ahead:
        if key.lane != place.lane or not _is_beside(road_map, key, number, place.offset):
            return None
        ahead += [each for each in road_map.successors(key) if each not in ahead]
    return number


def _is_beside(road_map: RoadMap, own: LaneKey, number: int, offset: float) -> bool:
    """Whether a lane has another one so far (m) to its left along all of its length."""
    section = road_map.roads[own.road].sections[own.section]
    length = section.end - section.begin
    steps = max(1, round(length / CLOSE))
    for i in range(steps + 1):
        there = LanePosition(own.road, own.lane, section.begin + length * (i / steps), offset)
        centre = lane_beside(road_map, there, 0)
        if centre is None or actual_lane(road_map, there).lane != number:
            return False
        if abs(centre.offset - offset) > SAME_PLACE:
            return False
    return True

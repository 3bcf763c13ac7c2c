"""Search for the next actor ahead on the route."""

from __future__ import annotations

import math
from collections.abc import Iterable

from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.world.state import ActorState

from .collision import box_of
from .distances import along_lanes, lateral_straight_on

_SIGHT = 60.0  # m
_SIGHT_TIME = 6.0  # s at the own speed, added
_HEIGHT = 3.0  # m: a larger difference in height is another level
_BESIDE = 0.3  # m: lateral clearance


def nearest_ahead(
    road_map: RoadMap, me: ActorState, others: Iterable[ActorState], visual_range: float = math.inf
) -> tuple[float, float] | None:
    """Free distance (m) to the nearest actor ahead, and its speed (m/s) along the path.

    The path is the lane with the own width for actors on a lane, else the own axis. An actor counts
    if its box overlaps the path.

    Args:
        road_map: The map.
        me: The observer; it may be among the others.
        others: All actors.
        visual_range: Metres from the front beyond which no actor is seen.
    """
    sight = _SIGHT + _SIGHT_TIME * abs(me.v)
    best: tuple[float, float] | None = None
    for other in others:
        if other is me or abs(other.z - me.z) > _HEIGHT:
            continue
        if math.hypot(other.x - me.x, other.y - me.y) > sight:
            continue
        place = _on_way(road_map, me, other)
        if place is None:
            continue
        along, aside, turn = place
        reach_along, reach_aside = _extent(other, turn)
        if along <= 0.0 or abs(aside) > 0.5 * me.width + reach_aside + _BESIDE:
            continue
        gap = along - reach_along - me.shape.front
        if gap > visual_range:
            continue
        if best is None or gap < best[0]:
            best = (gap, other.v * math.cos(turn))
    return best


def _extent(other: ActorState, turn: float) -> tuple[float, float]:
    """Half extents (m) of a box along and across the path."""
    c, s = abs(math.cos(turn)), abs(math.sin(turn))
    half, width = 0.5 * other.length, 0.5 * other.width
    return half * c + width * s, half * s + width * c


def _on_way(
    road_map: RoadMap, me: ActorState, other: ActorState
) -> tuple[float, float, float] | None:
    """Centre of the other box: along (m), to the left (m), and its heading."""
    place = me.lane_position
    box = box_of(other)
    if place is not None:
        along, aside = along_lanes(road_map, me, other), lateral_straight_on(road_map, me, other)
        if along is None or aside is None:
            return None
        there = road_map.pose(road_map.advance(place, along).position).h
    else:
        dx, dy = other.x - me.x, other.y - me.y
        along = dx * math.cos(me.h) + dy * math.sin(me.h)
        aside = dy * math.cos(me.h) - dx * math.sin(me.h)
        there = me.h
    dx, dy = box.x - other.x, box.y - other.y
    return (
        along + dx * math.cos(there) + dy * math.sin(there),
        aside - dx * math.sin(there) + dy * math.cos(there),
        other.h - there,
    )

"""Distances along and across roads and lanes, against closed forms: arcs, junctions, oncoming."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import ActorState
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.measuring.distances import (
    across_road,
    along_lanes,
    along_own_lane,
    along_road,
    lateral_on_road,
)

RADIUS, BANK = 120.0, 0.05  # m, rad: of the arc in `curve` from 125 m on, which turns left
LANE = 3.5  # m

Load = Callable[[str], RoadMap]


def at(road_map: RoadMap, road: str, lane: int, s: float, offset: float = 0.0) -> ActorState:
    place = LanePosition(road, lane, s, offset)
    x, y, z, h, *_ = road_map.pose(place)
    return ActorState(x, y, z, h, 0.0, 0.0, place, 0.0, Shape(5.0, 2.0, 1.5, 1.0))


def on_arc(length: float, t: float) -> float:
    """Length (m) beside a piece of the reference line, which turns left, at t on its bank."""
    return length * (1.0 - t * math.cos(BANK) / RADIUS)


@pytest.mark.parametrize("other", [-1, -2, 1, 2])
@pytest.mark.parametrize("lane", [-1, -2])
def test_on_an_arc(load_map: Load, lane: int, other: int) -> None:
    road_map = load_map("curve")
    a, b = at(road_map, "1", lane, 160.0), at(road_map, "1", other, 200.0)
    t = (lane + 0.5) * LANE
    there = (other + (0.5 if other < 0 else -0.5)) * LANE
    assert along_road(road_map, a, b) == pytest.approx(40.0)
    assert across_road(road_map, a, b) == pytest.approx(there - t, abs=1e-6)
    # in the lane of the caller, whatever lane the other is in
    assert along_own_lane(road_map, a, b) == pytest.approx(on_arc(40.0, t), abs=2e-3)
    assert lateral_on_road(road_map, a, b) == pytest.approx(there - t, abs=1e-6)


def test_who_comes_the_other_way_sees_it_mirrored(load_map: Load) -> None:
    road_map = load_map("curve")
    a, b = at(road_map, "1", -1, 160.0), at(road_map, "1", 1, 200.0)
    assert along_road(road_map, b, a) == pytest.approx(40.0)
    assert across_road(road_map, b, a) == pytest.approx(LANE)
    assert along_own_lane(road_map, b, a) == pytest.approx(on_arc(40.0, 0.5 * LANE), abs=2e-3)
    assert lateral_on_road(road_map, b, a) == pytest.approx(LANE, abs=1e-6)
    assert along_lanes(road_map, a, b) is None  # no way leads there


def test_an_offset_counts_across(load_map: Load) -> None:
    road_map = load_map("curve")
    a, b = at(road_map, "1", -1, 160.0, 0.3), at(road_map, "1", 1, 200.0, 0.5)
    wanted = LANE - 0.5 - 0.3  # the offset of b is to its own left, which is towards a
    assert across_road(road_map, a, b) == pytest.approx(wanted, abs=1e-6)
    assert lateral_on_road(road_map, a, b) == pytest.approx(wanted, abs=1e-6)


def lanes_out(road_map: RoadMap, connection: str) -> tuple[LanePosition, LanePosition]:
    """The ends of the first lane of a road within a junction."""
    road = road_map.roads[connection]
    return LanePosition(connection, -1, 0.0), LanePosition(connection, -1, road.length)


@pytest.mark.parametrize("connection", ["11", "21", "12", "22", "32", "42", "10", "20"])
def test_across_a_junction(load_map: Load, connection: str) -> None:
    """Straight on it is the straight distance; a turn is a quarter of a circle."""
    road_map = load_map("urban_crossing")
    begin, end = (road_map.pose(place) for place in lanes_out(road_map, connection))
    dx, dy = end.x - begin.x, end.y - begin.y
    turn = math.remainder(end.h - begin.h, math.tau)
    way = math.hypot(dx, dy) if abs(turn) < 1e-6 else 0.5 * math.pi * min(abs(dx), abs(dy))
    if abs(turn) > 1e-6:
        assert abs(dx) == pytest.approx(abs(dy), abs=1e-3)
        assert abs(turn) == pytest.approx(0.5 * math.pi, abs=1e-6)
    enters = road_map.advance(lanes_out(road_map, connection)[0], -10.0).position
    leaves = road_map.advance(lanes_out(road_map, connection)[1], 15.0).position
    a = at(road_map, *enters[:3])
    b = at(road_map, *leaves[:3])
    assert (a.x, a.y) == pytest.approx(
        (begin.x - 10.0 * math.cos(begin.h), begin.y - 10.0 * math.sin(begin.h)), abs=1e-6
    )
    assert along_road(road_map, a, b) is None
    assert along_own_lane(road_map, a, b) == pytest.approx(10.0 + way + 15.0, abs=1e-3)
    assert along_own_lane(road_map, b, a) == pytest.approx(-25.0 - way, abs=1e-3)
    assert lateral_on_road(road_map, a, b) == pytest.approx(0.0, abs=1e-3)
    assert lateral_on_road(road_map, b, a) == pytest.approx(0.0, abs=1e-3)

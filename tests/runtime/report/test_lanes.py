"""Which lanes the report draws, and how they are packed."""

import math
from dataclasses import replace

import pytest

from osc2tx_runtime.report.nearby_lanes import nearby_crosswalks, nearby_lanes
from tests.runtime.report.conftest import Zebra


def unpack(packed: list[int]) -> list[tuple[float, float]]:
    points, x, y = [], 0, 0
    for dx, dy in zip(packed[::2], packed[1::2], strict=True):
        x, y = x + dx, y + dy
        points.append((x / 100, y / 100))
    return points


def test_lanes_are_clipped_to_the_paths(highway_map) -> None:
    lanes = nearby_lanes(highway_map, [[(1000.0 + 10 * i, -5.0) for i in range(21)]])
    assert len(lanes) == 8
    xs = [x for lane in lanes for x, _ in unpack(lane["left"])]
    assert 850 < min(xs) <= 900
    assert 1300 <= max(xs) < 1350


def test_straight_lane_needs_two_stations(highway_map) -> None:
    lanes = nearby_lanes(highway_map, [[(1000.0, -5.0)]])
    assert {len(lane["left"]) for lane in lanes} == {4}


def test_curved_lane_keeps_its_shape(highway_map) -> None:
    radius = 100.0
    highway_map.centre = lambda s: (
        radius * math.sin(s / radius),
        radius - radius * math.cos(s / radius),
        s / radius,
    )
    highway_map.length = 120.0
    lane = next(lane for lane in nearby_lanes(highway_map, [[(0.0, 0.0)]]) if lane["lane"] == -1)
    points = unpack(lane["left"])
    assert 10 < len(points) < 40
    for x, y in points:
        assert math.hypot(x, y - radius) == pytest.approx(radius, abs=0.01)


def test_neighbours_and_direction(highway_map) -> None:
    lanes = {lane["lane"]: lane for lane in nearby_lanes(highway_map, [[(100.0, 0.0)]])}
    assert (lanes[-2]["inner"], lanes[-2]["outer"]) == ("driving", "driving")
    assert lanes[-4]["outer"] == "shoulder"
    assert lanes[-5]["outer"] is None
    assert lanes[2]["outer"] == "shoulder"
    assert lanes[1]["inner"] is None
    assert (lanes[2]["dir"], lanes[-2]["dir"]) == (-1, 1)


def test_no_paths_no_lanes(highway_map) -> None:
    assert nearby_lanes(highway_map, []) == []


def test_invisible_lanes_are_left_out(highway_map) -> None:
    highway_map.lanes = {-1: ("driving", 3.5), -2: ("none", 2.0)}
    assert [lane["lane"] for lane in nearby_lanes(highway_map, [[(0.0, 0.0)]])] == [-1]


def test_crosswalks_near_the_paths(highway_map) -> None:
    near, far = Zebra(60.0, -5.0, 1.5708, 7.0, 3.0), Zebra(900.0, 0.0)
    line = Zebra(50.0, 0.0, width=0.0)
    road_map = replace(highway_map, zebras=(near, far, line))
    assert nearby_crosswalks(road_map, [[(0.0, 0.0), (40.0, 0.0)]]) == [[60, -5, 1.571, 7, 3]]
    assert nearby_crosswalks(road_map, []) == []

"""The maps that ship with the runtime library."""

import importlib.util
import math
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx_runtime.opendrive import DRIVING, LaneKey, LanePosition, RoadMap
from tests.runtime.opendrive.conftest import OWN_MAPS

Own = Callable[[str], RoadMap]
TOOL = Path(__file__).resolve().parents[3] / "tools" / "make_maps.py"
NAMES = ("crossing", "curve", "highway", "left_hand", "merge", "urban_crossing")


def test_maps_are_what_the_tool_writes(tmp_path: Path) -> None:
    spec = importlib.util.spec_from_file_location("make_maps", TOOL)
    assert spec is not None and spec.loader is not None
    tool = importlib.util.module_from_spec(spec)
    sys.modules["make_maps"] = tool  # dataclasses look their module up
    try:
        spec.loader.exec_module(tool)
        tool.main([str(tmp_path)])
    finally:
        del sys.modules["make_maps"]
    written = sorted(path.name for path in tmp_path.iterdir())
    assert written == sorted(path.name for path in OWN_MAPS.glob("*.xodr"))
    for name in written:
        assert (tmp_path / name).read_bytes() == (OWN_MAPS / name).read_bytes(), name


@pytest.mark.parametrize("name", NAMES)
def test_lanes_join_without_gaps(own: Own, name: str) -> None:
    road_map = own(name)
    for road in road_map.roads.values():
        for section in road.sections:
            for lane in section.lanes.values():
                for onward in road_map.successors(lane.key):
                    end = section.end if lane.direction > 0 else section.begin
                    following = road_map.roads[onward.road].sections[onward.section]
                    forwards = road_map.travel_direction(onward.road, onward.lane) > 0
                    begin = following.begin if forwards else following.end
                    gap, turn = _joint(road_map, lane.key, end, onward, begin)
                    assert gap < 1e-5 and turn < 1e-6, (lane.key, onward)


def _joint(
    road_map: RoadMap, a: LaneKey, s_a: float, b: LaneKey, s_b: float
) -> tuple[float, float]:
    inset = 1e-7
    section_a = road_map.roads[a.road].sections[a.section]
    section_b = road_map.roads[b.road].sections[b.section]
    s_a = min(max(s_a, section_a.begin + inset), section_a.end - inset)
    s_b = min(max(s_b, section_b.begin + inset), section_b.end - inset)
    one = road_map.pose(LanePosition(a.road, a.lane, s_a))
    two = road_map.pose(LanePosition(b.road, b.lane, s_b))
    turn = abs(math.sin((one.h - two.h) / 2.0))
    return math.hypot(one.x - two.x, one.y - two.y), turn


def test_highway(own: Own) -> None:
    road = own("highway")
    assert road.lanes("1", 600.0) == (-4, -3, -2, -1)
    assert road.lanes("1", 600.0, like=2) == (3, 2, 1)
    assert road.lane_type("1", -5, 10.0) == "shoulder"
    assert road.roads["1"].length == pytest.approx(2000.0)
    assert road.pose(LanePosition("1", -1, 1290.0)).h == pytest.approx(0.0)
    assert road.neighbour(LanePosition("1", -1, 5.0, 0.3), "right") == LanePosition("1", -2, 5.0)
    assert road.neighbour(LanePosition("1", -1, 5.0), "left") is None
    assert road.neighbour(LanePosition("1", -4, 5.0), "right") is None
    assert road.neighbour(LanePosition("1", 1, 5.0), "right", 2) == LanePosition("1", 3, 5.0)


def test_urban_crossing(own: Own) -> None:
    road = own("urban_crossing")
    assert len(road.signals()) == 8
    assert [c.signals for c in road.controllers()] == [("101", "103"), ("102", "104")]
    assert all(c.junctions == ("9",) for c in road.controllers())
    ways = {key.road for key in road.successors(LaneKey("1", 0, -1))}
    assert ways == {"11", "12"}
    start = LanePosition("1", -1, 100.0)
    straight = road.advance(start, 120.0).position
    assert straight.road == "3"
    for goal in ("2", "3", "4"):
        route = road.route_to(LanePosition(goal, 1, 100.0))
        beside = LanePosition("1", -2, 100.0)
        assert route.distance(start) is not None and route.distance(beside) is not None
    left = road.route_to(LanePosition("2", 1, 60.0))
    right = road.route_to(LanePosition("4", 2, 60.0))
    ends = {road.advance(start, 120.0, route).position.road for route in (left, right)}
    assert ends <= {"2", "3", "4"} and len(ends) == 2


def test_merge(own: Own) -> None:
    road = own("merge")
    ramp = road.advance(LanePosition("3", -1, 10.0), 300.0).position
    assert (ramp.road, ramp.lane) == ("2", -3)
    end = road.advance(LanePosition("3", -1, 10.0), 1000.0)
    assert end.travelled < 1000.0 and end.position.s == pytest.approx(300.0)
    assert road.route_distance(LanePosition("3", -1, 10.0), LanePosition("2", -1, 400.0))
    assert road.lanes("2", 299.99) == (-2, -1)
    assert road.lane_type("2", -3, 100.0) == "entry"


def test_curve_has_height_and_roll(own: Own) -> None:
    road = own("curve")
    pose = road.pose(LanePosition("1", -1, 210.0))
    assert pose.z > 3.0 and pose.roll == pytest.approx(-0.05) and pose.pitch < 0.0


def test_left_hand(own: Own) -> None:
    road = own("left_hand")
    assert road.lanes("1", 100.0) == (1, 2)  # from the right edge: the inner lane comes first
    assert road.lanes("1", 100.0, like=-1) == (-1, -2)
    assert road.neighbour(LanePosition("1", 1, 100.0), "left") == LanePosition("1", 2, 100.0)


def test_crossing_pavements(own: Own) -> None:
    road = own("crossing")
    assert road.lane_type("1", -2, 250.0) == "sidewalk"
    assert road.lanes("1", 250.0) == (-1,)
    assert road.locate(250.0, -4.75, lane_types=frozenset({"sidewalk"})) == LanePosition(
        "1", -2, 250.0, pytest.approx(0.0, abs=1e-9)
    )
    nearest = road.locate(250.0, -8.0)
    assert nearest is not None and nearest.lane == -1 and nearest.offset == pytest.approx(-6.25)
    assert road.locate(250.0, -200.0) is None


@pytest.mark.parametrize("name", NAMES)
def test_spawn_points_and_outlines(own: Own, name: str) -> None:
    road = own(name)
    points = road.spawn_points()
    assert points and points[0].road == "1"
    assert all(road.lane_type(p.road, p.lane, p.s) in DRIVING for p in points)
    assert all(road.roads[p.road].junction is None for p in points)
    xmin, ymin, xmax, ymax = road.bounds()
    outlines = list(road.lane_outlines())
    for outline in outlines:
        assert len(outline.left) == len(outline.right) > 1
        for x, y in outline.left + outline.right:
            assert xmin - 0.5 <= x <= xmax + 0.5 and ymin - 0.5 <= y <= ymax + 0.5
    assert list(road.lane_outlines((1e6, 1e6, 2e6, 2e6))) == []

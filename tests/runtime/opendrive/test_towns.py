"""Facts about third-party maps; skipped without the test data."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from lxml import etree

from osc2tx_runtime.opendrive import LaneKey, LanePosition, RoadMap, read_map

Load = Callable[[str], RoadMap]


@pytest.mark.slow
def test_all_maps_load(maps_folder: Path) -> None:
    files = sorted(maps_folder.glob("*/*.xodr"))
    assert {file.parent.name for file in files} == {"carla-2019", "carla-2020", "esmini"}
    for file in files:
        road_map = read_map(file)
        xmin, ymin, xmax, ymax = road_map.bounds()
        assert xmin < xmax and ymin < ymax, file
        for point in road_map.spawn_points()[:50]:
            pose = road_map.pose(point)
            assert all(map(math.isfinite, (pose.x, pose.y, pose.z, pose.h))), file
            assert road_map.advance(point, 5.0).travelled > 0.0, file


def test_town06_lane_numbering(load: Load) -> None:
    town = load("carla-2020/Town06")
    lanes = town.lanes("40", 200.0)
    assert lanes == (-7, -6, -5, -4, -3)
    assert (lanes[0], lanes[-1]) == (-7, -3)
    shoulder = town.neighbour(LanePosition("40", -7, 200.0), "right")
    assert shoulder is None
    assert town.neighbour(LanePosition("40", -7, 200.0), "left", 4) == LanePosition("40", -3, 200.0)


def test_town06_road_48_is_found(load: Load) -> None:
    town = load("carla-2020/Town06")
    place = town.locate(478.93, 14.07)  # CARLA (478.93, -14.07)
    assert place is not None
    assert (place.road, place.lane) == ("48", -4)
    assert place.s == pytest.approx(12.9, abs=0.1)
    assert abs(place.offset) < 0.2
    assert math.cos(town.pose(place).h) < -0.99


def test_town06_road_48_is_fed_by(load: Load) -> None:
    """Its way leads back over a bend to the eastbound straight, and there into lane -3."""
    town = load("carla-2020/Town06")
    key = LaneKey("48", 0, -4)
    assert math.cos(town.pose(LanePosition("48", -4, 5.0)).h) < -0.99  # towards -x
    for road in ("1206", "47", "4", "297", "30", "1083", "29", "28", "735", "25", "16"):
        before = [k for k in town.predecessors(key) if k.road == road]
        assert len(before) == 1, (road, key)
        assert key in town.successors(before[0])
        key = before[0]
    assert key == LaneKey("16", 0, -3)
    start, goal = LanePosition("16", -3, 1.0), LanePosition("48", -4, 5.0)
    distance = town.route_distance(start, goal)
    assert distance is not None and town.route_distance(goal, start) == -distance
    # A lane change on road 29 allows a shorter way; staying in the lane, the route still arrives.
    route = town.route_to(goal)
    assert route.distance(start) == distance
    place, roads = start, ["16"]
    while place.road != "48" and len(roads) < 20:
        place = town.advance(place, 5.0, route).position
        roads += [place.road] if place.road != roads[-1] else []
    assert roads[::-1] == [
        *("48", "1206", "47", "4", "297", "30", "1083", "29", "28", "735", "25", "16")
    ]
    assert place.lane == -4


@pytest.mark.slow
def test_town04_ahead_is_lane_arc_length(load: Load) -> None:
    """30 m ahead is 30 m along the lane, on curves too (runtime.md, section 7, point 3)."""
    town = load("carla-2020/Town04")
    compared, ratios = 0, []
    for start in town.spawn_points()[::7]:
        moved = town.advance(start, 30.0)
        if moved.travelled < 30.0 - 1e-9:
            continue
        length, place = 0.0, start
        before = town.pose(start)
        for _ in range(600):
            place = town.advance(place, 0.05).position
            here = town.pose(place)
            length += math.hypot(here.x - before.x, here.y - before.y)
            before = here
        assert place.road == moved.position.road
        assert place.s == pytest.approx(moved.position.s, abs=1e-3)
        assert length == pytest.approx(30.0, abs=0.01)
        assert town.route_distance(start, moved.position) == pytest.approx(30.0, abs=0.01)
        compared += 1
        if moved.position.road == start.road:
            ratios.append(abs(moved.position.s - start.s) / 30.0)
    assert compared > 100
    assert max(ratios) > 1.03 and min(ratios) < 0.97  # so road s would have been wrong


def test_direct_junction(load: Load) -> None:
    split = load("esmini/ut_direct_junction_simple")
    assert split.successors(LaneKey("1", 0, -1)) == (LaneKey("2", 0, -1),)
    assert split.successors(LaneKey("1", 0, -3)) == (LaneKey("3", 0, -1),)
    assert split.predecessors(LaneKey("3", 0, -1)) == (LaneKey("1", 0, -3),)
    merge = load("esmini/soderleden")
    assert LaneKey("2", len(merge.roads["2"].sections) - 1, 1) in {
        key for lane in merge.successors(LaneKey("0", 0, 1)) for key in [lane]
    }


def test_velodrome_is_banked(load: Load) -> None:
    track = load("esmini/velodrome")
    poses = [track.pose(point) for point in track.spawn_points()]
    assert max(abs(pose.roll) for pose in poses) > 0.3
    assert max(pose.z for pose in poses) - min(pose.z for pose in poses) > 1.0


def test_left_hand_map(load: Load) -> None:
    road = load("esmini/e6mini-lht")
    identity = next(iter(road.roads))
    assert not road.roads[identity].right_hand_traffic
    assert all(lane > 0 for lane in road.lanes(identity, 100.0))


def test_signals_of_town06(load: Load, maps_folder: Path) -> None:
    town = load("carla-2020/Town06")
    root = etree.parse(maps_folder / "carla-2020/Town06.xodr").getroot()
    in_file = {node.get("id") for node in root.iter("signal")}
    assert {signal.id for signal in town.signals()} == in_file
    in_file = {node.get("id") for node in root.iterfind("controller")}
    assert {controller.id for controller in town.controllers()} == in_file
    assert all(signal.dynamic and signal.type == "1000001" for signal in town.signals())
    assert any(signal.references for signal in town.signals())
    first = town.controllers()[0]
    assert (first.id, first.signals, first.sequence) == ("1241", ("1221",), 1)


@pytest.mark.parametrize("name", ["carla-2020/Town04", "carla-2019/Town03", "esmini/fabriksgatan"])
def test_centre_lines_are_found_again(load: Load, name: str) -> None:
    """With a hint always; without one wherever only one lane lies there."""
    town = load(name)
    for point in town.spawn_points()[::5]:
        pose = town.pose(point)
        tracked = town.locate(pose.x, pose.y, hint=point)
        assert tracked is not None and (tracked.road, tracked.lane) == (point.road, point.lane)
        assert tracked.s == pytest.approx(point.s, abs=1e-6)
        cold = town.locate(pose.x, pose.y, pose.z, pose.h)
        assert cold is not None
        again = town.pose(cold)
        assert math.hypot(again.x - pose.x, again.y - pose.y) < 1e-6
        assert math.cos(again.h - pose.h) > 0.9


def test_parallel_connecting_roads_keep_the_lane(load: Load) -> None:
    """Two connecting roads lead from one lane to one road; the inner one is shorter."""
    town = load("carla-2020/Town10HD")
    start = LanePosition("22", 2, 18.97)
    moved = town.advance(start, 61.5)
    assert (moved.position.road, moved.position.lane) == ("7", -1)
    assert town.route_distance(start, moved.position) == pytest.approx(61.5, abs=1e-6)


def test_town06_of_2019_has_the_straight_under_another_id(load: Load) -> None:
    town = load("carla-2019/Town06")
    assert len(town.lanes("46", 200.0)) == 5

"""The reader against CARLA's own map (offline), on identical road, lane and s.

Needs the `carla` package, which exists for few platforms; skipped elsewhere.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime.opendrive import LaneKey, LanePosition, RoadMap
from tests.runtime.opendrive.conftest import OWN_MAPS

carla: Any = pytest.importorskip("carla", reason="the carla package is not installed")

TOWNS = (
    "carla-2020/Town01",
    "carla-2019/Town03",
    "carla-2020/Town04",
    "carla-2020/Town06",
    "carla-2019/Town06",
    "carla-2020/Town10HD",
)
PROBE = 0.05  # m before a lane end; CARLA is asked for 2 x PROBE further


@pytest.fixture(params=TOWNS)
def pair(
    request: pytest.FixtureRequest, maps_folder: Path, load: Callable[[str], RoadMap]
) -> tuple[RoadMap, Any]:
    """Our map and CARLA's map of one file."""
    name = f"{request.param}.xodr"
    text = (maps_folder / name).read_text(encoding="utf-8")
    return load(request.param), carla.Map(request.param, text)


def driving_lanes(ours: RoadMap) -> Iterator[tuple[LaneKey, float, float]]:
    """Driving lanes with begin and end of their section."""
    for road in ours.roads.values():
        for section in road.sections:
            for lane in section.lanes.values():
                if lane.type == "driving" and section.end > section.begin:
                    yield lane.key, section.begin, section.end


def test_poses_equal(pair: tuple[RoadMap, Any]) -> None:
    ours, theirs = pair
    worst = {"xy": 0.0, "z": 0.0, "heading": 0.0, "width": 0.0}
    count = 0
    for key, begin, end in driving_lanes(ours):
        for share in (0.02, 0.25, 0.5, 0.98):
            s = begin + share * (end - begin)
            waypoint = theirs.get_waypoint_xodr(int(key.road), key.lane, s)
            if waypoint is None or waypoint.lane_id != key.lane:
                continue
            if waypoint.section_id != key.section:
                continue
            pose = ours.pose(LanePosition(key.road, key.lane, s))
            place, yaw = waypoint.transform.location, waypoint.transform.rotation.yaw
            turn = pose.h + math.radians(yaw)
            found = {
                "xy": math.hypot(pose.x - place.x, pose.y + place.y),
                "z": abs(pose.z - place.z),
                "heading": abs(math.pi - (math.pi - turn) % math.tau),
                "width": abs(ours.lane_width(key.road, key.lane, s) - waypoint.lane_width),
            }
            worst = {name: max(worst[name], value) for name, value in found.items()}
            count += 1
    print(ours.name, count, {name: f"{value:.2e}" for name, value in worst.items()})
    assert count > 200
    assert worst["xy"] <= 1e-3
    assert worst["z"] <= 1e-3
    assert worst["heading"] <= 1e-3
    assert worst["width"] <= 1e-6


@pytest.mark.parametrize(
    "name", ["e6mini", "fabriksgatan", "jolengatan", "soderleden", "curve_r100", "e6mini-lht"]
)
def test_curved_reference_lines_equal(
    name: str, maps_folder: Path, load: Callable[[str], RoadMap]
) -> None:
    """Maps of paramPoly3 and spirals; the superelevation of some is ignored by CARLA."""
    ours = load(f"esmini/{name}")
    text = (maps_folder / f"esmini/{name}.xodr").read_text(encoding="utf-8")
    theirs = carla.Map(name, text)
    worst, count = 0.0, 0
    for key, begin, end in driving_lanes(ours):
        if ours.roads[key.road].superelevation is not None:
            continue
        for i in range(1, 40):
            s = begin + i / 40 * (end - begin)
            waypoint = theirs.get_waypoint_xodr(int(key.road), key.lane, s)
            if waypoint is None or waypoint.section_id != key.section:
                continue
            pose, place = ours.pose(LanePosition(key.road, key.lane, s)), waypoint.transform
            worst = max(worst, math.hypot(pose.x - place.location.x, pose.y + place.location.y))
            count += 1
    print(name, count, f"{worst:.2e}")
    assert count > 50
    assert worst <= 5e-3


@pytest.mark.parametrize("name", ["crossing", "highway", "left_hand", "merge", "urban_crossing"])
def test_own_maps_are_read_alike(name: str, own: Callable[[str], RoadMap]) -> None:
    """Another reader accepts our maps and sees the same roads ("curve" is banked: not in CARLA)."""
    ours = own(name)
    theirs = carla.Map(name, (OWN_MAPS / f"{name}.xodr").read_text(encoding="utf-8"))
    for key, begin, end in driving_lanes(ours):
        forwards = ours.travel_direction(key.road, key.lane) > 0
        s = end - PROBE if forwards else begin + PROBE
        waypoint = theirs.get_waypoint_xodr(int(key.road), key.lane, s)
        pose, place = ours.pose(LanePosition(key.road, key.lane, s)), waypoint.transform
        assert math.hypot(pose.x - place.location.x, pose.y + place.location.y) <= 1e-3
        assert math.cos(pose.h + math.radians(place.rotation.yaw)) > 1.0 - 1e-6
        reached = {
            LaneKey(str(w.road_id), w.section_id, w.lane_id) for w in waypoint.next(2.0 * PROBE)
        }
        assert reached == after(ours, key, PROBE), key


def after(ours: RoadMap, key: LaneKey, left: float) -> set[LaneKey]:
    """Lanes reached by going `left` metres of s past the end of a lane."""
    found: set[LaneKey] = set()
    for following in ours.successors(key):
        section = ours.roads[following.road].sections[following.section]
        length = section.end - section.begin
        if length < left:
            found |= after(ours, following, left - length)
        else:
            found.add(following)
    return found


def test_successors_equal(pair: tuple[RoadMap, Any]) -> None:
    ours, theirs = pair
    compared, differing = 0, []
    for key, begin, end in driving_lanes(ours):
        if end - begin < 2.0 * PROBE:
            continue
        s = end - PROBE if ours.travel_direction(key.road, key.lane) > 0 else begin + PROBE
        waypoint = theirs.get_waypoint_xodr(int(key.road), key.lane, s)
        if waypoint is None or waypoint.section_id != key.section:
            continue
        reached = {
            LaneKey(str(w.road_id), w.section_id, w.lane_id) for w in waypoint.next(2.0 * PROBE)
        }
        compared += 1
        if reached != after(ours, key, PROBE):
            differing.append((key, reached, after(ours, key, PROBE)))
    print(ours.name, compared, "lane ends")
    assert compared > 50
    assert not differing

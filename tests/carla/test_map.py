"""Random places of the towns, compared with `carla.Map`: poses, widths, lanes beside and ahead."""

from __future__ import annotations

import math
import random
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime.opendrive import LaneKey, LanePosition, RoadMap, read_map
from tests.runtime.opendrive.test_carla_parity import TOWNS, after, driving_lanes

carla: Any = pytest.importorskip("carla", reason="the carla package is not installed")

POINTS = 2000
AHEAD = 2.0  # m of s
THIN = 0.05  # m: a lane that begins or ends is not yet, or no longer, beside another
JOINT = 0.01  # m: at the end of a section both may see either one


@pytest.fixture(scope="module", params=TOWNS)
def pair(request: pytest.FixtureRequest, test_data: Path) -> tuple[RoadMap, Any]:
    """Our map and CARLA's map of one file."""
    path = test_data / "maps" / f"{request.param}.xodr"
    if not path.is_file():
        pytest.skip(f"no {path}")
    return read_map(path), carla.Map(path.stem, path.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def places(pair: tuple[RoadMap, Any]) -> list[tuple[LaneKey, float, float, Any]]:
    """Places on driving lanes: lane, s, how far its section goes on, and their waypoint."""
    ours, theirs = pair
    lanes = [lane for lane in driving_lanes(ours) if lane[2] - lane[1] > 2 * JOINT]
    lengths = [end - begin for _, begin, end in lanes]
    chosen = random.Random(ours.name).choices(lanes, lengths, k=POINTS)
    random_ = random.Random(f"{ours.name}/s")
    found = []
    for key, begin, end in chosen:
        s = random_.uniform(begin + JOINT, end - JOINT)
        left = end - s if ours.travel_direction(key.road, key.lane) > 0 else s - begin
        waypoint = theirs.get_waypoint_xodr(int(key.road), key.lane, s)
        assert waypoint is not None, (key, s)
        found.append((key, s, left, waypoint))
    return found


def test_poses_and_widths(pair: tuple[RoadMap, Any], places: list[Any]) -> None:
    ours, _ = pair
    for key, s, _, waypoint in places:
        place, turned = waypoint.transform.location, waypoint.transform.rotation
        pose = ours.pose(LanePosition(key.road, key.lane, s))
        assert waypoint.section_id == key.section
        assert math.dist(pose[:3], (place.x, -place.y, place.z)) <= 2e-3, (key, s)
        assert math.cos(pose.h + math.radians(turned.yaw)) > 1.0 - 1e-6, (key, s)
        width = ours.lane_width(key.road, key.lane, s)
        assert width == pytest.approx(waypoint.lane_width, abs=1e-5), (key, s)


def test_lanes_ahead(pair: tuple[RoadMap, Any], places: list[Any]) -> None:
    ours, _ = pair
    crossed = 0
    for key, s, left, waypoint in places:
        if left <= AHEAD + JOINT:
            reached = {
                LaneKey(str(w.road_id), w.section_id, w.lane_id) for w in waypoint.next(AHEAD)
            }
            if abs(left - AHEAD) > JOINT:
                assert reached == after(ours, key, AHEAD - left), (key, s)
                crossed += 1
    assert crossed > 50


def test_lanes_beside(pair: tuple[RoadMap, Any], places: list[Any]) -> None:
    ours, _ = pair
    for key, s, _, waypoint in places:
        sides = {"left": waypoint.get_left_lane(), "right": waypoint.get_right_lane()}
        for side, beside in sides.items():
            if beside is None or beside.lane_id * key.lane < 0 or beside.lane_width < THIN:
                continue
            if beside.lane_type == carla.LaneType.Driving:
                place = ours.neighbour(LanePosition(key.road, key.lane, s), side)
                assert place is not None and place.lane == beside.lane_id, (key, s, side)

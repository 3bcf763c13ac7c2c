"""Routes that scenarios put together (DSL 8.5.7): points, roads, lanes, crossings and paths."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import pytest

from osc2tx_runtime.domain.map.crossing_lines import laid
from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.paths.path_curves import PathError
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.domain.points_and_poses import Pose
from osc2tx_runtime.domain.routes.composed_routes import poses_of_route
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.opendrive import Pose as MapPose

Load = Callable[[str], RoadMap]
Place = tuple[float, float]
WALK = 4.75  # m: middle of a sidewalk of the street, from its middle


def ends(poses: Sequence[Pose]) -> list[tuple[float, float]]:
    return [(pose.x, pose.y) for pose in (poses[0], poses[-1])]


def length(poses: Sequence[Pose]) -> float:
    return sum(math.dist((a.x, a.y), (b.x, b.y)) for a, b in pairwise(poses))


def sidewalks(road_map: RoadMap) -> tuple[MapSegment, MapSegment]:
    """The right one, whose s runs with x, and the left one, against it."""
    right, left = sorted(graph_of(road_map).other_lanes, key=lambda lane: lane.lane or 0)
    return right, left


@pytest.mark.parametrize(
    ("turn", "begin", "end", "radius"),
    [
        ("4", (170.0, 1.75), (-1.75, -170.0), 21.75),  # to the left, from the inner lane
        ("2", (170.0, 5.25), (5.25, 170.0), 14.75),  # to the right, from the outer one
    ],
)
def test_roads_are_joined_through_a_junction(
    load_map: Load, turn: str, begin: Place, end: Place, radius: float
) -> None:
    """On lanes that lead there, and around the corner on a quarter of a circle."""
    roads = [MapSegment("road", "1"), MapSegment("road", turn)]
    poses = poses_of_route(load_map("urban_crossing"), roads)
    assert ends(poses) == [pytest.approx(begin, abs=1e-4), pytest.approx(end, abs=1e-3)]
    assert length(poses) == pytest.approx(300.0 + 0.5 * math.pi * radius, rel=1e-3)


def test_a_road_runs_the_way_the_next_one_needs(load_map: Load) -> None:
    """Roads of the crossing end in the middle: the second is driven against its s."""
    poses = poses_of_route(
        load_map("urban_crossing"), [MapSegment("road", "3"), MapSegment("road", "1")]
    )
    assert ends(poses)[0][0] == pytest.approx(-170.0, abs=1e-3)
    assert ends(poses)[1][0] == pytest.approx(170.0, abs=1e-3)


def test_roads_that_do_not_lead_to_each_other(load_map: Load) -> None:
    motorway = [MapSegment("road", "2"), MapSegment("road", "1")]
    with pytest.raises(PathError, match="no route along lanes leads from"):
        poses_of_route(load_map("merge"), motorway)
    with pytest.raises(PathError, match="the route has no elements"):
        poses_of_route(load_map("merge"), [])


def test_over_the_street(load_map: Load) -> None:
    """A sidewalk up to the crossing, the crossing, the other sidewalk from there on."""
    road_map = load_map("crossing")
    right, left = sidewalks(road_map)
    crossing = laid(graph_of(road_map), right, left, 40.0, 0.5 * math.pi)
    assert crossing is not None
    poses = poses_of_route(road_map, [right, crossing, left])
    assert ends(poses) == [pytest.approx((0.0, -WALK)), pytest.approx((0.0, WALK), abs=1e-4)]
    assert length(poses) == pytest.approx(40.0 + 2.0 * WALK + 40.0, abs=1e-3)
    assert max(pose.x for pose in poses) == pytest.approx(40.0, abs=1e-6)


def test_against_s_to_the_crossing(load_map: Load) -> None:
    """From a point behind the crossing one walks back to it; from one beside it, across."""
    road_map = load_map("crossing")
    right, left = sidewalks(road_map)
    crossing = laid(graph_of(road_map), right, left, 5.0, 0.5 * math.pi)
    assert crossing is not None
    first, second = LanePosition("1", -2, 10.0), LanePosition("1", -2, 5.0)
    poses = poses_of_route(road_map, [first, second, crossing, left])
    assert length(poses) == pytest.approx(5.0 + 2.0 * WALK + 5.0, abs=1e-3)
    first, second = LanePosition("1", -2, 5.0, -1.0), LanePosition("1", -2, 5.0, 0.5)
    poses = poses_of_route(road_map, [first, second, crossing, left])
    assert [pose.y for pose in poses[:3]] == pytest.approx([-WALK - 1.0, -WALK + 0.5, -WALK])


def test_a_path_in_between(load_map: Load) -> None:
    """From a lane by a path to a point of the world, in straight lines."""
    road_map = load_map("crossing")
    right, _ = sidewalks(road_map)
    path = Path([Pose(500.0, -20.0), Pose(480.0, -20.0)])
    poses = poses_of_route(road_map, [right, path, MapPose(480.0, -30.0, 0.0, 0.0)])
    last = [(pose.x, pose.y) for pose in poses[-3:]]
    assert last == [(500.0, -20.0), (480.0, -20.0), (480.0, -30.0)]
    assert length(poses) == pytest.approx(500.0 + 20.0 - WALK + 20.0 + 10.0, abs=1e-3)


@pytest.mark.parametrize(
    ("connect_by", "begin", "end"),
    [
        ("waypoint", 100.0, 300.0),
        ("lane", 0.0, 2000.0),
        ("lane_section", 0.0, 2000.0),
        ("road", 0.0, 2000.0),
    ],
)
def test_what_points_stand_for(load_map: Load, connect_by: Any, begin: float, end: float) -> None:
    """On the straight part of the motorway x is s; two points of one lane are that lane."""
    points = [LanePosition("1", -2, 100.0), LanePosition("1", -2, 300.0)]
    poses = poses_of_route(load_map("highway"), points, connect_by)
    assert poses[0].x == pytest.approx(begin, abs=1e-3)
    assert length(poses) == pytest.approx(end - begin, abs=10.0)


def test_points_that_stand_for_a_crossing(load_map: Load) -> None:
    road_map = load_map("crossing")
    on_it = MapPose(250.0, 0.0, 0.0, 0.0)
    poses = poses_of_route(road_map, [on_it], "crossing")
    assert length(poses) == pytest.approx(2.0 * WALK)
    with pytest.raises(PathError, match=r"there is no crossing at \(100.0, 0.0\)"):
        poses_of_route(road_map, [MapPose(100.0, 0.0, 0.0, 0.0)], "crossing")
    with pytest.raises(PathError, match=r"there is no lane at \(100.0, 50.0\)"):
        poses_of_route(road_map, [MapPose(100.0, 50.0, 0.0, 0.0)], "lane")

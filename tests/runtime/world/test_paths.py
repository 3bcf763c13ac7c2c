"""Paths in whole scenarios, measured against their geometry."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Parallel,
    Person,
    Serial,
    Wait,
    elapsed,
)
from osc2tx_runtime.domain.actors import Point, Pose
from osc2tx_runtime.domain.paths.path_values import Path, RelativePath
from osc2tx_runtime.domain.points_and_poses import RoutePoint
from osc2tx_runtime.modifiers import along, physical_movement, position, yaw
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]

# The highway is straight along x; lane -3 (the second from the right) is at y = -8.75.
ASIDE = Path((Pose(50.0, -8.75), Pose(80.0, -8.75), Pose(110.0, 10.0), Pose(160.0, 10.0)))


def distance_to(points: list[tuple[float, float]], x: float, y: float) -> float:
    """Distance of a point from a polyline."""
    best = math.inf
    for (ax, ay), (bx, by) in pairwise(points):
        dx, dy = bx - ax, by - ay
        w = min(max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
        best = min(best, math.hypot(ax + w * dx - x, ay + w * dy - y))
    return best


def test_replay_is_on_the_path_exactly(run: Run) -> None:
    done = run(scenario(lambda s: s.a.replay_path(absolute=ASIDE)))
    states = done.states("a")
    assert done.result.status == "success"
    corners = [(p.x, p.y) for p in ASIDE.points]
    assert max(distance_to(corners, e["x"], e["y"]) for e in states[:-1]) < 1e-5
    length = 30.0 + math.hypot(30.0, 18.75) + 50.0
    assert done.result.steps == math.ceil(length / 0.5)
    assert all(e["v"] == 10.0 for e in states)
    assert states[80]["h"] == pytest.approx(math.atan2(18.75, 30.0), abs=1e-6)


def test_replay_jumps_to_the_start_of_what_is_used(run: Run) -> None:
    path = Path((Pose(300.0, 20.0), Pose(300.0, 60.0)))
    done = run(scenario(lambda s: s.a.replay_path(absolute=path, start_offset=4.0, end_offset=6.0)))
    states = done.states("a")
    assert (states[1]["x"], states[1]["y"]) == (300.0, pytest.approx(24.5))
    assert states[-1]["y"] == pytest.approx(54.0)
    assert done.result.steps == 60
    assert not done.result.collisions


@pytest.mark.parametrize("interpolation", ["straight_line", "smooth"])
def test_follow_stays_near_the_path_within_the_limits(run: Run, interpolation: Any) -> None:
    path = Path(ASIDE.points, interpolation)
    done = run(scenario(lambda s: s.a.follow_path(absolute=path)))
    assert done.result.status == "success"
    states = done.states("a")
    curve = path.curve
    line = [curve.point(curve.at_length(0.2 * i))[:2] for i in range(int(curve.length / 0.2))]
    assert max(distance_to(line, e["x"], e["y"]) for e in states) < 1.6
    assert states[-1]["x"] == pytest.approx(160.0, abs=0.6)
    assert states[-1]["y"] == pytest.approx(10.0, abs=0.1)
    for one, two in pairwise(states):
        turn = abs(math.remainder(two["h"] - one["h"], math.tau)) / 0.05
        assert turn * 10.0 <= 8.0 + 1e-3  # lateral acceleration v * yaw rate
        way = math.hypot(two["x"] - one["x"], two["y"] - one["y"])
        assert way == pytest.approx(0.5, abs=1e-3)
        course = math.atan2(two["y"] - one["y"], two["x"] - one["x"])
        mean = one["h"] + 0.5 * math.remainder(two["h"] - one["h"], math.tau)
        assert abs(math.remainder(course - mean, math.tau)) < 1e-3  # it does not slip


def test_follow_a_circle(run: Run) -> None:
    angles = [-0.5 * math.pi + 0.1 * i for i in range(32)]
    circle = Path(
        tuple(Pose(50.0 + 15.0 * math.cos(a), 6.25 + 15.0 * math.sin(a)) for a in angles), "smooth"
    )
    done = run(scenario(lambda s: s.a.follow_path(absolute=circle)))
    assert done.result.status == "success"
    radii = [math.hypot(e["x"] - 50.0, e["y"] - 6.25) for e in done.states("a")]
    assert max(abs(r - 15.0) for r in radii) < 0.15


def test_speed_is_free_on_a_path(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both", s.a.replay_path(absolute=ASIDE), s.a.change_speed(target=16.0, duration=3.0)
        )

    done = run(scenario(body))
    states = done.states("a")
    assert states[60]["v"] == states[-1]["v"] == 16.0
    length = 30.0 + math.hypot(30.0, 18.75) + 50.0
    assert done.result.time == pytest.approx(3.0 + (length - 39.0) / 16.0, abs=0.051)


def test_the_vehicle_returns_to_the_nearest_lane(run: Run) -> None:
    path = Path((Pose(50.0, -8.75), Pose(70.0, -8.0), Pose(110.0, -6.4)), "smooth")

    def body(s: TwoCars) -> Behaviour:
        return Serial("all", s.a.follow_path(absolute=path), Wait(elapsed(5.0)))

    states = run(scenario(body)).states("a")
    last = states[-1]
    assert (last["lane"], last["offset"], last["h"]) == (-2, 0.0, 0.0)
    for one, two in pairwise(states):
        assert abs(two["h"] - one["h"]) < 0.02  # no jump of the heading


def test_the_vehicle_steers_back_to_the_lane(run: Run) -> None:
    path = Path((Pose(50.0, -8.75), Pose(65.0, -8.75), Pose(75.0, -1.75)))

    def body(s: TwoCars) -> Behaviour:
        return Serial("all", s.a.follow_path(absolute=path), Wait(elapsed(8.0)))

    states = run(scenario(body)).states("a")
    assert (states[-1]["offset"], states[-1]["h"], states[-1]["v"]) == (0.0, 0.0, 10.0)
    assert max(abs(b["h"] - a["h"]) for a, b in pairwise(states)) < 0.05


def test_a_lane_change_after_a_path(run: Run) -> None:
    path = Path((Pose(50.0, -8.75), Pose(70.0, -8.0), Pose(110.0, -6.4)), "smooth")

    def body(s: TwoCars) -> Behaviour:
        return Serial("all", s.a.follow_path(absolute=path), s.a.change_lane(side="right"))

    last = run(scenario(body)).states("a")[-1]
    assert (last["lane"], last["offset"]) == (-3, 0.0)


@pytest.mark.parametrize(
    ("path", "reason"),
    [
        (Path(()), "the path has no points"),
        (Path((Pose(900.0, 0.0), Pose(950.0, 0.0))), "the path is 850 m away"),
        (
            Path((Pose(50.0, -8.75), Pose(70.0, -8.75), Pose(70.0, 40.0))),
            "because at 10.0 m/s its turning radius is at least 12.5 m",
        ),
        (
            Path((Pose(50.0, -8.75, yaw=0.0), Pose(70.0, -8.75, yaw=1.57))),
            "requires a heading 90 degrees off the path",
        ),
    ],
)
def test_paths_that_cannot_be_followed(run: Run, path: Path, reason: str) -> None:
    done = run(scenario(lambda s: s.a.follow_path(absolute=path)))
    assert done.result.status == "failure"
    assert reason in done.result.reason


def test_replay_with_headings_of_its_own(run: Run) -> None:
    path = Path((Pose(50.0, 0.0, yaw=0.0), Pose(70.0, 0.0, yaw=math.pi / 2)))
    states = run(scenario(lambda s: s.a.replay_path(absolute=path))).states("a")
    assert states[20]["x"] == pytest.approx(60.0)
    assert states[20]["h"] == pytest.approx(math.pi / 4, abs=1e-6)


@pytest.mark.parametrize(
    ("transform", "end"),
    [
        ("object_relative", (90.0 + 30.0, -8.75 + 5.0)),
        ("world_relative", (90.0 + 30.0, -8.75 + 5.0)),
        ("lane_relative", (90.0 + 30.0, -8.75 + 5.0)),
        ("road_relative", (90.0 + 30.0, 5.0)),
    ],
)
def test_relative_paths(run: Run, transform: Any, end: tuple[float, float]) -> None:
    path = RelativePath((Pose(0.0, 0.0), Pose(30.0, 5.0)))

    def body(s: TwoCars) -> Behaviour:
        return s.a.replay_path(relative=path, reference=s.b, transform=transform)

    last = run(scenario(body)).states("a")[-1]
    assert (last["x"], last["y"]) == pytest.approx(end, abs=0.6)


def test_object_relative_turns_with_the_object(run: Run) -> None:
    class Turned(TwoCars):
        def declare(self) -> None:
            super().declare()
            self.walker = Person()

        def placement(self) -> None:
            super().placement()
            point = Point(200.0, 30.0)
            self.place(
                self.walker,
                position(at_point=point, project_on_route=False),
                yaw(math.pi / 2, measure_by="relative_to_north"),  # that is along -x
            )

        def behavior(self) -> Behaviour:
            path = RelativePath((Pose(0.0, 0.0), Pose(10.0, 4.0)))
            return self.walker.follow_path(relative=path)

    states = run(Turned).states("walker")
    assert (states[-1]["x"], states[-1]["y"]) == pytest.approx((190.0, 26.0), abs=0.1)
    assert states[-1]["v"] == 1.4  # who stands sets out


def test_points_in_s_and_t(run: Run) -> None:
    path = RelativePath((RoutePoint(s=0.0, t=0.0), RoutePoint(s=40.0, t=1.5)))
    states = run(scenario(lambda s: s.a.replay_path(relative=path))).states("a")
    assert (states[-1]["x"], states[-1]["y"]) == pytest.approx((90.0, -7.25), abs=0.5)


def test_along_is_a_path_in_a_drive(run: Run) -> None:
    exact = physical_movement("prefer_non_physical")
    replayed = run(scenario(lambda s: s.a.drive(along(lambda: ASIDE), exact)))
    assert replayed.states("a")[-1]["y"] == pytest.approx(10.0)
    followed = run(scenario(lambda s: s.a.drive(along(ASIDE, end_offset=40.0))))
    assert followed.states("a")[-1]["x"] == pytest.approx(120.0, abs=0.6)

"""Trajectories in whole scenarios, measured against their geometry and their times."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
)
from osc2tx_runtime.domain.actors import Pose
from osc2tx_runtime.domain.paths.path_values import RelativeTrajectory, Trajectory
from osc2tx_runtime.modifiers import along_trajectory, physical_movement
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]

TIMED = Trajectory((Pose(50.0, -8.75), Pose(70.0, -8.75), Pose(90.0, -2.0)), (0.0, 2.0, 5.0))


def test_replay_of_a_trajectory_is_exact_in_time(run: Run) -> None:
    done = run(scenario(lambda s: s.a.replay_trajectory(absolute=TIMED)))
    assert done.result.time == pytest.approx(5.0)
    assert done.states("a")[20]["x"] == pytest.approx(60.0)
    assert done.states("a")[20]["v"] == pytest.approx(10.0)
    at = done.at("a", 3.5)
    assert (at["x"], at["y"]) == pytest.approx((80.0, -5.375))
    assert at["v"] == pytest.approx(math.hypot(20.0, 6.75) / 3.0, abs=1e-6)
    assert at["h"] == pytest.approx(math.atan2(6.75, 20.0), abs=1e-6)


def test_a_trajectory_with_time_to_get_there(run: Run) -> None:
    late = Trajectory((Pose(70.0, -8.75), Pose(90.0, -8.75)), (4.0, 6.0))
    done = run(scenario(lambda s: s.a.replay_trajectory(absolute=late)))
    assert done.at("a", 2.0)["x"] == pytest.approx(60.0)
    assert done.at("a", 5.0)["x"] == pytest.approx(80.0)
    assert done.result.time == pytest.approx(6.0)


def test_offsets_of_a_trajectory(run: Run) -> None:
    straight = Trajectory((Pose(50.0, -8.75), Pose(90.0, -8.75)), (0.0, 4.0))

    def body(s: TwoCars) -> Behaviour:
        return s.a.replay_trajectory(absolute=straight, start_offset=10.0, end_offset=5.0)

    done = run(scenario(body))
    assert done.at("a", 1.0)["x"] == pytest.approx(70.0)
    assert done.result.time == pytest.approx(2.5)


def test_follow_a_trajectory_in_time(run: Run) -> None:
    times = tuple(0.5 * i for i in range(17))
    points = tuple(Pose(50.0 + 10.0 * t + 0.25 * t * t, -8.75 + 0.2 * t * t) for t in times)
    trajectory = Trajectory(points, times, "smooth")
    done = run(scenario(lambda s: s.a.follow_trajectory(absolute=trajectory)))
    assert done.result.status == "success"
    assert done.result.time == pytest.approx(8.0, abs=0.15)
    for t in (2.0, 4.0, 6.0, 7.5):
        at = done.at("a", t)
        x, y = 50.0 + 10.0 * t + 0.25 * t * t, -8.75 + 0.2 * t * t
        assert math.hypot(at["x"] - x, at["y"] - y) < 0.35
        assert at["v"] == pytest.approx(math.hypot(10.0 + 0.5 * t, 0.4 * t), abs=0.3)


def test_a_trajectory_that_is_too_fast(run: Run) -> None:
    fast = Trajectory((Pose(50.0, -8.75), Pose(2050.0, -8.75)), (0.0, 4.0))
    done = run(scenario(lambda s: s.a.follow_trajectory(absolute=fast)))
    assert done.result.status == "failure"
    assert "m from the end, 10 s after its time" in done.result.reason


def test_relative_trajectory(run: Run) -> None:
    relative = RelativeTrajectory((Pose(0.0, 0.0), Pose(20.0, 2.0)), (0.0, 2.0))
    done = run(scenario(lambda s: s.a.replay_trajectory(relative=relative)))
    last = done.states("a")[-1]
    assert (last["x"], last["y"]) == pytest.approx((70.0, -6.75))


def test_along_a_trajectory_is_one_in_a_drive(run: Run) -> None:
    exact = physical_movement("prefer_non_physical")
    timed = run(scenario(lambda s: s.a.drive(along_trajectory(TIMED), exact)))
    assert timed.result.time == pytest.approx(5.0)

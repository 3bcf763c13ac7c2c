"""Curves through points against circles, lines and parabolas."""

from __future__ import annotations

import math

import pytest

from osc2tx_runtime.domain.paths.path_curves import PathError, interval_between_offsets
from osc2tx_runtime.domain.paths.path_values import Path, Trajectory
from osc2tx_runtime.domain.points_and_poses import Pose


def test_a_polyline_is_as_long_as_its_pieces() -> None:
    curve = Path((Pose(0, 0), Pose(3, 4), Pose(3, 4), Pose(3, 14))).curve
    assert curve.length == pytest.approx(15.0)
    assert curve.point(curve.at_length(5.0)) == pytest.approx((3.0, 4.0, 0.0))
    assert curve.point(curve.at_length(11.0)) == pytest.approx((3.0, 10.0, 0.0))
    assert curve.heading(curve.at_length(7.0)) == pytest.approx(0.5 * math.pi)
    assert curve.point(curve.at_length(17.0)) == pytest.approx((3.0, 16.0, 0.0))  # straight on


def test_a_smooth_path_through_a_circle_is_nearly_the_circle() -> None:
    radius, steps = 20.0, 24
    angles = [math.pi * i / steps for i in range(steps + 1)]
    points = tuple(Pose(radius * math.cos(a), radius * math.sin(a)) for a in angles)
    curve = Path(points, "smooth").curve
    assert curve.length == pytest.approx(math.pi * radius, rel=2e-3)
    for i in range(100):
        x, y, _ = curve.point(curve.at_length(curve.length * i / 99))
        assert math.hypot(x, y) == pytest.approx(radius, abs=0.02)
    for point, angle in zip(points, angles, strict=True):
        along = curve.nearest(point.x, point.y, max(radius * angle - 3.0, 0.0), 5.0)
        assert along == pytest.approx(radius * angle, abs=0.05)


def test_arc_length_and_its_inverse() -> None:
    curve = Path((Pose(0, 0), Pose(10, 3), Pose(14, 12), Pose(30, 10)), "smooth").curve
    for i in range(50):
        along = curve.length * i / 49
        assert curve.length_at(curve.at_length(along)) == pytest.approx(along, abs=1e-5)


def test_a_smooth_trajectory_is_exact_for_constant_acceleration() -> None:
    times = (0.0, 1.0, 2.5, 4.0)
    points = tuple(Pose(3.0 * t + t * t, 1.0) for t in times)
    curve = Trajectory(points, times, "smooth").curve
    for i in range(41):
        t = 0.1 * i
        assert curve.point(t)[0] == pytest.approx(3.0 * t + t * t)
        assert curve.rate(t)[0] == pytest.approx(3.0 + 2.0 * t)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ((), "the path has no points"),
        ((Pose(1, 1),), "the path has no length"),
        ((Pose(1, 1), Pose(1, 1)), "the path has no length"),
    ],
)
def test_paths_that_are_none(points: tuple[Pose, ...], message: str) -> None:
    with pytest.raises(PathError, match=message):
        _ = Path(points).curve


@pytest.mark.parametrize(
    ("count", "times", "message"),
    [
        (2, (0.0,), "has 2 points, but 1 time stamps"),
        (1, (0.0,), "at least two points"),
        (2, (1.0, 1.0), "ascend"),
        (2, (-1.0, 1.0), "at 0 s or later"),
    ],
)
def test_trajectories_that_are_none(count: int, times: tuple[float, ...], message: str) -> None:
    points = tuple(Pose(i, 0) for i in range(count))
    with pytest.raises(PathError, match=message):
        _ = Trajectory(points, times).curve


def test_offsets_leave_something() -> None:
    curve = Path((Pose(0, 0), Pose(10, 0))).curve
    assert interval_between_offsets(curve, 2.0, 3.0) == (2.0, 7.0)
    with pytest.raises(PathError, match=r"leave nothing of a path of 10\.00 m"):
        interval_between_offsets(curve, 6.0, 4.0)
    with pytest.raises(PathError, match="not negative"):
        interval_between_offsets(curve, -1.0, 0.0)

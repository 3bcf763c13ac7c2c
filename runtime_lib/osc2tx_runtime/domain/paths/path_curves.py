"""Curves through the poses of paths and trajectories, and their part between two offsets."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from osc2tx_runtime.domain.points_and_poses import Pose
from osc2tx_runtime.enums import PathInterpolation
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.geometry.curve import Curve, Knot

_SAME = 1e-6  # m: closer points are equal


class PathError(ScenarioError):
    """A path cannot be followed: actions on it fail with this reason."""


def path_curve(points: Sequence[Pose], interpolation: PathInterpolation) -> Curve:
    """The curve of a path; its parameter is the sum of the distances from point to point (m).

    Raises:
        PathError: It has no two different points.
    """
    knots: list[Knot] = []
    for pose in points:
        if not knots:
            knots.append(Knot(0.0, pose.x, pose.y, pose.z, pose.yaw))
            continue
        last = knots[-1]
        way = math.hypot(pose.x - last.x, pose.y - last.y)
        if way > _SAME:
            knots.append(Knot(last.at + way, pose.x, pose.y, pose.z, pose.yaw))
    if not points:
        raise PathError("the path has no points")
    if len(knots) < 2:
        raise PathError("the path has no length: it needs two different points")
    return Curve(knots, interpolation == "smooth")


def trajectory_curve(
    points: Sequence[Pose], times: Sequence[float], interpolation: PathInterpolation
) -> Curve:
    """The curve of a trajectory; its parameter is the time (s).

    Raises:
        PathError: Numbers of points and times differ, or times do not increase.
    """
    if len(points) != len(times):
        raise PathError(f"the trajectory has {len(points)} points, but {len(times)} time stamps")
    if len(points) < 2:
        raise PathError("the trajectory needs at least two points")
    if times[0] < 0.0 or any(b <= a for a, b in pairwise(times)):
        raise PathError("the time stamps of a trajectory start at 0 s or later, and ascend")
    knots = [Knot(t, p.x, p.y, p.z, p.yaw) for t, p in zip(times, points, strict=True)]
    return Curve(knots, interpolation == "smooth")


def interval_between_offsets(
    curve: Curve, start_offset: float, end_offset: float
) -> tuple[float, float]:
    """Arc lengths (m) between which a curve is used.

    Raises:
        PathError: The offsets exceed the path.
    """
    if start_offset < 0.0 or end_offset < 0.0:
        raise PathError("start_offset and end_offset are not negative")
    begin, end = start_offset, curve.length - end_offset
    if end - begin <= _SAME:
        raise PathError(
            f"start_offset {start_offset:g} m and end_offset {end_offset:g} m leave nothing of a"
            f" path of {curve.length:.2f} m"
        )
    return begin, end

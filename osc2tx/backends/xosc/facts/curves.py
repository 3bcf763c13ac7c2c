"""Curves through points, as the runtime draws them, and actors that steer along them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Literal, NamedTuple

from osc2tx.backends.xosc.facts import refusing
from osc2tx_runtime.domain.paths.path_curves import interval_between_offsets
from osc2tx_runtime.domain.paths.path_values import Path as Way
from osc2tx_runtime.domain.paths.path_values import Trajectory
from osc2tx_runtime.domain.points_and_poses import Pose as WayPose
from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world.actor_dimensions import Limits, Shape
from osc2tx_runtime.world.commands import FollowCourse
from osc2tx_runtime.world.geometry.curve import Curve
from osc2tx_runtime.world.lateral.curve_following import Course, course_of
from osc2tx_runtime.world.state import ActorState
from osc2tx_shared.classes import dataclass


class Waypoint(NamedTuple):
    """A point of a way.

    Attributes:
        time: Seconds since its start, if it has times.
        x: Metres.
        y: Metres.
        z: Metres.
        h: Heading (rad); `None`: that of the way.
    """

    time: float
    x: float
    y: float
    z: float
    h: float | None = None


@dataclass(frozen=True, slots=True)
class Line:
    """A path or a trajectory.

    Attributes:
        points: Its points, in the world or relative to a reference.
        is_smooth: It has no corners.
        is_timed: It is a trajectory.
        frame: `None`: the world; else how its points are relative.
        reference: Relative to whom.
        offsets: Metres that are left out at its start and its end.
    """

    points: tuple[Waypoint, ...]
    is_smooth: bool = False
    is_timed: bool = False
    frame: str | None = None
    reference: str | None = None
    offsets: tuple[float, float] = (0.0, 0.0)


SAMPLES = 12
"""Pieces into which a stretch of a smooth way is cut."""

TOLERANCE = 0.02
"""Metres by which the straight lines of a polyline may leave a curve."""


@refusing()
def sample_curve(line: Line) -> tuple[Waypoint, ...]:
    """Return the corners of straight stretches that are as good as a way through points."""
    curve = curve_through(line.points, is_timed=line.is_timed, is_smooth=line.is_smooth)
    low, high = interval_between_offsets(curve, *line.offsets)
    begin, end = curve.begin, curve.end
    if any(line.offsets):
        begin, end = curve.at_length(low), curve.at_length(high)
    places = [begin, *(knot for knot in curve.knots if begin < knot < end), end]
    if line.is_smooth and len(line.points) > 2:
        places = [
            left + (right - left) * part / SAMPLES
            for left, right in pairwise(places)
            for part in range(SAMPLES)
        ] + [end]
    turns = {round(curve.heading(place) or 0.0, 6) for place in places}
    is_even = line.is_smooth or len(turns) == 1
    found = []
    for place in places:
        x, y, z = curve.point(place)
        h = curve.yaw(place)
        h = curve.heading(place) if h is None and is_even else h
        found.append(Waypoint(place - begin, x, y, z, h))
    return thinned(found, is_timed=line.is_timed) if line.is_smooth else tuple(found)


def curve_through(points: Sequence[Waypoint], *, is_timed: bool, is_smooth: bool) -> Curve:
    """Return the curve of the runtime through points.

    Raises:
        PathError: There is none.
    """
    poses = tuple(WayPose(p.x, p.y, p.z, yaw=p.h) for p in points)
    joined: Literal["smooth", "straight_line"] = "smooth" if is_smooth else "straight_line"
    if is_timed:
        return Trajectory(poses, [p.time for p in points], joined).curve
    return Way(poses, joined).curve


def thinned(
    points: Sequence[Waypoint], *, is_timed: bool, tolerance: float = TOLERANCE
) -> tuple[Waypoint, ...]:
    """Return points of a curve whose straight lines stay so near (m) to all of them.

    If it is timed, a place counts at its time, and not wherever it is on the curve.
    """
    kept = [points[0]]
    first = 0
    while first < len(points) - 1:
        last = first + 1
        while last + 1 < len(points) and _is_straight(
            points[first : last + 2], is_timed, tolerance
        ):
            last += 1
        kept.append(points[last])
        first = last
    return tuple(kept)


def _is_straight(points: Sequence[Waypoint], is_timed: bool, tolerance: float) -> bool:
    """Whether the points between the first and the last lie on the line between these."""
    begin, end = points[0], points[-1]
    way = (end.x - begin.x, end.y - begin.y, end.z - begin.z)
    square = sum(step * step for step in way)
    for point in points[1:-1]:
        off = (point.x - begin.x, point.y - begin.y, point.z - begin.z)
        if is_timed:
            part = (point.time - begin.time) / (end.time - begin.time)
        else:
            part = sum(a * b for a, b in zip(off, way, strict=True)) / square if square else 0.0
        if math.dist(off, tuple(part * step for step in way)) > tolerance:
            return False
    return True

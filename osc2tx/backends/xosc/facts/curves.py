"""Curves through points, sampled as the runtime draws them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Literal, NamedTuple

from osc2tx.backends.xosc.report import Inexpressible
from osc2tx_runtime.domain.paths.path_curves import PathError, interval_between_offsets
from osc2tx_runtime.domain.paths.path_values import Path as Way
from osc2tx_runtime.domain.paths.path_values import Trajectory
from osc2tx_runtime.domain.points_and_poses import Pose as WayPose
from osc2tx_runtime.world.geometry.curve import Curve


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


SAMPLES = 12
"""Pieces into which a stretch of a smooth way is cut."""

TOLERANCE = 0.02
"""Metres by which the straight lines of a polyline may leave a curve."""


def sample_curve(
    points: Sequence[Waypoint],
    *,
    is_timed: bool,
    is_smooth: bool,
    offsets: tuple[float, float],
) -> tuple[Waypoint, ...]:
    """Return the corners of a line that is as good as a way through points.

    Args:
        points: The points.
        is_timed: They have times.
        is_smooth: The way has no corners.
        offsets: Metres that are left out at its start and its end.

    Raises:
        Inexpressible: There is no such way.
    """
    try:
        curve = curve_through(points, is_timed=is_timed, is_smooth=is_smooth)
        low, high = interval_between_offsets(curve, *offsets)
    except PathError as error:
        raise Inexpressible(error.message) from None
    begin, end = curve.begin, curve.end
    if any(offsets):
        begin, end = curve.at_length(low), curve.at_length(high)
    places = [begin, *(knot for knot in curve.knots if begin < knot < end), end]
    if is_smooth and len(points) > 2:
        places = [
            left + (right - left) * part / SAMPLES
            for left, right in pairwise(places)
            for part in range(SAMPLES)
        ] + [end]
    turns = {round(curve.heading(place) or 0.0, 6) for place in places}
    is_even = is_smooth or len(turns) == 1
    found = []
    for place in places:
        x, y, z = curve.point(place)
        h = curve.yaw(place)
        h = curve.heading(place) if h is None and is_even else h
        found.append(Waypoint(place - begin, x, y, z, h))
    return thinned(found, is_timed=is_timed) if is_smooth else tuple(found)


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


def thinned(points: Sequence[Waypoint], *, is_timed: bool) -> tuple[Waypoint, ...]:
    """Return points of a curve whose straight lines stay within `TOLERANCE` of all of them.

    Args:
        points: Points of the curve, close together.
        is_timed: Whether a place counts at its time, and not wherever it is on the curve.
    """
    kept = [points[0]]
    first = 0
    while first < len(points) - 1:
        last = first + 1
        while last + 1 < len(points) and _is_straight(points[first : last + 2], is_timed):
            last += 1
        kept.append(points[last])
        first = last
    return tuple(kept)


def _is_straight(points: Sequence[Waypoint], is_timed: bool) -> bool:
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
        if math.dist(off, tuple(part * step for step in way)) > TOLERANCE:
            return False
    return True

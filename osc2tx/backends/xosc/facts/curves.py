"""Curves through points, sampled as the runtime draws them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Literal, NamedTuple

from osc2tx.backends.xosc.report import Inexpressible
from osc2tx_runtime.domain.paths.path_curves import PathError, stretch
from osc2tx_runtime.domain.paths.path_values import Path as Way
from osc2tx_runtime.domain.paths.path_values import Trajectory
from osc2tx_runtime.domain.points_and_poses import Pose as WayPose

__all__ = ["Waypoint", "sample_curve"]


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
    poses = tuple(WayPose(p.x, p.y, p.z, yaw=p.h) for p in points)
    joined: Literal["smooth", "straight_line"] = "smooth" if is_smooth else "straight_line"
    try:
        if is_timed:
            curve = Trajectory(poses, [p.time for p in points], joined).curve
        else:
            curve = Way(poses, joined).curve
        low, high = stretch(curve, *offsets)
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
    return tuple(found)

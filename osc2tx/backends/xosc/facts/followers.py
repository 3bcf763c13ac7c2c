"""Actors that steer along a line as the runtime lets them, against the line itself."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from osc2tx.backends.xosc.facts.curves import Waypoint, curve_through
from osc2tx_runtime.domain.paths.path_curves import interval_between_offsets
from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world.actor_dimensions import Limits, Shape
from osc2tx_runtime.world.commands import FollowCourse
from osc2tx_runtime.world.curve_following import Course, course_of
from osc2tx_runtime.world.state import ActorState

__all__ = ["off_the_line"]

STEP = 0.02  # s
MOST_STEPS = 20000


def off_the_line(
    points: Sequence[Waypoint],
    line: Sequence[Waypoint],
    start: Pose,
    speed: float,
    actor: tuple[Shape, Limits],
    *,
    is_smooth: bool,
    offsets: tuple[float, float],
) -> float:
    """Return how far (m) an actor is at most from where the corners of a line would have it.

    Args:
        points: Points of its way.
        line: Corners of the line, from where it is on.
        start: Where it is, and how it looks.
        speed: m/s, which it keeps.
        actor: What it is.
        is_smooth: Its way has no corners.
        offsets: Metres that are left out at the start and the end of its way.
    """
    shape, limits = actor
    curve = curve_through(points, is_timed=False, is_smooth=is_smooth)
    command = FollowCourse(curve, *interval_between_offsets(curve, *offsets))
    me = ActorState(start.x, start.y, start.z, start.h, speed, 0.0, None, 0.0, shape)
    course: Course | None = course_of(command, me, limits)
    assert course is not None
    worst, way = 0.0, 0.0
    for _ in range(MOST_STEPS):
        if course.progress().done or course.progress().failed is not None:
            break
        pose, _ = course.after(me, speed, speed * STEP, STEP)
        me = me._replace(x=pose.x, y=pose.y, h=pose.h)
        way += speed * STEP
        x, y = _along(line, way)
        worst = max(worst, math.hypot(me.x - x, me.y - y))
    return worst


def _along(line: Sequence[Waypoint], way: float) -> tuple[float, float]:
    """Return the place so far (m) along a line; beyond its end straight on."""
    for a, b in pairwise(line):
        length = math.hypot(b.x - a.x, b.y - a.y)
        if way <= length or b is line[-1]:
            part = way / length if length else 0.0
            return a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)
        way -= length
    return line[-1].x, line[-1].y

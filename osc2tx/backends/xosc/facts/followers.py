"""Actors that steer along a line as the runtime lets them, against the line itself."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise

from osc2tx.backends.xosc.facts.curves import Waypoint, curve_through
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx_runtime.domain.paths.path_curves import PathError, interval_between_offsets
from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world.actor_dimensions import Limits, Shape
from osc2tx_runtime.world.commands import FollowCourse
from osc2tx_runtime.world.lateral.curve_following import Course, course_of
from osc2tx_runtime.world.state import ActorState

STEP = 0.02  # s
MOST_STEPS = 4000
"""Of a smooth line; they are longer along a longer one."""

SETTLED, LEAST_SETTLED = 10.0, 100.0
"""Seconds, and metres besides, after which a corner is behind, or before which it is far off."""


@lru_cache(64)  # documents for other values of parameters have the same lines
def off_the_line(
    points: tuple[Waypoint, ...],
    line: tuple[Waypoint, ...],
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

    Raises:
        Inexpressible: The way has no length, as that to where the actor is already.
    """
    is_straight = (not is_smooth or len(points) == 2) and max(offsets) < LEAST_SETTLED
    pieces = _near_corners(points, speed) if is_straight else [points]
    worst = 0.0
    for i, piece in enumerate(pieces):
        ends = offsets[0] if i == 0 else 0.0, offsets[1] if i == len(pieces) - 1 else 0.0
        if i > 0:
            line, start = piece, _along_first(piece)
        try:
            curve = curve_through(piece, is_timed=False, is_smooth=is_smooth)
            command = FollowCourse(curve, *interval_between_offsets(curve, *ends))
        except PathError as error:
            raise Inexpressible(error.message) from None
        worst = max(worst, _worst(command, line, start, speed, actor))
    return worst


def _worst(
    command: FollowCourse,
    line: Sequence[Waypoint],
    start: Pose,
    speed: float,
    actor: tuple[Shape, Limits],
) -> float:
    """Return how far (m) an actor gets from the corners of a line along a course."""
    shape, limits = actor
    me = ActorState(start.x, start.y, start.z, start.h, speed, 0.0, None, 0.0, shape)
    course: Course | None = course_of(command, me, limits)
    assert course is not None
    step = max(STEP, command.curve.length / (speed * MOST_STEPS))
    worst, way = 0.0, 0.0
    for _ in range(2 * MOST_STEPS):
        if course.progress().done or course.progress().failed is not None:
            break
        pose, _ = course.after(me, speed, speed * step, step)
        me = me._replace(x=pose.x, y=pose.y, h=pose.h)
        way += speed * step
        x, y = _along(line, way)
        worst = max(worst, math.hypot(me.x - x, me.y - y))
    return worst


def _near_corners(points: Sequence[Waypoint], speed: float) -> list[tuple[Waypoint, ...]]:
    """Return the parts of a line of straight stretches in which there is something to steer.

    In the middle of a long stretch an actor goes straight on: it is left out.
    """
    settled = SETTLED * speed + LEAST_SETTLED
    pieces, piece = [], [points[0]]
    for a, b in pairwise(points):
        length = math.dist((a.x, a.y), (b.x, b.y))
        if length > 2.0 * settled:
            pieces.append((*piece, _between(a, b, settled / length)))
            piece = [_between(a, b, 1.0 - settled / length)]
        piece.append(b)
    return [*pieces, tuple(piece)]


def _between(a: Waypoint, b: Waypoint, part: float) -> Waypoint:
    x, y, z = (p + part * (q - p) for p, q in zip(a[1:4], b[1:4], strict=True))
    return Waypoint(a.time + part * (b.time - a.time), x, y, z, a.h)


def _along_first(line: Sequence[Waypoint]) -> Pose:
    """Return the begin of a line, in its direction."""
    a, b = line[0], line[1]
    return Pose(a.x, a.y, a.z, math.atan2(b.y - a.y, b.x - a.x))


def _along(line: Sequence[Waypoint], way: float) -> tuple[float, float]:
    """Return the place so far (m) along a line; beyond its end straight on."""
    for a, b in pairwise(line):
        length = math.hypot(b.x - a.x, b.y - a.y)
        if way <= length or b is line[-1]:
            part = way / length if length else 0.0
            return a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)
        way -= length
    return line[-1].x, line[-1].y

"""Courses of the speed over time, and the one way to write them.

A line becomes a `SpeedAction`, any other course a `SpeedProfileAction` (1.2) through points. Where
version or tool has none, an even change stands for it, which is not the same on the way.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Uneven
from osc2tx.backends.xosc.actions.speed.speed_elements import longitudinal, speed_action
from osc2tx.backends.xosc.actions.speed.speed_notes import NEAR, PROFILE_ACTION, SINCE_PROFILES
from osc2tx.backends.xosc.facts.actors import Course, Linear, apart, way_between
from osc2tx.backends.xosc.report import GENERIC, Metres
from osc2tx.backends.xosc.state import LONGITUDINAL, Interval, known
from osc2tx.xosc import elements as xml
from osc2tx.xosc.expressions import Symbol
from osc2tx_shared.classes import dataclass, replace

POINTS = 12
"""Points of a smooth course; the way it covers is within 2 cm for changes of 30 m/s."""

SAMPLES = 48
"""Pieces in which the extremes of a course are looked for."""

SAME = 1e-6
"""m/s between speeds that count as one."""

STRAIGHT = 1e-5
"""m/s^2 by which accelerations before and after a point may differ on a straight line."""


@dataclass(frozen=True, slots=True)
class Computed:
    """A course of the speed.

    Attributes:
        duration: Seconds.
        value: Speed (m/s) after some seconds.
    """

    duration: float
    value: Callable[[float], float]


def follow_course(
    leaf: Leaf,
    course: Course,
    *,
    even: Linear | None = None,
    where: str = "",
    told: Arguments | None = None,
    rate: float = 0.0,
    count: int = POINTS,
) -> Change:
    """Return the change of the speed along a course.

    Its points are `count`; an acceleration (m/s^2) stays after it. The even change stands for it
    where need be; that it differs on the way is told of a modifier, or of the action.
    """
    if even is not None and not leaf.ctx.can(PROFILE_ACTION, "1.2"):
        _note_even(leaf, course, even, where, told or leaf.arguments)
        course = even
    is_line = isinstance(course, Linear)
    pieces = 1 if is_line else SAMPLES
    speeds = [course.value(course.duration * index / pieces) for index in range(pieces + 1)]
    end = speeds[-1]
    after = replace(leaf.state.finished(LONGITUDINAL), speed=known(end), rate=rate)
    during = replace(after, speed=Interval(min(speeds), max(speeds)))
    leaf.course = course
    action = through_points(course, count)
    if is_line:
        action = speed_action(end, "linear", "time", course.duration)
    return Change(LONGITUDINAL, (action,), course.duration, during, after)


def _note_even(leaf: Leaf, course: Course, even: Linear, where: str, told: Arguments) -> None:
    """Report that an even change stands for a course."""
    off = way_between(course, even)
    if abs(course.value(course.duration) - even.end) < SAME:
        leaf.uneven = Uneven(apart(course, even), course.duration)
    if off > NEAR:
        told.approximate(
            "a speed that changes unevenly needs SpeedProfileAction; it changes evenly instead",
            Metres(off, where),
            SINCE_PROFILES if leaf.ctx.version < "1.2" else GENERIC,
        )


def through_points(course: Course, count: int = POINTS) -> xml.PrivateAction:
    """Return a course through points, with times since the point before.

    Points on the straight line between others are left out: esmini does so too, and then waits for
    as many as there are entries.
    """
    step = course.duration / count
    speeds = [course.value(index * step) for index in range(count + 1)]
    entries, last = [], 0
    for index in range(1, count + 1):
        if index < count and _is_straight(speeds[index - 1 : index + 2], step):
            continue
        time, speed = round((index - last) * step, 9), round(speeds[index], 9)
        entries.append(xml.SpeedProfileEntry(time=time, speed=speed))
        last = index
    return longitudinal(xml.SpeedProfileAction(*entries, followingMode="position"))


def _is_straight(speeds: Sequence[float], step: float) -> bool:
    """Whether three speeds, a step (s) apart, lie on a line for all values of open parameters."""
    before, here, after = speeds
    if any(isinstance(speed, Symbol) for speed in speeds):
        return False
    return abs(before - 2.0 * here + after) < STRAIGHT * step

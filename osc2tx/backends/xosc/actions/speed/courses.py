"""Speeds as elements, and courses of the speed over time.

A line becomes a `SpeedAction`, any other course a `SpeedProfileAction` (1.2) through points. Where
version or tool has none, an even change stands for it, which is not the same on the way.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import ceil
from typing import Literal

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.facts.actors import Course, Linear
from osc2tx.backends.xosc.state import LONGITUDINAL, Interval, known
from osc2tx.losses.entries import GENERIC, Remedy
from osc2tx.xosc import elements as xml
from osc2tx.xosc.expressions import Symbol
from osc2tx.xosc.literals import DynamicsDimension, DynamicsShape
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.steps import DEFAULT_STEP

PROFILE_ACTION = "SpeedProfileAction"

SINCE_PROFILES = Remedy(version="1.2")

POINTS = 12
"""Points of a smooth course; the way it covers is within 2 cm for changes of 30 m/s."""

FEWEST_POINTS, MOST_POINTS = 4, 48

WHOLE = 1e-9
"""By which a number of steps may be off a whole one."""

APART = 0.03
"""Metres by which the points of a course may lead elsewhere: well within an exact document."""

SAMPLES = 48
"""Pieces in which the extremes of a course are looked for."""

SAME = 1e-6
"""m/s between speeds that count as one."""

STRAIGHT = 1e-5
"""m/s^2 by which accelerations before and after a point may differ on a straight line."""

RISE = 1.0
"""m/s from one step of a change to the next, for tools that take up speeds at once."""

MOST = 20
"""Steps of one change."""

TICK = 0.05
"""Seconds between two looks of such a tool: an action is over half of that late, on average."""


def speed_action(
    target: float | xml.RelativeTargetSpeed,
    shape: DynamicsShape = "step",
    dimension: DynamicsDimension = "time",
    value: float = 0.0,
) -> xml.PrivateAction:
    """Return a `SpeedAction` to a speed; the change to it lasts so long, or has such a rate."""
    goal: xml.SpeedActionTargetPart = (
        target
        if isinstance(target, xml.RelativeTargetSpeed)
        else xml.AbsoluteTargetSpeed(value=target)
    )
    dynamics = xml.SpeedActionDynamics(
        dynamicsShape=shape, dynamicsDimension=dimension, value=value
    )
    return longitudinal(xml.SpeedAction(dynamics, xml.SpeedActionTarget(goal)))


def speed_of(
    reference: str,
    value: float = 0.0,
    kind: Literal["delta", "factor"] = "delta",
    *,
    continuous: bool = True,
) -> xml.RelativeTargetSpeed:
    """Return the speed of another actor, plus a value (m/s) or times a factor.

    If it is continuous, it is so at every moment from then on.
    """
    return xml.RelativeTargetSpeed(
        entityRef=reference, value=value, speedTargetValueType=kind, continuous=continuous
    )


def hold_speed(entity: str) -> xml.PrivateAction:
    """Return the action that ends a change of the speed where it is."""
    return speed_action(speed_of(entity, continuous=False))


def ends_evenly(change: Change) -> bool:
    """Whether a change of the speed keeps its acceleration up to its end."""
    dynamics = (each for action in change.actions for each in action.below(xml.SpeedActionDynamics))
    return any(each.dynamicsShape == "linear" for each in dynamics)


def longitudinal(action: xml.LongitudinalActionPart) -> xml.PrivateAction:
    """Return the private action around a longitudinal one."""
    return xml.PrivateAction(xml.LongitudinalAction(action))


def in_steps(leaf: Leaf, performance: Performance) -> tuple[xml.ActionPart, ...]:
    """Return actions that change a speed one after the other; none where one action does it.

    That is for what nothing cuts short: the steps would go on.
    """
    course = leaf.course
    if not leaf.ctx.profile.takes_speeds_at_once or course is None:
        return ()
    if [change.domain for change in performance.changes if change.actions] != [LONGITUDINAL]:
        return ()
    start, end = course.value(0.0), course.value(course.duration)
    if isinstance(start, Symbol) or isinstance(end, Symbol):  # another value has other steps
        return ()
    count = min(ceil(abs(end - start) / RISE), MOST)
    length = course.duration / max(count, 1)
    if count < 2 or length <= 2.0 * TICK:
        return ()
    leaf.arguments.approximate(
        f"{leaf.ctx.profile.name} takes up a speed at once, so it changes in {count} steps",
        "off by the way that each of them takes, more where throttle and brakes are not enough",
        GENERIC,
    )
    middles = [round(course.value((step + 0.5) * length), 6) for step in range(count)]
    lasting = round(length - 0.5 * TICK, 6)
    steps = (speed_action(speed, "linear", "time", lasting) for speed in middles)
    return (*steps, speed_action(end))


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
    told: Arguments | None = None,
    rate: float = 0.0,
    count: int = POINTS,
) -> Change:
    """Return the change of the speed along a course.

    Its points are `count`; an acceleration (m/s^2) stays after it. The even change stands for it
    where need be; that it differs on the way is told of a modifier, or of the action.
    """
    can_draw = leaf.ctx.can(PROFILE_ACTION, "1.2")
    if even is not None and not can_draw:
        reason = "a speed that changes unevenly needs SpeedProfileAction; it changes evenly instead"
        note_even(leaf, told or leaf.arguments, reason)
    world, course = course, course if even is None or can_draw else even
    is_line = isinstance(course, Linear)
    pieces = 1 if is_line else SAMPLES
    speeds = [course.value(course.duration * index / pieces) for index in range(pieces + 1)]
    end = speeds[-1]
    after = replace(leaf.state.finished(LONGITUDINAL), speed=known(end), rate=rate)
    during = replace(after, speed=Interval(min(speeds), max(speeds)))
    is_same = abs(world.value(world.duration) - end) < SAME
    leaf.course = world if is_same else course  # which steps may follow
    if is_line:
        action = speed_action(end, "linear", "time", course.duration)
    else:
        action = through_points(course, count)
    return Change(LONGITUDINAL, (action,), course.duration, during, after)


def note_even(leaf: Leaf, told: Arguments, reason: str) -> None:
    """Report that an even change stands for one that is not even."""
    told.doubt(reason, SINCE_PROFILES if leaf.ctx.version < "1.2" else GENERIC)


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


def points_for(course: Computed) -> int:
    """Return how many points take an actor along a course, at each time nearly where it is there.

    The time between them is that of whole steps if up to twice as many points suffice for it: then
    nothing that begins at a point begins a part of a step late. A course of open parameters has
    twice as many as others, for its bends are not known.
    """
    if isinstance(course.value(0.5 * course.duration), Symbol):
        return 2 * POINTS
    counts = range(FEWEST_POINTS, MOST_POINTS)
    fewest = next((count for count in counts if _apart(course, count) <= APART), MOST_POINTS)
    in_steps = (n for n in range(fewest, 2 * fewest + 1) if _lasts_steps(course.duration / n))
    return next(in_steps, fewest)


def _lasts_steps(seconds: float) -> bool:
    """Whether a time is that of whole steps."""
    steps = seconds / DEFAULT_STEP
    return abs(steps - round(steps)) < WHOLE


def _apart(course: Computed, count: int) -> float:
    """Return the largest distance (m) between who follows a course and who follows its points."""
    step = course.duration / count
    apart, most = 0.0, 0.0
    for index in range(count):
        left, right = course.value(index * step), course.value((index + 1) * step)
        middle = course.value((index + 0.5) * step)
        apart += step * (4.0 * middle - 2.0 * (left + right)) / 6.0  # by Simpson's rule
        most = max(most, abs(apart))
    return most


def _is_straight(speeds: Sequence[float], step: float) -> bool:
    """Whether three speeds, a step (s) apart, lie on a line for all values of open parameters."""
    before, here, after = speeds
    if any(isinstance(speed, Symbol) for speed in speeds):
        return False
    return abs(before - 2.0 * here + after) < STRAIGHT * step

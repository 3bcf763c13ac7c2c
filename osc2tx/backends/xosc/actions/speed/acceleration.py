"""Actions on the acceleration (§8.8.2.7, §8.8.2.14, §8.8.2.15) and its modifier (§8.9.7).

The XML knows changes of the speed only: an acceleration that lasts is a linear change of the
speed, one that changes is a course through points.
"""

from __future__ import annotations

import math
from itertools import pairwise
from math import inf

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Change, Changes, Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action, apply_modifiers, modifier, to_goal
from osc2tx.backends.xosc.actions.speed.courses import (
    PROFILE_ACTION,
    Computed,
    follow_course,
    speed_action,
)
from osc2tx.backends.xosc.facts.actors import (
    TOP_SPEED,
    Linear,
    Quintic,
    course_of_acceleration,
    integral,
)
from osc2tx.backends.xosc.state import LONGITUDINAL, known
from osc2tx.backends.xosc.values.constants import as_number
from osc2tx.losses.entries import Inexpressible
from osc2tx_shared.classes import replace

UNKNOWN_RATE = "the present acceleration is only known during the run"


@action("assign_acceleration")
def _assign_acceleration(leaf: Leaf) -> Performance:
    rate = leaf.arguments.required("acceleration")
    after = ir.follower(leaf.ctx.scenario.body, leaf.node)
    if after is None or after.action != "keep_acceleration":
        raise Inexpressible(
            "the XML has no acceleration, only changes of the speed: `keep_acceleration` has to"
            " follow, which says for how long"
        )
    state = replace(leaf.state.finished(LONGITUDINAL), rate=rate)
    return Performance((Change(LONGITUDINAL, (), 0.0, state, state),), "goal")


@action("keep_acceleration")
def _keep_acceleration(leaf: Leaf) -> Performance:
    if leaf.state.rate is None:
        raise Inexpressible(UNKNOWN_RATE)
    return Performance((accelerated(leaf, leaf.state.rate), *apply_modifiers(leaf)), "open")


@action("change_acceleration")
def _change_acceleration(leaf: Leaf) -> Performance:
    target, pace = leaf.arguments.required("target"), leaf.arguments.pace()
    if leaf.state.rate is None:
        raise Inexpressible(UNKNOWN_RATE)
    if pace.peak is None and pace.profile != "asap":
        pace = pace._replace(duration=leaf.duration)
    course = course_of_acceleration(leaf.state.rate, target, pace, leaf.limits)
    return to_goal(leaf, _ramp(leaf, course, course.duration))


@modifier("acceleration")
def _acceleration(leaf: Leaf, call: Arguments) -> Changes:
    if call.at != "all":
        raise Inexpressible(f"an acceleration at the {call.at} only")
    own = user_shape(call)
    if own is not None:
        return (acceleration_by(leaf, own),)
    pace, target = call.shape()
    for name in ("acceleration", "acceleration_range"):
        given = call.number(name)
        target = given if given is not None else target
    if target is None:
        raise Inexpressible("no acceleration is stated")
    if any(other.name == "speed" and other.at != "start" for other in leaf.node.modifiers):
        return ()  # it says how fast the speed is reached, see `speed`
    if "shape" not in call:
        return (accelerated(leaf, target),)
    if leaf.duration is None:
        raise Inexpressible("how long the acceleration lasts is only known during the run")
    if leaf.state.rate is None:
        raise Inexpressible(UNKNOWN_RATE)
    course = course_of_acceleration(leaf.state.rate, target, pace, leaf.limits)
    return (_ramp(leaf, course, leaf.duration),)


def accelerated(leaf: Leaf, rate: float) -> Change:
    """Return a constant acceleration (m/s^2) while the action lasts; it ends at standstill."""
    state, duration = leaf.state, leaf.duration
    if rate == 0.0:
        return Change(LONGITUDINAL, (), 0.0, state, state)
    if duration is None:
        duration = _time_over_distance(leaf, rate)
    start, goal = state.known_speed, TOP_SPEED if rate > 0.0 else 0.0
    if duration is not None and start is not None:
        end = start + rate * duration
        if rate < 0.0 and end < 0.0 <= start:
            end, duration = 0.0, -start / rate
        return follow_course(leaf, Linear(start, end, duration), rate=rate if end else 0.0)
    # Whatever ends it cuts the change short.
    leaf.demand(max(rate, 0.0), max(-rate, 0.0))
    if start is not None:
        leaf.course = Linear(start, goal, (goal - start) / rate)
    speed = None if state.speed is None else state.speed.over(known(goal))
    during = replace(state.finished(LONGITUDINAL), speed=speed, rate=rate)
    after = replace(during, speed=known(goal), rate=0.0)
    action = speed_action(goal, "linear", "rate", abs(rate))
    return Change(LONGITUDINAL, (action,), None, during, after)


def _time_over_distance(leaf: Leaf, rate: float) -> float | None:
    """Return after how many seconds of an acceleration (m/s^2) the distance of a drive is covered.

    `None`: no distance ends it, or it comes to a stand before, or the speed is not known.
    """
    speed, call = leaf.state.known_speed, leaf.modifier("distance")
    if call is None or speed is None:
        return None
    distance = call.number("distance")
    square = 0.0 if distance is None else speed**2 + 2.0 * rate * distance
    return round((math.sqrt(square) - speed) / rate, 9) if square > 0.0 else None


def ramp(start: float, rates: Linear | Quintic, duration: float) -> Computed:
    """Return the speed from a start (m/s) while the acceleration takes a course and then stays.

    It does not go through a stand.
    """

    def value(t: float) -> float:
        speed = start + integral(rates, t)
        return max(speed, 0.0) if start >= 0.0 else speed

    return Computed(duration, value)


def _ramp(leaf: Leaf, rates: Linear | Quintic, duration: float) -> Change:
    """Return the change of the speed that a course of the acceleration makes."""
    course = ramp(leaf.known_speed(), rates, duration)
    even = Linear(course.value(0.0), course.value(duration), duration)
    if duration == 0.0:
        after = replace(leaf.state.finished(LONGITUDINAL), rate=rates.end)
        return Change(LONGITUDINAL, (), 0.0, after, after)
    return follow_course(leaf, course, even=even, rate=rates.end)


NEAR = 0.02
"""m/s by which the speed at the start may be another one."""

COUNT = 24
"""Points of a course."""

STEPS = 400
"""Pieces in which an acceleration is summed up."""


def user_shape(arguments: Arguments) -> ir.UserShape | None:
    """Return the shape of a modifier if it is one of the scenario's own."""
    given = arguments.expression("shape")
    return given if isinstance(given, ir.UserShape) else None


def speed_by(leaf: Leaf, shape: ir.UserShape) -> Change:
    """Return the change that a shape of the speed makes."""
    return _shaped(leaf, Computed(_length(leaf, shape), lambda t: _computed(leaf, shape, t)))


def acceleration_by(leaf: Leaf, shape: ir.UserShape) -> Change:
    """Return the change that a shape of the acceleration makes."""
    start = leaf.known_speed()
    length = _length(leaf, shape)
    step = length / STEPS
    rates = [_computed(leaf, shape, index * step) for index in range(STEPS + 1)]
    speeds = [start]
    for left, right in pairwise(rates):
        speeds.append(speeds[-1] + 0.5 * step * (left + right))

    def between(t: float) -> float:
        index = min(int(t / step), STEPS - 1)
        share = t / step - index
        return speeds[index] + share * (speeds[index + 1] - speeds[index])

    return _shaped(leaf, Computed(length, between))


def _shaped(leaf: Leaf, course: Computed) -> Change:
    leaf.ctx.require("a course of the speed", "1.2")
    leaf.ctx.require_support(PROFILE_ACTION)
    start, speed = course.value(0.0), leaf.state.speed
    if speed is None or not speed.low - NEAR <= start <= speed.high + NEAR:
        raise Inexpressible("the shape does not begin with the speed at the start")
    change = follow_course(leaf, course, count=COUNT)
    if change.during.speed is None or change.during.speed.low < 0.0:
        raise Inexpressible("the shape goes backwards")
    return change


# --- methods of the shape -----------------------------------------------------------------------


def _length(leaf: Leaf, shape: ir.UserShape) -> float:
    """Return how long (s) a shape goes on in an invocation."""
    own = inf if shape.duration is None else _number(leaf, shape, shape.duration)
    length = min(own, inf if leaf.duration is None else leaf.duration)
    if not 0.0 < length < inf:
        raise Inexpressible("how long the shape goes on is only known during the run")
    return length


def _computed(leaf: Leaf, shape: ir.UserShape, time: float) -> float:
    return _number(leaf, shape, shape.compute, time)


def _number(leaf: Leaf, shape: ir.UserShape, name: str, *given: float) -> float:
    """Return what a method of a shape returns."""
    values, scenario = leaf.ctx.values, leaf.ctx.scope.scenario
    method = next(method for method in scenario.methods if method.name == name)
    arguments = (values.of(shape.operand), *given)
    names = (parameter.name for parameter in method.parameters)
    value = as_number(values.result_of(method, dict(zip(names, arguments, strict=False))))
    if value is None:
        raise Inexpressible(f"`{name}` gives no number", method.span)
    return value

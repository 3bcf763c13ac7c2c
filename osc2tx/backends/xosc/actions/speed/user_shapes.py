"""User-defined shapes (§8.9.1.2): speeds that methods of the scenario compute.

They are computed before the run and drawn through points, close enough to each other.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import inf

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Change, Leaf
from osc2tx.backends.xosc.actions.speed.speed_changes import through_points
from osc2tx.backends.xosc.actions.speed.speed_notes import PROFILE_ACTION
from osc2tx.backends.xosc.report import Inexpressible, Metres
from osc2tx.backends.xosc.state import LONGITUDINAL, Interval, known
from osc2tx.backends.xosc.values.constants import as_number
from osc2tx_shared.classes import dataclass, replace

NEAR = 0.02
"""m/s within which a line between points is the course."""

COUNTS = (12, 24, 48, 96)
"""Numbers of points that are tried."""

STEPS = 400
"""Pieces in which an acceleration is summed up."""


@dataclass(frozen=True, slots=True)
class Computed:
    """A course of the speed.

    Attributes:
        duration: Seconds.
        speed: Speed (m/s) after some seconds.
    """

    duration: float
    speed: Callable[[float], float]

    def value(self, t: float) -> float:
        """Return the speed (m/s) after some seconds."""
        return self.speed(t)


def user_shape(arguments: Arguments) -> ir.UserShape | None:
    """Return the shape of a modifier if it is one of the scenario's own."""
    given = arguments.expression("shape")
    return given if isinstance(given, ir.UserShape) else None


def speed_by(leaf: Leaf, shape: ir.UserShape) -> Change:
    """Return the change that a shape of the speed makes."""
    length = _length(leaf, shape)
    return _change(leaf, Computed(length, lambda t: _computed(leaf, shape, t)))


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

    return _change(leaf, Computed(length, between))


def _change(leaf: Leaf, course: Computed) -> Change:
    leaf.ctx.require("a course of the speed", "1.2", leaf.node.span)
    leaf.ctx.require_support(PROFILE_ACTION, leaf.node.span)
    state = leaf.state
    start, end = course.value(0.0), course.value(course.duration)
    if state.speed is None or not state.speed.low - NEAR <= start <= state.speed.high + NEAR:
        raise Inexpressible("the shape does not begin with the speed at the start", leaf.node.span)
    samples = [course.value(course.duration * index / 48) for index in range(49)]
    if min(samples) < 0.0:
        raise Inexpressible("the shape goes backwards", leaf.node.span)
    count = next((each for each in COUNTS if _beside(course, each) <= NEAR), COUNTS[-1])
    off = _beside(course, count)
    if off > NEAR:
        leaf.approximate(
            f"a course of the speed goes through {count} points, in straight lines",
            Metres(off * course.duration, "ahead or behind"),
        )
    after = replace(state.finished(LONGITUDINAL), speed=known(end))
    during = replace(after, speed=Interval(min(samples), max(samples)))
    leaf.course = course
    return Change(LONGITUDINAL, (through_points(course, count),), course.duration, during, after)


def _beside(course: Computed, count: int) -> float:
    """Return how far (m/s) lines between points are from a course."""
    step = course.duration / count
    ends = [course.value(index * step) for index in range(count + 1)]
    middles = (course.value((index + 0.5) * step) for index in range(count))
    pairs = zip(middles, ends, ends[1:], strict=False)
    return max(abs(middle - 0.5 * (left + right)) for middle, left, right in pairs)


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

"""Monitors of the speed and its rate (DSL 8.9.4 to 8.9.7)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Acceleration, ChangeSpeed, Speed
from osc2tx_runtime.domain.monitoring.conditions import Condition, Reading
from osc2tx_runtime.domain.monitoring.registry import monitors
from osc2tx_runtime.domain.monitoring.shaped_values import (
    follows_course,
    is_course,
    limits,
    moment,
)
from osc2tx_runtime.enums import At

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Phase

Bounds = Callable[[], tuple[float, float]]
"""Returns the least and the greatest value that is allowed now."""


@monitors("speed")
def speed(modifier: Speed, phase: Phase) -> Iterator[Condition]:
    """The longitudinal or lateral speed, absolute or relative to a reference."""
    across = modifier.direction == "lateral"
    what = "its lateral speed" if across else "its speed"
    if modifier.reference is not None:
        measure = _relative(modifier, phase, across)
        what += f", with {modifier.reference.id} as the reference,"
    else:
        bounds = limits(modifier, phase, Speed.difference)
        measure = _absolute(phase, bounds, across)
    yield Condition(
        "speed",
        what,
        "speed",
        moment(modifier),
        measure,
        is_steady=modifier.reference is None and not follows_course(modifier),
        is_target=is_course(modifier),
    )


def _absolute(phase: Phase, bounds: Bounds, across: bool = False) -> Callable[[], Reading]:
    state, me = phase.world.state, phase.actor
    if across:
        return lambda: (state(me).lateral_speed, *bounds())
    return lambda: (state(me).v, *bounds())


def _relative(modifier: Speed, phase: Phase, across: bool) -> Callable[[], Reading]:
    """The speed within its range relative to a reference, followed one step later."""
    assert modifier.reference is not None
    bounds = limits(modifier, phase, Speed.difference)
    other, me = phase.track(modifier.reference.id, modifier.projected), phase.me
    field = "lateral_speed" if across else "v"

    def measure() -> Reading:
        there, (low, high) = other(), bounds()
        base, late = modifier.times * getattr(there, field), abs(there.a) * phase.dt
        return getattr(me(), field), base + low - late, base + high + late

    return measure


@monitors("change_speed")
def change_speed(modifier: ChangeSpeed, phase: Phase) -> Iterator[Condition]:
    """The speed at the end, relative to the speed at the start."""
    difference, start = limits(modifier, phase, ChangeSpeed.difference), phase.first.v

    def bounds() -> tuple[float, float]:
        low, high = difference()
        return start + low, start + high

    at: At = "all" if follows_course(modifier) else "end"
    yield Condition("change_speed", "its speed", "speed", at, _absolute(phase, bounds))


@monitors("keep_speed")
def keep_speed(modifier: object, phase: Phase) -> Iterator[Condition]:
    """The speed at the start, all the time."""
    start = phase.first.v
    measure = _absolute(phase, lambda: (start, start))
    yield Condition("keep_speed", "its speed", "speed", "all", measure, is_steady=True)


@monitors("acceleration")
def acceleration(modifier: Acceleration, phase: Phase) -> Iterator[Condition]:
    """The change of the speed over each step.

    It ends when a speed is reached that is also required all the time; a speed at the start or the
    end of the phase leaves it required.
    """
    bounds = limits(modifier, phase, Acceleration.bounds)
    if modifier.at == "start":
        yield _first_acceleration(phase, bounds)
        return
    me, before = phase.me, phase.state_before() if moment(modifier) == "end" else phase.me
    goals = [m for m in phase.modifiers if isinstance(m, Speed) and m.at == "all"]
    speeds = [condition.measure for goal in goals for condition in speed(goal, phase)]
    reached = [] if any(_holds(present()) for present in speeds) else speeds

    def measure() -> Reading | None:
        if phase.elapsed == 0.0:
            return None  # it belongs to the step before the phase
        if any(_holds(goal()) for goal in reached):
            return None
        low, high = bounds()
        now, change = me().a, abs(me().a - before().a)  # the mean over the last step
        return now, low - change, high + change

    yield Condition(
        "acceleration",
        "its acceleration",
        "acceleration",
        moment(modifier),
        measure,
        is_target=is_course(modifier),
    )


def _first_acceleration(phase: Phase, bounds: Bounds) -> Condition:
    """The acceleration at the start, extrapolated from the means over the first two steps."""
    me, before = phase.me, phase.state_before()

    def measure() -> Reading | None:
        if round(phase.elapsed / phase.dt) != 2:
            return None
        first, second = before().a, me().a
        return (first + 0.5 * (first - second), *bounds())

    what = "its acceleration at the start"
    return Condition("acceleration", what, "acceleration", "start", measure, is_late=True)


def _holds(reading: Reading | None) -> bool:
    return reading is not None and reading[1] - 1e-3 <= reading[0] <= reading[2] + 1e-3

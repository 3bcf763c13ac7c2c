"""Monitors of the speed and its rate (DSL 8.9.4 to 8.9.7)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Acceleration, ChangeSpeed, Speed
from osc2tx_runtime.domain.modifiers.base import wanted
from osc2tx_runtime.domain.monitoring.conditions import Condition, Reading
from osc2tx_runtime.domain.monitoring.registry import monitors

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Phase


@monitors("speed")
def speed(modifier: Speed, phase: Phase) -> Iterator[Condition]:
    """The speed, along or across the lane, absolute or against that of a reference."""
    if modifier.shaped and modifier.at == "all":
        return  # a course from one speed to another: it has a value at its end alone
    across = modifier.direction == "lateral"
    low, high = modifier.difference()
    what = "its lateral speed" if across else "its speed"
    measure = _absolute(phase, low, high, across)
    if modifier.reference is not None:
        measure = _relative(modifier, phase, low, high, across)
        what += f", with {modifier.reference.id} as the reference,"
    steady = modifier.reference is None
    yield Condition("speed", what, "speed", modifier.at, measure, is_steady=steady)


def _absolute(phase: Phase, low: float, high: float, across: bool) -> Callable[[], Reading]:
    state, me = phase.world.state, phase.actor
    if across:
        return lambda: (state(me).lateral_speed, low, high)
    return lambda: (state(me).v, low, high)


def _relative(
    modifier: Speed, phase: Phase, low: float, high: float, across: bool
) -> Callable[[], Reading]:
    """The speed within its range relative to a reference, which is followed one step later."""
    assert modifier.reference is not None
    other, me = phase.track(modifier.reference.id, modifier.projected), phase.me
    field = "lateral_speed" if across else "v"

    def measure() -> Reading:
        there = other()
        base, late = modifier.times * getattr(there, field), abs(there.a) * phase.dt
        return getattr(me(), field), base + low - late, base + high + late

    return measure


@monitors("change_speed")
def change_speed(modifier: ChangeSpeed, phase: Phase) -> Iterator[Condition]:
    """The speed at the end, against that at the start: it cannot have changed before."""
    low, high = modifier.difference()
    start = phase.first.v
    measure = _absolute(phase, start + low, start + high, across=False)
    yield Condition("change_speed", "its speed", "speed", "end", measure)


@monitors("keep_speed")
def keep_speed(modifier: object, phase: Phase) -> Iterator[Condition]:
    """The speed at the start, all the time."""
    start = phase.first.v
    measure = _absolute(phase, start, start, across=False)
    yield Condition("keep_speed", "its speed", "speed", "all", measure, is_steady=True)


@monitors("acceleration")
def acceleration(modifier: Acceleration, phase: Phase) -> Iterator[Condition]:
    """The change of the speed over each step.

    It ends where a speed is reached that is asked for as well; one that the phase begins with is
    none to reach.
    """
    if modifier.shape is not None and modifier.at == "all":
        return
    low, high = wanted(modifier.acceleration, modifier.acceleration_range, modifier.shape)
    me, before = phase.me, phase.state_before() if modifier.at == "end" else phase.me
    goals = [m for m in phase.modifiers if isinstance(m, Speed) and m.at != "start"]
    speeds = [condition.measure for goal in goals for condition in speed(goal, phase)]
    reached = [] if any(_holds(present()) for present in speeds) else speeds

    def measure() -> Reading | None:
        if phase.elapsed == 0.0:
            return None  # it belongs to the step before the phase
        if any(_holds(goal()) for goal in reached):
            return None
        now, change = me().a, abs(me().a - before().a)  # it is the mean over the last step
        return now, low - change, high + change

    if modifier.at != "start":
        yield Condition("acceleration", "its acceleration", "acceleration", modifier.at, measure)


def _holds(reading: Reading | None) -> bool:
    return reading is not None and reading[1] - 1e-3 <= reading[0] <= reading[2] + 1e-3

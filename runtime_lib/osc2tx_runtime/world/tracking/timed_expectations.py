"""Expectations that have a time: arrivals and schedules.

They are judged at the end of their time, from the measurements until then; the motion until then is
free.
"""

from __future__ import annotations

from osc2tx_runtime.world.commands import Arrive, FollowSpeed, KeepGap, KeepSchedule
from osc2tx_runtime.world.longitudinal.arrival_schedule import PATIENCE as LATEST
from osc2tx_runtime.world.longitudinal.gap_control import allowed_gap
from osc2tx_runtime.world.measuring.deviation import PLACE_TOLERANCE, SPEED_TOLERANCE
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs

_OVER = 1e-9  # s


class Arrival:
    """Reaches a position after a time, with the required speed.

    Args:
        command: The position, the time and the speed.
    """

    def __init__(self, command: Arrive) -> None:
        self._command = command
        self._left = command.duration
        self._covered = 0.0
        self._judged: Progress | None = None

    def __call__(self, me: ActorState, inputs: StepInputs) -> Progress:
        """Judge position and speed at the step at which the time ends."""
        self._covered += me.v * inputs.dt
        self._left -= inputs.dt
        if self._judged is None and self._left <= _OVER:
            self._judged = self._judge(me, inputs)
        return self._judged or PENDING

    def _judge(self, me: ActorState, inputs: StepInputs) -> Progress:
        command = self._command
        if command.gap is None:
            missing: float | None = (command.way or 0.0) - self._covered
        else:
            missing = gap_error(command.gap, me, inputs)
        if missing is None:
            assert command.gap is not None
            return Progress(False, f"there is no route along lanes to {command.gap.reference}")
        place = _at_its_time(missing, PLACE_TOLERANCE, "m short of its target position")
        match command.speed:
            case None:
                return place
            case FollowSpeed() as other:
                slow = speed_error(other, me, inputs)
            case speed:
                slow = speed - me.v
        return place if place.failed else _at_its_time(slow, SPEED_TOLERANCE, "m/s too slow")


class Timetable:
    """Reaches the end of a curve over time, with the tolerance of driven actors.

    Args:
        command: The curve.
    """

    def __init__(self, command: KeepSchedule) -> None:
        self._command = command
        self._goal = command.curve.length_at(command.end)
        self._along = command.curve.length_at(command.begin)
        self._left = command.end - command.begin

    def __call__(self, me: ActorState, inputs: StepInputs) -> Progress:
        """Judge its measured position along the curve."""
        reach = max(2.0 * abs(me.v) * inputs.dt, 1.0)
        self._along = self._command.curve.nearest(me.x, me.y, self._along, reach)
        self._left -= inputs.dt
        missing = self._goal - self._along
        if missing <= PLACE_TOLERANCE:
            return REACHED
        if self._left > -LATEST:
            return PENDING
        return Progress(
            False, f"it is still {missing:.1f} m from the end, {LATEST:g} s after its time"
        )


def speed_error(command: FollowSpeed, me: ActorState, inputs: StepInputs) -> float:
    """Missing speed (m/s) of an actor relative to a reference."""
    difference = command.difference
    if command.course is not None:
        difference = command.course.value(command.course.duration)
    least = inputs.state(command.reference).v * command.factor + difference
    return min(max(me.v, least), least + command.spread) - me.v


def gap_error(command: KeepGap, me: ActorState, inputs: StepInputs) -> float | None:
    """Distance (m) of an actor to its target position; None if no lanes lead there."""
    found = allowed_gap(command, me, inputs.state(command.reference), me.v, inputs)
    if found is None:
        return None
    here, low, high = found
    return min(max(here, low), high) - here


def _at_its_time(missing: float, tolerance: float, words: str) -> Progress:
    if abs(missing) <= tolerance:
        return REACHED
    return Progress(False, f"at the end of its duration it is {missing:.1f} {words}")

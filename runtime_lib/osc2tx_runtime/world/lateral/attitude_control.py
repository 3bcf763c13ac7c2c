"""Execution of `Turn`: heading, pitch and roll of actors off the lanes."""

from __future__ import annotations

from osc2tx_runtime.opendrive.geometry import wrap
from osc2tx_runtime.world.commands import Turn
from osc2tx_runtime.world.geometry.attitude import Tilt
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState

from .curve_following import TURN_RATE

_TURNED = 1e-9  # rad


class Turning:
    """Turns at the limit of the actor, or along a profile."""

    def __init__(self, command: Turn) -> None:
        self._command = command
        self._steps = 0
        self._time = 0.0

    def after(self, state: ActorState, tilt: Tilt, dt: float) -> tuple[float, Tilt]:
        """Heading (rad) at the next step, and the commanded tilt; called once per step."""
        self._steps += 1
        self._time, most = self._steps * dt, TURN_RATE * dt
        heading, pitch, roll = (min(max(left, -most), most) for left in self._missing(state))
        tilt = Tilt(
            tilt.pitch if self._command.pitch is None else state.pitch + pitch,
            tilt.roll if self._command.roll is None else state.roll + roll,
        )
        return wrap(state.h + heading), tilt

    def progress(self, state: ActorState) -> Progress:
        """Done when the orientation is reached."""
        course = self._command.course
        over = course is None or self._time >= course.duration - _TURNED
        there = all(abs(left) < _TURNED for left in self._missing(state))
        return REACHED if over and there else PENDING

    def _missing(self, state: ActorState) -> tuple[float, float, float]:
        """Remaining turn (rad): heading, pitch, roll."""
        turn = self._command
        heading = turn.heading if turn.course is None else turn.course.value(self._time)
        return (
            0.0 if heading is None else turn_between(state.h, heading),
            0.0 if turn.pitch is None else turn_between(state.pitch, turn.pitch),
            0.0 if turn.roll is None else turn_between(state.roll, turn.roll),
        )

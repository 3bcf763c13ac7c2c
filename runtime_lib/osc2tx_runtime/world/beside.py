"""Lateral commands that run on feedback: beside another actor, or sideways at a constant speed."""

from __future__ import annotations

import math

from .catalogue import COMFORT, Limits
from .commands import Beside, Sideways
from .distances import side_gap
from .lateral_limits import SIDEWAYS
from .protocol import PENDING, REACHED, Progress
from .senses import Senses
from .state import ActorState

__all__ = ["BesideRun", "SidewaysRun"]

_RATE = 1.0  # 1/s: how fast small errors decay
_NEAR = 0.05  # m at which a distance counts as reached
_RATE_NEAR = 0.02  # m/s at which a lateral speed counts as reached
_STEPS = 4  # steps for which it must stay so


class SidewaysRun:
    """A constant speed across the lane, as far as the heading allows."""

    def __init__(self, command: Sideways) -> None:
        self._speed = command.speed
        self._reached = False

    def offset_after(
        self, offset: float, path: float, me: ActorState, senses: Senses
    ) -> tuple[float, float]:
        """One step to the side."""
        room = abs(path) * SIDEWAYS / senses.dt
        speed = min(max(self._speed, -room), room)
        self._reached = speed == self._speed
        return offset + speed * senses.dt, speed

    def progress(self) -> Progress:
        """Done while it has the speed."""
        return REACHED if self._reached else PENDING


class BesideRun:
    """Feedback on the distance across the lane to another actor."""

    def __init__(self, command: Beside, limits: Limits, rate: float) -> None:
        self._command = command
        self._limit = COMFORT * limits.lateral
        self._speed = rate
        self._settled = 0
        self._failed: str | None = None

    def offset_after(
        self, offset: float, path: float, me: ActorState, senses: Senses
    ) -> tuple[float, float]:
        """A step at the lateral speed that closes the error, within the limits."""
        command = self._command
        other = senses.state(command.reference)
        to_left = senses.aside(me, other)
        if to_left is None:
            self._failed = f"there is no way along lanes to {command.reference}"
            return offset, 0.0
        if command.left is not None:
            error = command.left + to_left  # it is `-to_left` left of the other one
            speed = min(_RATE * abs(error), math.sqrt(2.0 * self._limit * abs(error)))
            wanted = other.lateral_speed + math.copysign(speed, error)
            near = abs(error) < _NEAR and abs(self._speed - wanted) < 4.0 * _RATE_NEAR
        else:
            gap = side_gap(to_left, me.shape, other.shape)
            wanted = other.lateral_speed - gap / (command.time or senses.dt)
            near = abs(self._speed - wanted) < _RATE_NEAR
        self._settled = self._settled + 1 if near else 0
        change = self._limit * senses.dt
        speed = min(max(wanted, self._speed - change), self._speed + change)
        room = abs(path) * SIDEWAYS / senses.dt
        speed = min(max(speed, -room), room)
        moved = 0.5 * (self._speed + speed) * senses.dt
        moved = min(max(moved, -room * senses.dt), room * senses.dt)
        self._speed = speed
        return offset + moved, speed

    def progress(self) -> Progress:
        """Done when the distance has been held for some steps."""
        return Progress(self._settled >= _STEPS, self._failed)

"""Schedule of a trajectory: the speed that reaches its points in time."""

from __future__ import annotations

import math

from osc2tx_runtime.world.actor_dimensions import Limits
from osc2tx_runtime.world.commands import KeepSchedule
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs

_CATCH_UP = 0.8  # 1/s: how fast a delay decays
_ARRIVED = 0.1  # m from the end that count as reached
PATIENCE = 10.0
"""Seconds after the last time within which an actor may still arrive."""


def towards(speed: float, wanted: float, limits: Limits, share: float, dt: float) -> float:
    """Speed at the next step, within a share of the limits."""
    rise = share * limits.acceleration * dt
    fall = share * limits.deceleration * dt
    if speed < 0.0:
        rise, fall = fall, rise
    return min(max(wanted, speed - fall), speed + rise)


class Schedule:
    """Feedback: the speed of the curve, increased or reduced while the actor is late or early."""

    def __init__(self, command: KeepSchedule, me: ActorState, limits: Limits) -> None:
        self._curve = command.curve
        self._begin, self._end = command.begin, command.end
        self._limits = limits
        self._goal = self._curve.length_at(command.end)
        self._along = self._curve.nearest(me.x, me.y, self._curve.length_at(command.begin), 5.0)
        self._steps = 0
        self._late = math.inf
        self._failed: str | None = None

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """A step towards the speed that keeps the schedule."""
        curve, now = self._curve, self._begin + self._steps * inputs.dt
        self._steps += 1
        after = min(now + inputs.dt, self._end)
        reach = max(2.0 * abs(me.v) * inputs.dt, 1.0)
        self._along = curve.nearest(me.x, me.y, self._along, reach)
        behind = curve.length_at(min(now, self._end)) - self._along
        missing = self._goal - self._along
        if now > self._end + PATIENCE and missing > _ARRIVED:
            self._failed = (
                f"it is still {missing:.1f} m from the end, {PATIENCE:g} s after its time"
            )
        dx, dy, _ = curve.rate(after)
        feed = math.hypot(dx, dy) if now < self._end else 0.0
        brake = 0.5 * self._limits.deceleration
        catch_up = min(_CATCH_UP * abs(behind), math.sqrt(2.0 * brake * abs(behind)))
        wanted = max(feed + math.copysign(catch_up, behind), 0.0)
        speed = towards(me.v, wanted, self._limits, 1.0, inputs.dt)
        self._late = missing - 0.5 * (me.v + speed) * inputs.dt
        return speed

    def progress(self) -> Progress:
        """Done at the end of the curve, at the step that gets there."""
        if self._failed is not None:
            return Progress(False, self._failed)
        return REACHED if self._late <= _ARRIVED else PENDING

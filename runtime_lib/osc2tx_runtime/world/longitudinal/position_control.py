"""Longitudinal commands that give the position over time.

The position after each step is that of the profile, not the integral of a mean of two speeds, so
that errors do not accumulate. Distance lost to the limits is regained as soon as they allow it.
"""

from __future__ import annotations

import math

from osc2tx_runtime.world.actor_dimensions import TYRES, Limits
from osc2tx_runtime.world.commands import Cover, GapCourse
from osc2tx_runtime.world.geometry.profiles import Profile
from osc2tx_runtime.world.measuring.projected_motion import Tracked
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs

from .arrival_schedule import towards

_NEAR = 0.1  # m: tolerance of the position at the end
_CATCH_UP = 2.0  # 1/s: rate at which a deficit is regained
_JUST_BEFORE = 1e-9  # s


class PlacedRun:
    """Follows a position over time.

    Attributes:
        path: Length (m) of the last step; None: from its mean speed.
    """

    def __init__(self, course: Profile, exact: bool, limits: Limits) -> None:
        self._course = course
        self._exact = exact
        self._limits = limits if limits.road else TYRES
        self._steps = 0
        self._failed: str | None = None
        self._done = False
        self.path: float | None = None

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """Speed (m/s) at the next step; called once per step."""
        raise NotImplementedError

    def progress(self) -> Progress:
        """Done at the end of the course."""
        if self._failed is not None:
            return Progress(False, self._failed)
        return REACHED if self._done else PENDING

    def _step(self, me: ActorState, way: float, rate: float, dt: float) -> float:
        """Speed after a step of a length (m) with this rate at its end, within the limits."""
        if self._exact:
            self.path = way
            return rate
        wanted = rate + _CATCH_UP * (way - 0.5 * (me.v + rate) * dt)
        possible = towards(me.v, rate, self._limits, 1.0, dt)
        straight = abs(possible - rate) < 1e-9 and abs(way - 0.5 * (me.v + rate) * dt) < _NEAR
        self.path = way if straight else None
        return rate if straight else towards(me.v, wanted, self._limits, 1.0, dt)

    def _rate(self, t: float) -> float:
        """Rate at a time; at the end that just before it."""
        end = self._course.duration
        return self._course.rate(end - _JUST_BEFORE if math.isclose(t, end) else t)

    def _judge(self, t: float, missed: float) -> None:
        """Whether the target is reached when the profile ends."""
        if self._done or t < self._course.duration - 1e-9:
            return
        self._done = True
        if abs(missed) > _NEAR:
            side = "short of" if missed > 0.0 else "beyond"
            self._failed = (
                f"at the end of its shape it is {abs(missed):.1f} m {side} its target position"
            )


class CoverRun(PlacedRun):
    """Covers a distance over time; then it stops."""

    def __init__(self, command: Cover, limits: Limits) -> None:
        super().__init__(command.course, command.exact, limits)
        self._covered = 0.0
        self._before: tuple[float, float] | None = None  # speeds of the last step

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """Speed at the next step."""
        dt = inputs.dt
        self._note(me.v, dt)
        self._steps += 1
        t = self._steps * dt
        way = self._course.value(t) - self._covered
        speed = self._step(me, way, self._rate(t), dt)
        self._before = (me.v, speed)
        self._judge(t, way - (0.5 * (me.v + speed) * dt if self.path is None else self.path))
        return speed

    def slid(self, along: float) -> None:
        """Counts the measured surplus (m) of a step."""
        self._covered += along

    def _note(self, speed: float, dt: float) -> None:
        """Counts the last step, which an actor that was slowed down did not complete."""
        if self._before is None:
            return
        before, planned = self._before
        as_planned = speed == planned and self.path is not None
        self._covered += (self.path or 0.0) if as_planned else 0.5 * (before + speed) * dt


class GapCourseRun(PlacedRun):
    """Follows a distance to another actor over time; then it holds the last one."""

    def __init__(self, command: GapCourse, limits: Limits) -> None:
        super().__init__(command.course, command.exact, limits)
        self._reference = command.reference
        self._other = Tracked(command.reference, command.projected)

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """Speed at the next step, if the reference keeps its acceleration."""
        dt = inputs.dt
        self._steps += 1
        t = self._steps * dt
        other = self._other.state(inputs)
        here = inputs.along(other, me)
        if here is None:
            self._failed = f"there is no route along lanes to {self._reference}"
            return me.v
        its_speed = other.v + other.a * dt
        its_way = 0.5 * (other.v + its_speed) * dt
        way = self._course.value(t) - here + its_way
        speed = self._step(me, way, self._rate(t) + its_speed, dt)
        step = 0.5 * (me.v + speed) * dt if self.path is None else self.path
        self._judge(t, way - step)
        return speed

"""Limits of lateral motion on a lane."""

from __future__ import annotations

import math

from osc2tx_runtime.clock import whole_steps
from osc2tx_runtime.world.actor_dimensions import COMFORT, Limits
from osc2tx_runtime.world.commands import Beside, Sideways, Slant
from osc2tx_runtime.world.geometry.guidance import rate_to_place_and_speed
from osc2tx_runtime.world.geometry.profiles import Profile
from osc2tx_runtime.world.measuring.distances import drift, side_gap
from osc2tx_runtime.world.measuring.projected_motion import Tracked
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs

HEADING_LIMIT = 0.5
"""Largest angle (rad) between the heading of a vehicle and its lane."""

SIDEWAYS = math.sin(HEADING_LIMIT)
"""Largest share of lateral motion in the driven path."""


_RATE = 1.0  # 1/s: how fast small errors decay
_NEAR = 0.05  # m at which a distance counts as reached
_RATE_NEAR = 0.02  # m/s at which a lateral speed counts as reached
_HELD = 0.2  # s for which it must stay so


class SidewaysRun:
    """A lateral speed or a heading, within the limit of the heading."""

    def __init__(self, command: Sideways | Slant) -> None:
        self._command = command
        self._steps = 0
        self._over = False  # the profile, if there is one
        self._reached = False

    def _wanted(self, path: float, inputs: StepInputs) -> float:
        """Speed (m/s) to the left."""
        command, time = self._command, self._steps * inputs.dt
        course = command.course
        self._over = course is None or time >= course.duration - 1e-9
        if isinstance(command, Slant):
            angle = command.angle if course is None else course.value(time)
            return math.sin(angle) * path / inputs.dt
        speed = command.speed if course is None else course.value(time)
        if command.reference is None:
            return speed
        return speed + command.factor * inputs.state(command.reference).lateral_speed

    def offset_after(
        self, offset: float, path: float, me: ActorState, inputs: StepInputs
    ) -> tuple[float, float]:
        """One step of lateral motion."""
        self._steps += 1
        room = abs(path) * SIDEWAYS / inputs.dt
        wanted = self._wanted(path, inputs)
        speed = min(max(wanted, -room), room)
        self._reached = speed == wanted and self._over
        if isinstance(self._command, Sideways) and self._command.course is not None:
            return offset + 0.5 * (me.lateral_speed + speed) * inputs.dt, speed
        return offset + speed * inputs.dt, speed

    def progress(self) -> Progress:
        """Done while it has the last speed."""
        return REACHED if self._reached else PENDING


class BesideRun:
    """Feedback on the lateral distance to another actor."""

    def __init__(self, command: Beside, limits: Limits, rate: float) -> None:
        self._command = command
        self._limits = limits
        self._speed = rate
        self._other = Tracked(command.reference, command.projected)
        self._held = 0.0  # s for which the distance has been reached
        self._steps: int | None = None  # remaining, if there is a time
        self._elapsed = 0
        self._failed: str | None = None

    def offset_after(
        self, offset: float, path: float, me: ActorState, inputs: StepInputs
    ) -> tuple[float, float]:
        """A step at the lateral speed that closes the error, within the limits."""
        command, dt = self._command, inputs.dt
        other = self._other.state(inputs)
        to_left, moving = inputs.aside(me, other), drift(me, other)
        if to_left is None:
            self._failed = f"there is no route along lanes to {command.reference}"
            return offset, 0.0
        if self._steps is None and command.duration is not None:
            self._steps = max(whole_steps(command.duration, dt), 1)
        error = 0.0
        if command.left is None:
            gap = side_gap(to_left, me.shape, other.shape)
            wanted = moving - gap / (command.time or dt)
            self._note(abs(self._speed - wanted) < _RATE_NEAR, dt)
        elif command.course is not None:
            return self._on_course(command.course, offset, -to_left, path, moving, dt)
        else:
            own = -to_left  # its distance to the left of the reference
            error = min(max(own, command.left), command.left + command.spread) - own
            wanted = self._towards(error, moving, dt)
        limit = self._limits.lateral * (1.0 if self._steps else COMFORT)
        speed = min(max(wanted, self._speed - limit * dt), self._speed + limit * dt)
        room = abs(path) * SIDEWAYS / dt
        speed = min(max(speed, -room), room)
        moved = 0.5 * (self._speed + speed) * dt
        moved = min(max(moved, -room * dt), room * dt)
        self._speed = speed
        if self._steps:
            self._steps -= 1
            self._judge(error + moving * dt - moved)
        return offset + moved, speed

    def _on_course(
        self,
        course: Profile,
        offset: float,
        own: float,
        path: float,
        moving: float,
        dt: float,
    ) -> tuple[float, float]:
        """One step along a profile, if the reference continues its motion."""
        self._elapsed += 1
        time = self._elapsed * dt
        wanted = course.value(time) - own + moving * dt
        room = abs(path) * SIDEWAYS
        moved = min(max(wanted, -room), room)
        self._speed = course.rate(time) + moving if moved == wanted else moved / dt
        if self._held < _HELD and time >= course.duration - 1e-9:
            self._held = _HELD
            self._miss(wanted - moved)
        return offset + moved, self._speed

    def _towards(self, error: float, moving: float, dt: float) -> float:
        """The lateral speed (m/s) towards its target position."""
        if self._steps:
            missing = error - (self._speed - moving) * self._steps * dt
            change = moving - self._speed
            return self._speed + dt * rate_to_place_and_speed(self._steps, dt, missing, change)
        rate = min(_RATE * abs(error), math.sqrt(2.0 * COMFORT * self._limits.lateral * abs(error)))
        wanted = moving + math.copysign(rate, error)
        if self._steps is None:
            self._note(abs(error) < _NEAR and abs(self._speed - wanted) < 4.0 * _RATE_NEAR, dt)
        return wanted

    def _note(self, near: bool, dt: float) -> None:
        self._held = self._held + dt if near else 0.0

    def _judge(self, missed: float) -> None:
        """Whether the target is reached at the end of its duration."""
        if self._steps == 0:
            self._held = _HELD
            self._miss(missed)

    def _miss(self, missed: float) -> None:
        if abs(missed) > _NEAR:
            self._failed = (
                f"at the end of its duration it is {abs(missed):.2f} m from its position beside"
                f" {self._command.reference}"
            )

    def progress(self) -> Progress:
        """Done when the distance has been held for some time, or at the end of its duration."""
        return Progress(self._held >= _HELD - 1e-9, self._failed)

"""Longitudinal commands at work: the speed of an actor at the next step."""

from __future__ import annotations

import math
from typing import Protocol

from osc2tx_runtime.errors import UnsupportedError

from .catalogue import COMFORT, RATE_CAP, Limits
from .commands import (
    Accelerate,
    Command,
    FollowSpeed,
    KeepGap,
    SpeedChange,
    Standstill,
)
from .distances import gap_between, headway_between
from .profiles import Linear, Profile, Quintic, SCurve, quintic_duration
from .protocol import PENDING, REACHED, Progress
from .state import ActorState

__all__ = ["Longitudinal", "Senses", "longitudinal_of", "speed_profile"]

_SPEED_TOLERANCE = 0.05  # m/s at which a followed speed or gap counts as reached
_GAP_TOLERANCE = 0.1  # m at which a gap counts as reached
_GAP_STEPS = 4  # steps for which it must stay so
_GAP_RATE = 0.6  # 1/s: how fast small gap errors decay
_RESPONSE = 0.3  # s in which the gap controller corrects the speed


class Senses(Protocol):
    """What a command at work may read: the snapshot of the present step."""

    dt: float

    def state(self, actor: str) -> ActorState:
        """State of an actor."""

    def along(self, a: ActorState, b: ActorState) -> float | None:
        """Route distance (m) from a to b; None if not connected."""


class Longitudinal(Protocol):
    """A command at work on one actor."""

    def speed_after(self, me: ActorState, senses: Senses) -> float:
        """Speed (m/s) at the next step; called once per step."""

    def progress(self) -> Progress:
        """Progress at the present step."""


class _ProfileRun:
    """A speed change in closed form."""

    __slots__ = ("_profile", "_steps", "_time")

    def __init__(self, profile: Profile) -> None:
        self._profile = profile
        self._steps = 0
        self._time = 0.0

    def speed_after(self, me: ActorState, senses: Senses) -> float:
        """Value of the profile, at a time counted in steps."""
        self._steps += 1
        self._time = self._steps * senses.dt
        return self._profile.value(self._time)

    def progress(self) -> Progress:
        """Done when the profile has ended."""
        return REACHED if self._time >= self._profile.duration - 1e-9 else PENDING


class _Acceleration:
    """Constant acceleration from the speed at the start; does not go through standstill."""

    __slots__ = ("_acceleration", "_start", "_steps")

    def __init__(self, acceleration: float, start: float) -> None:
        self._acceleration = acceleration
        self._start = start
        self._steps = 0

    def speed_after(self, me: ActorState, senses: Senses) -> float:
        """Start speed plus acceleration times time."""
        self._steps += 1
        speed = self._start + self._acceleration * self._steps * senses.dt
        return 0.0 if self._start >= 0.0 > speed or self._start < 0.0 < speed else speed

    def progress(self) -> Progress:
        """Never done: there is no goal."""
        return PENDING


class _Following:
    """Feedback: the speed of another actor, approached within comfortable limits."""

    __slots__ = ("_command", "_done", "_limits")

    def __init__(self, command: FollowSpeed, limits: Limits) -> None:
        self._command = command
        self._limits = limits
        self._done = False

    def speed_after(self, me: ActorState, senses: Senses) -> float:
        """A step towards the speed of the reference at the present step."""
        command = self._command
        wanted = senses.state(command.reference).v * command.factor + command.difference
        speed = _towards(me.v, wanted, self._limits, COMFORT, senses.dt)
        self._done = abs(speed - wanted) < _SPEED_TOLERANCE
        return speed

    def progress(self) -> Progress:
        """Done while the speeds agree."""
        return REACHED if self._done else PENDING


def _towards(speed: float, wanted: float, limits: Limits, share: float, dt: float) -> float:
    """Speed one step on, within a share of the limits."""
    rise = share * limits.acceleration * dt
    fall = share * limits.deceleration * dt
    if speed < 0.0:
        rise, fall = fall, rise
    return min(max(wanted, speed - fall), speed + rise)


class _Gap:
    """Feedback on a distance to another actor.

    The closing speed grows linearly with a small error and with the square root of a large one,
    so that the actor can always still brake; it does not reverse.
    """

    __slots__ = ("_command", "_failed", "_limits", "_settled")

    def __init__(self, command: KeepGap, limits: Limits) -> None:
        self._command = command
        self._limits = limits
        self._settled = 0
        self._failed: str | None = None

    def speed_after(self, me: ActorState, senses: Senses) -> float:
        """A step towards the speed that closes the error."""
        command = self._command
        other = senses.state(command.reference)
        along = senses.along(other, me)
        if along is None:
            self._failed = f"there is no way along lanes to {command.reference}"
            return me.v
        here = _measured(command, along, me, other)
        wanted = self._distance(me, other)
        error = wanted - here if command.ahead else -wanted - here  # > 0: more speed is needed
        brake = COMFORT * min(self._limits.deceleration, 2.0 * self._limits.acceleration)
        closing = min(_GAP_RATE * abs(error), math.sqrt(2.0 * brake * abs(error)))
        goal = max(other.v + math.copysign(closing, error), 0.0)
        blend = min(1.0, senses.dt / _RESPONSE)
        speed = _towards(me.v, me.v + blend * (goal - me.v), self._limits, 1.0, senses.dt)
        near = abs(error) < _GAP_TOLERANCE and abs(me.v - other.v) < 4.0 * _SPEED_TOLERANCE
        self._settled = self._settled + 1 if near else 0
        return speed

    def _distance(self, me: ActorState, other: ActorState) -> float:
        command = self._command
        if command.time is None:
            return command.distance or 0.0
        return command.time * max(other.v if command.ahead else me.v, 0.0)

    def progress(self) -> Progress:
        """Done when the gap has been held for some steps."""
        return Progress(self._settled >= _GAP_STEPS, self._failed)


def _measured(command: KeepGap, along: float, me: ActorState, other: ActorState) -> float:
    match command.measure:
        case "gap":
            return gap_between(along, me.shape, other.shape)
        case "headway":
            return headway_between(along, me.shape, other.shape)
        case "reference":
            return along


def speed_profile(command: SpeedChange, speed: float, limits: Limits) -> Profile:
    """Closed form of a speed change that starts at `speed` (m/s).

    `none` and `constant` use comfortable limits where the command gives no rate, `asap` the full
    ones. Going faster uses the acceleration, going slower the deceleration; a change of direction
    uses the smaller of both.
    """
    target, peak, duration = command.target, command.rate_peak, command.duration
    change = abs(target - speed)
    if change == 0.0:
        return Linear(speed, target, 0.0)
    limit = _limit(speed, target, limits)
    rate = COMFORT * limit if peak is None else peak
    match command.profile:
        case "asap":
            return SCurve(speed, target, limit if peak is None else peak, limits.jerk)
        case "constant":
            return Linear(speed, target, change / rate if duration is None else duration)
        case "smooth":
            time = quintic_duration(change, rate_peak=rate, curve_peak=limits.jerk)
            return Quintic(speed, target, time if duration is None else duration)
        case _:
            if duration is not None:
                return Quintic(speed, target, duration)
            return SCurve(speed, target, rate, limits.jerk)


def _limit(speed: float, target: float, limits: Limits) -> float:
    if speed * target < 0.0:
        return min(limits.acceleration, limits.deceleration)
    return limits.acceleration if abs(target) > abs(speed) else limits.deceleration


def excessive_rate(command: SpeedChange, speed: float) -> str | None:
    """Why a speed change cannot be driven; None if it can."""
    if command.rate_peak is not None and not 0.0 < command.rate_peak <= RATE_CAP:
        return f"rate_peak {command.rate_peak:g} m/s^2 is not between 0 and {RATE_CAP:g} m/s^2"
    if command.duration is not None and command.profile != "asap":
        factor = 1.0 if command.profile == "constant" else 1.875
        change = factor * abs(command.target - speed)
        if change > RATE_CAP * command.duration:
            return (
                f"{speed:.1f} to {command.target:.1f} m/s in {command.duration:g} s takes more"
                f" than {RATE_CAP:g} m/s^2"
            )
    return None


def longitudinal_of(command: Command, speed: float, limits: Limits) -> Longitudinal:
    """Puts a longitudinal command to work at the present speed (m/s)."""
    match command:
        case SpeedChange():
            return _ProfileRun(speed_profile(command, speed, limits))
        case Standstill():
            return _ProfileRun(SCurve(speed, 0.0, limits.deceleration, limits.jerk))
        case Accelerate():
            return _Acceleration(command.acceleration, speed)
        case FollowSpeed():
            return _Following(command, limits)
        case KeepGap():
            return _Gap(command, limits)
    raise UnsupportedError(f"{type(command).__name__} is no longitudinal command")

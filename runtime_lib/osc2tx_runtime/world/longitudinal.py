"""Longitudinal commands at work: the speed of an actor at the next step."""

from __future__ import annotations

import math
from typing import Protocol

from osc2tx_runtime.errors import UnsupportedError

from .acceleration import AccelerationRun, ConstantAcceleration
from .catalogue import COMFORT, RATE_CAP, Limits
from .caution import Cautious, Hold
from .commands import (
    Accelerate,
    AccelerationChange,
    Careful,
    Command,
    FollowSpeed,
    KeepGap,
    KeepSchedule,
    ReplayTrajectory,
    SpeedChange,
    Standstill,
)
from .distances import gap_between, headway_between
from .profiles import Linear, Profile, Quintic, SCurve, quintic_duration
from .protocol import PENDING, REACHED, Progress
from .schedule import Schedule, towards
from .senses import Senses
from .state import ActorState

__all__ = [
    "Longitudinal",
    "excessive_acceleration",
    "excessive_rate",
    "longitudinal_of",
    "speed_profile",
]

_SPEED_TOLERANCE = 0.05  # m/s at which a followed speed or gap counts as reached
_GAP_TOLERANCE = 0.1  # m at which a gap counts as reached
_GAP_STEPS = 4  # steps for which it must stay so
_GAP_RATE = 0.6  # 1/s: how fast small gap errors decay
_RESPONSE = 0.3  # s in which the gap controller corrects the speed


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
        speed = towards(me.v, wanted, self._limits, COMFORT, senses.dt)
        self._done = abs(speed - wanted) < _SPEED_TOLERANCE
        return speed

    def progress(self) -> Progress:
        """Done while the speeds agree."""
        return REACHED if self._done else PENDING


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
        speed = towards(me.v, me.v + blend * (goal - me.v), self._limits, 1.0, senses.dt)
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


def excessive_rate(command: SpeedChange, speed: float, limits: Limits | None = None) -> str | None:
    """Why a speed change cannot be driven; None if it can.

    Args:
        command: The change.
        speed: Speed at its start (m/s).
        limits: Of the actor, where they must hold; None: only those of tyres do.
    """
    cap = RATE_CAP if limits is None else _limit(speed, command.target, limits)
    if command.rate_peak is not None and not 0.0 < command.rate_peak <= cap:
        return f"rate_peak {command.rate_peak:g} m/s^2 is not between 0 and {cap:g} m/s^2"
    if command.duration is not None and command.profile != "asap":
        factor = 1.0 if command.profile == "constant" else 1.875
        change = factor * abs(command.target - speed)
        if change > cap * command.duration * (1.0 + 1e-9):
            return (
                f"{speed:.1f} to {command.target:.1f} m/s in {command.duration:g} s takes more"
                f" than {cap:g} m/s^2"
            )
    return None


def excessive_acceleration(value: float, speed: float, limits: Limits | None = None) -> str | None:
    """Why an acceleration (m/s^2) cannot be; None if it can. Arguments as above."""
    gaining = value * speed >= 0.0
    cap = RATE_CAP
    if limits is not None:
        cap = limits.acceleration if gaining else limits.deceleration
    if abs(value) <= cap * (1.0 + 1e-9):
        return None
    return f"an acceleration of {value:.2f} m/s^2 is beyond the {cap:g} m/s^2 it can do"


def longitudinal_of(command: Command, me: ActorState, limits: Limits) -> Longitudinal:
    """Puts a longitudinal command to work on an actor in its present state."""
    speed = me.v
    match command:
        case SpeedChange():
            start = speed if command.start is None else command.start
            return _ProfileRun(speed_profile(command, start, limits))
        case Standstill():
            return _ProfileRun(SCurve(speed, 0.0, limits.deceleration, limits.jerk))
        case Accelerate():
            start = speed if command.start is None else command.start
            return ConstantAcceleration(command.acceleration, start)
        case AccelerationChange():
            return AccelerationRun(command, me, limits)
        case Careful():
            course = command.course
            inner = None if course is None else longitudinal_of(course, me, limits)
            return Cautious(command, inner, speed, limits)
        case KeepSchedule():
            return Schedule(command, me, limits)
        case ReplayTrajectory():
            return Hold(speed)
        case FollowSpeed():
            return _Following(command, limits)
        case KeepGap():
            return _Gap(command, limits)
    raise UnsupportedError(f"{type(command).__name__} is no longitudinal command")

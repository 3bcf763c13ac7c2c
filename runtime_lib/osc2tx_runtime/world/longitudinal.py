"""Longitudinal commands at work: the speed of an actor at the next step."""

from __future__ import annotations

from typing import Protocol

from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.opendrive import Route

from .acceleration import AccelerationRun, ConstantAcceleration
from .catalogue import COMFORT, TYRES, Limits
from .caution import Cautious, Hold
from .commands import (
    Accelerate,
    AccelerationChange,
    Arrive,
    Careful,
    Command,
    FollowSpeed,
    KeepGap,
    KeepSchedule,
    ReplayTrajectory,
    SpeedChange,
    Standstill,
)
from .gaps import ArrivalRun, GapRun
from .profiles import Linear, Profile, Quintic, SCurve, quintic_duration
from .protocol import PENDING, REACHED, Progress
from .schedule import Schedule, towards
from .senses import Senses
from .state import ActorState

__all__ = [
    "Longitudinal",
    "acceleration_of",
    "excessive_acceleration",
    "excessive_rate",
    "longitudinal_of",
    "speed_profile",
]

_SPEED_TOLERANCE = 0.05  # m/s at which a followed speed counts as reached


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

    @property
    def acceleration(self) -> float:
        """Acceleration (m/s^2) at the present step; zero once the speed is reached."""
        return 0.0 if self.progress().done else self._profile.rate(self._time)


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
        least = senses.state(command.reference).v * command.factor + command.difference
        wanted = min(max(me.v, least), least + command.spread)
        speed = towards(me.v, wanted, self._limits, COMFORT, senses.dt)
        self._done = abs(speed - wanted) < _SPEED_TOLERANCE
        return speed

    def progress(self) -> Progress:
        """Done while the speeds agree."""
        return REACHED if self._done else PENDING


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


def excessive_rate(command: SpeedChange, speed: float, limits: Limits = TYRES) -> str | None:
    """Why a speed change cannot be driven; None if it can.

    Args:
        command: The change.
        speed: Speed at its start (m/s).
        limits: Those that must hold: of the actor, or of tyres only.
    """
    cap = _limit(speed, command.target, limits)
    most = f"{cap:.4g} m/s^2{limits.road}"
    if command.rate_peak is not None and not 0.0 < command.rate_peak <= cap:
        return f"rate_peak {command.rate_peak:g} m/s^2 is not between 0 and {most}"
    if command.duration is not None and command.profile != "asap":
        factor = 1.0 if command.profile == "constant" else 1.875
        change = factor * abs(command.target - speed)
        if change > cap * command.duration * (1.0 + 1e-9):
            return (
                f"{speed:.1f} to {command.target:.1f} m/s in {command.duration:g} s takes more"
                f" than {most}"
            )
    return None


def excessive_acceleration(value: float, speed: float, limits: Limits = TYRES) -> str | None:
    """Why an acceleration (m/s^2) cannot be; None if it can. Arguments as above."""
    cap = limits.acceleration if value * speed >= 0.0 else limits.deceleration
    if abs(value) <= cap * (1.0 + 1e-9):
        return None
    return (
        f"an acceleration of {value:.2f} m/s^2 is beyond the {cap:.4g} m/s^2 it can do{limits.road}"
    )


def acceleration_of(run: Longitudinal | None, me: ActorState) -> float:
    """Acceleration (m/s^2) of this instant: that of a closed form, else the mean of the last step.

    A mean would make what follows depend on the size of the step.
    """
    return run.acceleration if isinstance(run, _ProfileRun | AccelerationRun) else me.a


def longitudinal_of(
    command: Command, me: ActorState, limits: Limits, route: Route | None = None
) -> Longitudinal:
    """Puts a longitudinal command to work on an actor in its present state, on its way.

    The acceleration of this state is that of the very instant, see `acceleration_of`.
    """
    speed = me.v
    match command:
        case SpeedChange():
            start = speed if command.start is None else command.start
            return _ProfileRun(speed_profile(command, start, limits))
        case Standstill():
            return _ProfileRun(SCurve(speed, 0.0, limits.deceleration, limits.jerk))
        case Accelerate():
            start = speed if command.start is None else command.start
            held = me.a if command.acceleration is None else command.acceleration
            return ConstantAcceleration(held, start)
        case AccelerationChange():
            return AccelerationRun(command, me, limits)
        case Careful():
            course = command.course
            inner = None if course is None else longitudinal_of(course, me, limits)
            return Cautious(command, inner, speed, limits, route)
        case KeepSchedule():
            return Schedule(command, me, limits)
        case ReplayTrajectory():
            return Hold(speed)
        case FollowSpeed():
            return _Following(command, limits)
        case KeepGap():
            return GapRun(command, limits)
        case Arrive():
            return ArrivalRun(command, limits)
    raise UnsupportedError(f"{type(command).__name__} is no longitudinal command")

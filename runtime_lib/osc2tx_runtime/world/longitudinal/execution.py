"""Execution of longitudinal commands: closed-form speed over time."""

from __future__ import annotations

from typing import Protocol

from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.opendrive import Route
from osc2tx_runtime.world.actor_dimensions import COMFORT, GENTLE, TYRES, Limits
from osc2tx_runtime.world.commands import (
    Accelerate,
    AccelerationChange,
    Arrive,
    Careful,
    Command,
    Cover,
    FollowSpeed,
    GapCourse,
    KeepGap,
    KeepSchedule,
    ReplayTrajectory,
    SpeedChange,
    Standstill,
)
from osc2tx_runtime.world.geometry.profiles import (
    COSINE_PEAK,
    Cosine,
    Linear,
    Profile,
    SCurve,
    cosine_duration,
)
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs
from osc2tx_shared.classes import replace

from .acceleration import AccelerationRun, ConstantAcceleration
from .arrival_schedule import Schedule, towards
from .collision_avoidance import Cautious, Hold
from .gap_control import ArrivalRun, GapRun
from .position_control import CoverRun, GapCourseRun

_SPEED_TOLERANCE = 0.05  # m/s at which a followed speed counts as reached


class Longitudinal(Protocol):
    """Execution of a command for one actor."""

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """Speed (m/s) at the next step; called once per step."""

    def progress(self) -> Progress:
        """Progress at the present step."""


class ProfileRun:
    """A speed change in closed form."""

    __slots__ = ("_profile", "_steps", "_time")

    def __init__(self, profile: Profile) -> None:
        self._profile = profile
        self._steps = 0
        self._time = 0.0

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """Value of the profile, at a time counted in steps."""
        self._steps += 1
        self._time = self._steps * inputs.dt
        return self._profile.value(self._time)

    def foreseen(self, steps: float, dt: float) -> float:
        """Speed (m/s) a number of steps after the last computed one."""
        return self._profile.value((self._steps + steps) * dt)

    def progress(self) -> Progress:
        """Done when the profile has ended."""
        return REACHED if self._time >= self._profile.duration - 1e-9 else PENDING

    @property
    def acceleration(self) -> float:
        """Acceleration (m/s^2) at the present step; zero once the speed is reached."""
        return 0.0 if self.progress().done else self._profile.rate(self._time)


class _CourseRun(ProfileRun):
    """A speed along a profile, within the limits."""

    __slots__ = ("_failed", "_limits")

    def __init__(self, course: Profile, limits: Limits | None) -> None:
        super().__init__(course)
        self._limits = limits
        self._failed: str | None = None

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """Value of the profile, or the nearest feasible one."""
        speed, limits = super().speed_after(me, inputs), self._limits
        if limits is None:
            return speed
        possible = towards(me.v, speed, limits, 1.0 + 1e-9, inputs.dt)
        if possible != speed and self._failed is None:
            rate = (speed - me.v) / inputs.dt
            self._failed = f"its shape requires {rate:.2f} m/s^2, which exceeds its limit"
        return possible

    def progress(self) -> Progress:
        """Done at the end of the course."""
        return super().progress() if self._failed is None else Progress(False, self._failed)


class _Following:
    """Feedback: the speed of another actor, approached within comfortable limits."""

    __slots__ = ("_command", "_done", "_limits", "_steps")

    def __init__(self, command: FollowSpeed, limits: Limits) -> None:
        self._command = command
        self._limits = limits
        self._steps = 0
        self._done = False

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """A step towards the speed of the reference at the present step."""
        command, course = self._command, self._command.course
        self._steps += 1
        other = inputs.state(command.reference)
        if course is not None:
            time = self._steps * inputs.dt
            its_speed = other.v + other.a * inputs.dt  # extrapolated
            wanted = its_speed * command.factor + course.value(time)
            speed = towards(me.v, wanted, self._limits, 1.0, inputs.dt)
            over = time >= course.duration - 1e-9
            self._done = over and abs(speed - wanted) < _SPEED_TOLERANCE
            return speed
        least = other.v * command.factor + command.difference
        wanted = min(max(me.v, least), least + command.spread)
        if command.due is not None:
            gained = me.v + other.a * command.factor * inputs.dt
            left = max(command.due - (self._steps - 1) * inputs.dt, inputs.dt)
            limits = self._limits
            most = limits.acceleration if wanted > gained else limits.deceleration
            share = min(max(COMFORT, abs(wanted - gained) / (left * most)), 1.0)
            nearer = towards(gained, wanted, limits, share, inputs.dt)
            speed = towards(me.v, nearer, self._limits, 1.0, inputs.dt)
        else:
            speed = towards(me.v, wanted, self._limits, COMFORT, inputs.dt)
        self._done = abs(speed - wanted) < _SPEED_TOLERANCE
        return speed

    def progress(self) -> Progress:
        """Done while the speeds agree."""
        return REACHED if self._done else PENDING


def speed_profile(
    command: SpeedChange, speed: float, limits: Limits, acceleration: float = 0.0
) -> Profile:
    """Closed form of a speed change that starts at `speed` (m/s) and `acceleration` (m/s^2).

    `none` and `constant` use comfortable limits if the command states no rate, `asap` the full
    ones. Higher speeds use the limit of acceleration, lower ones that of deceleration; a change of
    direction uses the smaller of both. With a jerk limit, the present acceleration is the start
    value.
    """
    target, peak, duration = command.target, command.rate_peak, command.duration
    if command.course is not None:
        return command.course
    change = abs(target - speed)
    if change == 0.0:
        return Linear(speed, target, 0.0)
    limit = _limit(speed, target, limits)
    rate = COMFORT * limit if peak is None else peak
    match command.profile:
        case "asap":
            most = limit if peak is None else peak
            return SCurve(speed, target, most, limits.jerk, acceleration)
        case "constant":
            return Linear(speed, target, change / rate if duration is None else duration)
        case "smooth":
            usual = cosine_duration(change, GENTLE * rate if peak is None else rate)
            return Cosine(speed, target, usual if duration is None else duration)
        case _:
            if duration is not None:
                return Cosine(speed, target, duration)
            return SCurve(speed, target, rate, limits.jerk, acceleration)


def _limit(speed: float, target: float, limits: Limits) -> float:
    if speed * target < 0.0:
        return min(limits.acceleration, limits.deceleration)
    return limits.acceleration if abs(target) > abs(speed) else limits.deceleration


def excessive_rate(command: SpeedChange, speed: float, limits: Limits = TYRES) -> str | None:
    """Why a speed change is infeasible; None if it is feasible.

    Args:
        command: The change.
        speed: Speed at its start (m/s).
        limits: The applicable limits: of the actor, or of tyres only.
    """
    cap = _limit(speed, command.target, limits)
    most = f"{cap:.4g} m/s^2{limits.road}"
    if command.course is not None:
        return None  # it is checked as a whole
    if command.rate_peak is not None and not 0.0 < command.rate_peak <= cap:
        return f"rate_peak {command.rate_peak:g} m/s^2 is not between 0 and {most}"
    if command.duration is not None and command.profile != "asap":
        factor = 1.0 if command.profile == "constant" else COSINE_PEAK
        change = factor * abs(command.target - speed)
        if change > cap * command.duration * (1.0 + 1e-9):
            return (
                f"a change from {speed:.1f} to {command.target:.1f} m/s in {command.duration:g} s"
                f" requires more than {most}"
            )
    return None


def within_limits(command: SpeedChange, speed: float, limits: Limits) -> SpeedChange:
    """Return a feasible speed change, if there is one; else the change itself.

    Without a stated profile (§8.8.2.12) it is smooth, or has a constant acceleration if only that
    reaches the speed in time.
    """
    if command.profile != "none" or excessive_rate(command, speed, limits) is None:
        return command
    even = replace(command, profile="constant")
    return command if excessive_rate(even, speed, limits) else even


def excessive_acceleration(value: float, speed: float, limits: Limits = TYRES) -> str | None:
    """Why an acceleration (m/s^2) is infeasible; None if it is feasible. Arguments as above."""
    cap = limits.acceleration if value * speed >= 0.0 else limits.deceleration
    if abs(value) <= cap * (1.0 + 1e-9):
        return None
    return f"an acceleration of {value:.2f} m/s^2 exceeds its limit of {cap:.4g} m/s^2{limits.road}"


def acceleration_of(run: Longitudinal | None, me: ActorState) -> float:
    """Acceleration (m/s^2) of this instant: that of a closed form, else the mean of the last step.

    A mean would make the result depend on the step size.
    """
    return run.acceleration if isinstance(run, ProfileRun | AccelerationRun) else me.a


def longitudinal_of(
    command: Command, me: ActorState, limits: Limits, route: Route | None = None
) -> Longitudinal:
    """Returns the execution of a longitudinal command from the present state of an actor.

    The acceleration of this state is the one at this very instant, see `acceleration_of`.
    """
    speed = me.v
    match command:
        case SpeedChange(course=given) if given is not None:
            return _CourseRun(given, None if command.exact else TYRES)
        case SpeedChange():
            if command.start is not None:
                return ProfileRun(speed_profile(command, command.start, limits))
            return ProfileRun(speed_profile(command, speed, limits, me.a))
        case Standstill():
            return ProfileRun(SCurve(speed, 0.0, limits.deceleration, limits.jerk, me.a))
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
        case GapCourse():
            return GapCourseRun(command, limits)
        case Cover():
            return CoverRun(command, limits)
        case Arrive():
            return ArrivalRun(command, limits)
    raise UnsupportedError(f"{type(command).__name__} is not a longitudinal command")

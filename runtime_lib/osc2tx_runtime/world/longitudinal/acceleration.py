"""Acceleration commands: closed-form speed over time."""

from __future__ import annotations

from osc2tx_runtime.world.actor_dimensions import COMFORT, Limits
from osc2tx_runtime.world.commands import AccelerationChange
from osc2tx_runtime.world.geometry.profiles import QUINTIC_PEAK, Linear, Profile, Quintic
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs


class ConstantAcceleration:
    """Constant acceleration from the speed at the start; ends at standstill."""

    __slots__ = ("_acceleration", "_start", "_steps")

    def __init__(self, acceleration: float, start: float) -> None:
        self._acceleration = acceleration
        self._start = start
        self._steps = 0

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """Start speed plus acceleration times time."""
        self._steps += 1
        return self.foreseen(0.0, inputs.dt)

    def foreseen(self, steps: float, dt: float) -> float:
        """Speed (m/s) a number of steps after the last computed one."""
        speed = self._start + self._acceleration * (self._steps + steps) * dt
        return 0.0 if self._start >= 0.0 > speed or self._start < 0.0 < speed else speed

    @property
    def is_even(self) -> bool:
        """Whether the speed stays as it is."""
        return self._acceleration == 0.0

    def progress(self) -> Progress:
        """Never done: there is no goal."""
        return PENDING


def acceleration_profile(
    command: AccelerationChange, start: float, limits: Limits
) -> Linear | Quintic:
    """Closed form of a change of the acceleration (m/s^2) from `start`.

    `none` uses a comfortable jerk, `asap` the limit; both keep it constant.
    """
    change, peak = abs(command.target - start), command.rate_peak
    if change == 0.0:
        return Linear(start, command.target, 0.0)
    if command.profile == "asap":
        return Linear(start, command.target, change / (peak or limits.jerk))
    jerk = peak or COMFORT * limits.jerk
    if command.profile == "smooth":
        return Quintic(start, command.target, command.duration or QUINTIC_PEAK * change / jerk)
    return Linear(start, command.target, command.duration or change / jerk)


class AccelerationRun:
    """A change of the acceleration, which is then held; the speed is its integral."""

    def __init__(self, command: AccelerationChange, me: ActorState, limits: Limits) -> None:
        start = me.a if command.start is None else command.start
        self._profile: Profile = command.course or acceleration_profile(command, start, limits)
        self._gained = 0.0  # m/s, of a course
        self._start_speed = me.v
        self._time = 0.0
        self._steps = 0
        self._standing = False

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """Start speed plus the integral of the acceleration; zero after standstill."""
        self._steps += 1
        before, self._time = self._time, self._steps * inputs.dt
        if isinstance(self._profile, Linear | Quintic):
            self._gained = integral(self._profile, self._time)
        else:
            self._gained += simpson(self._profile, before, self._time)
        speed = self._start_speed + self._gained
        stops = self._start_speed > 0.0 > speed or self._start_speed < 0.0 < speed
        self._standing = self._standing or stops
        return 0.0 if self._standing else speed

    def foreseen(self, steps: float, dt: float) -> float:
        """Speed (m/s) a number of steps after the last computed one."""
        time = (self._steps + steps) * dt
        if isinstance(self._profile, Linear | Quintic):
            speed = self._start_speed + integral(self._profile, time)
        else:
            speed = self._start_speed + self._gained + simpson(self._profile, self._time, time)
        stops = self._start_speed > 0.0 > speed or self._start_speed < 0.0 < speed
        return 0.0 if self._standing or stops else speed

    def progress(self) -> Progress:
        """Done when the acceleration is reached; failed if the actor reaches standstill before."""
        if self._time >= self._profile.duration - 1e-9:
            return REACHED
        if self._standing:
            end = self._profile.value(self._profile.duration)
            return Progress(
                False, f"it comes to a standstill before its acceleration is {end:g} m/s^2"
            )
        return PENDING

    @property
    def acceleration(self) -> float:
        """Acceleration (m/s^2) at the present step."""
        return 0.0 if self._standing else self._profile.value(self._time)


def simpson(profile: Profile, low: float, high: float) -> float:
    """Integral of a profile over a step; exact up to the third power of the time."""
    middle = profile.value(0.5 * (low + high))
    return (high - low) * (profile.value(low) + 4.0 * middle + profile.value(high)) / 6.0


def integral(profile: Linear | Quintic, t: float) -> float:
    """Integral of a profile from 0 to t; beyond its duration with its end value."""
    start, change, whole = profile.start, profile.end - profile.start, profile.duration
    if t >= whole:
        mean = start + 0.5 * change  # of both kinds: they are symmetrical
        return mean * whole + profile.end * (t - whole)
    tau = t / whole
    if isinstance(profile, Linear):
        return start * t + 0.5 * change * tau * t
    return start * t + change * whole * tau**4 * (2.5 + tau * (tau - 3.0))

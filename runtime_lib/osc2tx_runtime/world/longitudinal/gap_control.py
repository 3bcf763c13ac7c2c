"""Gap and arrival control: longitudinal commands relative to a position or an actor."""

from __future__ import annotations

import math

from osc2tx_runtime.clock import whole_steps
from osc2tx_runtime.world.actor_dimensions import COMFORT, Limits
from osc2tx_runtime.world.commands import Arrive, FollowSpeed, KeepGap
from osc2tx_runtime.world.geometry.guidance import (
    mean_rate_to_place,
    rate_to_place,
    rate_to_place_and_speed,
)
from osc2tx_runtime.world.measuring.deviation import PLACE_TOLERANCE
from osc2tx_runtime.world.measuring.distances import gap_between, headway_between
from osc2tx_runtime.world.measuring.projected_motion import Tracked
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import Outlook, StepInputs

from .arrival_schedule import towards

_SPEED_TOLERANCE = 0.2  # m/s between the speeds at which a gap can count as reached
_GAP_TOLERANCE = 0.1  # m at which a gap counts as reached
_HELD = 0.2  # s for which it must stay so
_UNCORRECTED = 1.0  # s before the end
_STIFFNESS = 0.4  # of the spring that closes a gap, in units of the limit that counts at the end


class GapRun:
    """Feedback on a distance to another actor.

    A small error decays like that of a critically damped spring, as in players of OpenSCENARIO XML;
    for a large error the closing speed grows with its square root, so that the actor can always
    brake in time. Within a range it keeps its speed unless that leads to a bound. It does not
    reverse.
    """

    __slots__ = ("_command", "_failed", "_held", "_least_time", "_limits", "_other")

    def __init__(self, command: KeepGap, limits: Limits) -> None:
        self._command = command
        self._least_time = float(
            command.time or 0.0
        )  # it may be a measured number, with a tolerance
        self._limits = limits
        self._other = Tracked(command.reference, command.projected)
        self._held = 0.0  # s for which the gap has been held
        self._failed: str | None = None

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """A step towards the speed that closes the error."""
        other = self._other.state(inputs)
        found = allowed_gap(self._command, me, other, me.v, inputs)
        if found is None:
            self._failed = _no_way(self._command)
            return me.v
        here, low, high = found
        if self._command.time is None:
            wanted = self._at_distance(me, other, found, inputs.dt)
        elif self._command.ahead:
            wanted = self._ahead_in_time(me, other, here, inputs.dt)
        else:
            wanted = self._behind_in_time(me, other, -here, inputs.dt)
        speed = towards(me.v, max(wanted, 0.0), self._limits, 1.0, inputs.dt)
        error = min(max(here, low), high) - here
        close = low < high or abs(me.v - other.v) < _SPEED_TOLERANCE
        near = abs(error) < _GAP_TOLERANCE and close
        self._held = self._held + inputs.dt if near else 0.0
        return speed

    def _at_distance(
        self, me: ActorState, other: ActorState, found: tuple[float, float, float], dt: float
    ) -> float:
        """The speed towards a distance.

        The acceleration of the reference is fed forward, so a reached distance is kept while the
        speed of the reference changes.
        """
        here, *edges = found
        drift = 0.5 * (other.v - me.v) * dt  # in the middle of the step
        its_speed = other.v + other.a * dt  # extrapolated
        least, most = (max(its_speed + self._closing(edge - here, drift), 0.0) for edge in edges)
        goal = min(max(me.v, least), most)
        blend = 1.0 - math.exp(-2.0 * self._pace(edges[1] - here) * dt)
        return me.v + other.a * dt + blend * (goal - me.v - other.a * dt)

    def _ahead_in_time(self, me: ActorState, other: ActorState, here: float, dt: float) -> float:
        """The speed ahead of a reference, whose speed and a time determine the distance."""
        its_speed = other.v + other.a * dt
        least, most = (
            its_speed + time * other.a + self._closing(time * max(other.v, 0.0) - here)
            for time in self._times()
        )
        return min(max(me.v, least), most)

    def _behind_in_time(self, me: ActorState, other: ActorState, gap: float, dt: float) -> float:
        """The speed behind a reference, which with a time determines the distance.

        After the step the distance is the time multiplied by that speed, plus the remaining error.
        """
        next_gap = gap + (other.v + 0.5 * other.a * dt) * dt - 0.5 * me.v * dt  # at standstill
        bounds = []
        for time in self._times():
            error = time * me.v - gap  # > 0: too near
            left = error + self._closing(-error) * dt
            bounds.append((next_gap + left) / (time + 0.5 * dt))
        return min(max(me.v, min(bounds)), max(bounds))

    def _times(self) -> tuple[float, float]:
        """Least and greatest time (s) allowed."""
        return self._least_time, self._least_time + self._command.spread

    def _closing(self, error: float, drift: float = 0.0) -> float:
        """Rate (m/s) at which to close an error (m) with a drift."""
        soon = abs(error + drift)
        last = self._last(error)
        closing = min(0.5 * self._pace(error) * soon, math.sqrt(2.0 * COMFORT * last * soon))
        return math.copysign(closing, error)

    def _pace(self, error: float) -> float:
        """Rate of the spring (1/s)."""
        return math.sqrt(_STIFFNESS * self._last(error))

    def _last(self, error: float) -> float:
        """The limit (m/s^2) at the end of closing an error."""
        return self._limits.acceleration if error < 0.0 else self._limits.deceleration

    def progress(self) -> Progress:
        """Done when the gap has been held for some time."""
        return Progress(self._held >= _HELD - 1e-9, self._failed)


class ArrivalRun:
    """Reaches a target at the end of a duration.

    In each step it uses the acceleration of `guidance` for a goal that moves as its command
    determines, or else at its speed. Corrections grow as the remaining time decreases, so a
    deviation of a driven actor in the last second is not corrected but judged at the end.
    """

    def __init__(self, command: Arrive, limits: Limits) -> None:
        self._command = command
        self._limits = limits
        gap = command.gap
        self._other = None if gap is None else Tracked(gap.reference, gap.projected)
        self._steps: int | None = None  # remaining
        self._last_steps = 0
        self._covered = 0.0
        self._left_off = 0.0  # m that it is ahead of the guidance
        self._near = _GAP_TOLERANCE
        self._progress = PENDING

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """One step towards the target; afterwards the same speed."""
        dt = inputs.dt
        if self._steps is None:
            self._steps = max(whole_steps(self._command.duration, dt), 1)
            self._last_steps = whole_steps(_UNCORRECTED, dt)
        if self._steps == 0:
            return me.v
        end = self._end_speed(inputs)
        found = self._rest(me, inputs, self._steps * dt, end)
        if found is None:
            assert self._command.gap is not None
            self._progress = Progress(False, _no_way(self._command.gap))
            return me.v
        rest, moving = found
        rate = self._rate(me.v, rest + self._left_off, moving, end, dt)
        speed = towards(me.v, me.v + rate * dt, self._limits, 1.0, dt)
        if me.v >= 0.0 > speed:
            speed = 0.0
        step = 0.5 * (me.v + speed) * dt
        self._covered += step
        self._steps -= 1
        if self._steps == 0:
            self._judge(rest + moving * dt - step, speed, end)
        return speed

    def slid(self, along: float) -> None:
        """Counts the measured surplus (m) of a step."""
        self._near = PLACE_TOLERANCE
        self._covered += along
        if self._steps is not None and self._steps <= self._last_steps:
            self._left_off += along

    def _end_speed(self, inputs: StepInputs) -> float | None:
        wanted = self._command.speed
        if isinstance(wanted, FollowSpeed):
            speed = self._outlook(wanted.reference, inputs).speed
            return speed * wanted.factor + wanted.difference
        return wanted

    def _rest(
        self, me: ActorState, inputs: StepInputs, time: float, end: float | None
    ) -> tuple[float, float] | None:
        """Metres to the goal, and the mean speed of the goal (m/s) until then."""
        gap = self._command.gap
        if gap is None or self._other is None:
            return (self._command.way or 0.0) - self._covered, 0.0
        other = self._other.state(inputs)
        mean = other.v
        if not gap.projected:
            mean, speed = self._outlook(gap.reference, inputs)
            other = other._replace(v=speed)
        found = allowed_gap(gap, me, other, me.v if end is None else end, inputs)
        if found is None:
            return None
        here, low, high = found
        steady = here + (me.v - mean) * time
        return min(max(steady, low), high) - here, mean

    def _outlook(self, actor: str, inputs: StepInputs) -> Outlook:
        """The expected motion of another actor: as its command determines, or at its speed."""
        found = inputs.outlook(actor, self._steps or 1)
        if found is None:
            speed = inputs.state(actor).v
            return Outlook(speed, speed)
        return found

    def _rate(self, v: float, rest: float, moving: float, end: float | None, dt: float) -> float:
        n = self._steps or 1
        missing = rest - (v - moving) * n * dt
        if end is not None:
            return rate_to_place_and_speed(n, dt, missing, end - v)
        if v > 0.0 > v + mean_rate_to_place(n, dt, missing) * n * dt:
            gain = rest + moving * n * dt  # it has to stop there before the end of its duration
            return -v * v / (2.0 * gain) if gain > 0.0 else -self._limits.deceleration
        return rate_to_place(n, dt, missing)

    def _judge(self, missed: float, speed: float, end: float | None) -> None:
        can = self._limits.text
        if abs(missed) > self._near:
            side = "short of" if missed > 0.0 else "beyond"
            reason = (
                f"at the end of its duration it is {abs(missed):.1f} m {side} its target position;"
                f" {can}"
            )
            self._progress = Progress(False, reason)
        elif end is not None and abs(speed - end) > _SPEED_TOLERANCE:
            reason = f"it reaches its target position at {speed:.1f} m/s, not {end:.1f} m/s; {can}"
            self._progress = Progress(False, reason)
        else:
            self._progress = REACHED

    def progress(self) -> Progress:
        """Done or failed at the end of the duration."""
        return self._progress


def allowed_gap(
    command: KeepGap, me: ActorState, other: ActorState, own_speed: float, inputs: StepInputs
) -> tuple[float, float, float] | None:
    """The distance (m) of the actor ahead of the reference, and its allowed range."""
    along = inputs.along(other, me)
    if along is None:
        return None
    match command.measure:
        case "gap":
            here = gap_between(along, me.shape, other.shape)
        case "headway":
            here = headway_between(along, me.shape, other.shape)
        case "reference":
            here = along
    low, high = command.distance or 0.0, (command.distance or 0.0) + command.spread
    if command.time is not None:
        trailing = max(other.v if command.ahead else own_speed, 0.0)
        low, high = command.time * trailing, (command.time + command.spread) * trailing
    return (here, low, high) if command.ahead else (here, -high, -low)


def _no_way(command: KeepGap) -> str:
    return f"there is no route along lanes to {command.reference}"

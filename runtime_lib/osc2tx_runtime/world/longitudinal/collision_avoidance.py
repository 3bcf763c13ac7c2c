"""Collision avoidance (intelligent driver model), slowing down for bends, stopping at red lights.

For vehicles ahead: the interaction term of the intelligent driver model. The acceleration is at
most a (1 - (g*/g)^2) with the desired gap g* = g0 + v T + v dv / (2 sqrt(a b)), a and b being
comfortable values of the actor. For bends see `bends_ahead`, for lights `red_lights`. On a free and
straight road the inner command is unchanged, so its closed forms remain exact. Deterministic; reads
the snapshot only.
"""

from __future__ import annotations

import math
from typing import Protocol

from osc2tx_runtime.opendrive import Route
from osc2tx_runtime.world.actor_dimensions import COMFORT, Limits
from osc2tx_runtime.world.commands import Careful
from osc2tx_runtime.world.protocol import REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs
from osc2tx_runtime.world.surroundings.stop_lines_ahead import StopLine

_FROM_LINE = 1.0  # m between a stop line and the front of an actor waiting at it


class RedLights:
    """The traffic lights on the route of one actor.

    Args:
        limits: Of the actor.
        route: Its route at forks.
    """

    def __init__(self, limits: Limits, route: Route | None) -> None:
        self._limits = limits
        self._route = route
        self._passing: str | None = None  # a light at which it can no longer stop

    def allowed(self, me: ActorState, wanted: float, inputs: StepInputs) -> float:
        """Speed (m/s) at the next step, at most `wanted`, that allows a required stop."""
        most = min(self._limits.deceleration, inputs.grip(me))
        comfort = min(COMFORT * self._limits.deceleration, most)
        line = self._line(me, wanted, (comfort, most), inputs)
        if line is None:
            return wanted
        way = line.distance - me.shape.front - _FROM_LINE
        left = way - 0.5 * (me.v + wanted) * inputs.dt
        if wanted * wanted <= 2.0 * comfort * max(left, 0.0):
            return wanted  # braking can wait
        brake = min(0.5 * me.v * me.v / way, most) if way > 0.0 else most
        return min(wanted, max(me.v - brake * inputs.dt, 0.0))

    def _line(
        self, me: ActorState, wanted: float, brakes: tuple[float, float], inputs: StepInputs
    ) -> StopLine | None:
        """The stop line; None without a near one, or if it is too late to stop."""
        comfort, most = brakes
        fast = max(me.v, wanted)
        reach = me.shape.front + _FROM_LINE + 0.5 * fast * fast / comfort + fast * inputs.dt
        line = inputs.stop_line(me, self._route, reach)
        if line is None:
            self._passing = None
        elif line.signal != self._passing:
            way = line.distance - me.shape.front
            if line.strict:
                can = me.v * me.v <= 2.0 * most * way
            else:
                can = me.v * me.v <= 2.0 * comfort * max(way - _FROM_LINE, 0.0) + 1e-9
            if can or me.v == 0.0:
                return line
            self._passing = line.signal
        return None


_LEAST_GAP = 0.1  # m: smaller gaps count as this one


class _Inner(Protocol):
    def speed_after(self, me: ActorState, inputs: StepInputs) -> float: ...
    def progress(self) -> Progress: ...


class Hold:
    """Holds the speed at the start."""

    def __init__(self, speed: float) -> None:
        self._speed = speed

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """Always the same."""
        return self._speed

    def progress(self) -> Progress:
        """Always reached."""
        return REACHED


class Cautious:
    """Another command, slowed down behind other actors, in bends and at red lights.

    Meanwhile the time of the inner command continues; afterwards the actor accelerates comfortably
    to its speed.

    Args:
        command: The command with headway and gap.
        inner: The other command; None holds the speed.
        speed: Present speed (m/s).
        limits: Of the actor.
        route: Its route at forks.
    """

    def __init__(
        self,
        command: Careful,
        inner: _Inner | None,
        speed: float,
        limits: Limits,
        route: Route | None = None,
    ) -> None:
        self._inner = inner or Hold(speed)
        self._headway, self._gap = command.headway, command.gap
        self._limits = limits
        self._lights, self._route = RedLights(limits, route), route
        self._held = False

    def speed_after(self, me: ActorState, inputs: StepInputs) -> float:
        """The inner speed, limited by other actors, bends and lights."""
        speed = wanted = self._inner.speed_after(me, inputs)
        found = inputs.obstacle(me)
        if found is not None or self._held:
            rise = COMFORT * self._limits.acceleration
            if found is not None:
                rise = max(self._acceleration(me.v, found), -self._limits.deceleration)
            speed = min(wanted, max(me.v + rise * inputs.dt, 0.0))
        hardest = max(me.v - self._limits.deceleration * inputs.dt, 0.0)
        if me.shape.wheelbase:
            speed = min(speed, max(inputs.bend(me, self._route, self._limits), hardest))
        speed = self._lights.allowed(me, speed, inputs)
        self._held = speed < wanted
        return speed

    def slid(self, along: float) -> None:
        """Passes on the measured surplus (m) of a step."""
        slid = getattr(self._inner, "slid", None)
        if slid is not None:
            slid(along)

    def _acceleration(self, speed: float, found: tuple[float, float]) -> float:
        gap, other = found
        a = COMFORT * self._limits.acceleration
        b = COMFORT * self._limits.deceleration
        closing = speed * (speed - other) / (2.0 * math.sqrt(a * b))
        wanted = self._gap + max(speed * self._headway + closing, 0.0)
        return a * (1.0 - (wanted / max(gap, _LEAST_GAP)) ** 2)

    def progress(self) -> Progress:
        """Progress of the inner command; not reached while it is slowed down."""
        progress = self._inner.progress()
        return Progress(progress.done and not self._held, progress.failed)

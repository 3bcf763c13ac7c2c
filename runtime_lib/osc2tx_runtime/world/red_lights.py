"""Braking for red lights: constant deceleration to the stop line.

It begins at the moment at which it is comfortable. Who sees a light too late for that brakes
harder; who can no longer stop before the line at all drives on, and at a light that is only about
to turn red so does everybody who could not stop comfortably.
"""

from __future__ import annotations

from osc2tx_runtime.opendrive import Route

from .actor_dimensions import COMFORT, Limits
from .state import ActorState
from .step_inputs import StepInputs
from .stop_lines_ahead import StopLine

__all__ = ["RedLights"]

_FROM_LINE = 1.0  # m between a stop line and the front of who stands at it


class RedLights:
    """The lights on the way of one actor.

    Args:
        limits: Of the actor.
        route: Its way at forks.
    """

    def __init__(self, limits: Limits, route: Route | None) -> None:
        self._limits = limits
        self._route = route
        self._passing: str | None = None  # a light that it cannot stop at any more

    def allowed(self, me: ActorState, wanted: float, inputs: StepInputs) -> float:
        """Speed (m/s) at the next step, at most `wanted`, with which it stops where it has to."""
        most = min(self._limits.deceleration, inputs.grip(me))
        comfort = min(COMFORT * self._limits.deceleration, most)
        line = self._line(me, wanted, (comfort, most), inputs)
        if line is None:
            return wanted
        way = line.distance - me.shape.front - _FROM_LINE
        left = way - 0.5 * (me.v + wanted) * inputs.dt
        if wanted * wanted <= 2.0 * comfort * max(left, 0.0):
            return wanted  # there is time
        brake = min(0.5 * me.v * me.v / way, most) if way > 0.0 else most
        return min(wanted, max(me.v - brake * inputs.dt, 0.0))

    def _line(
        self, me: ActorState, wanted: float, brakes: tuple[float, float], inputs: StepInputs
    ) -> StopLine | None:
        """The line to stop at; None if there is none near, or it is too late for it."""
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

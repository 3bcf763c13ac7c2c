"""The speed of a vehicle without a stated speed: held, but lower in bends.

A speed that a scenario states holds in bends too; excess over the grip limit is reported. Without
one the speed is that of a driver, who takes bends comfortably (`bends_ahead`) and gains the speed
again behind them. On a straight road the speed is held to the last bit.
"""

from __future__ import annotations

from osc2tx_runtime.opendrive import Route
from osc2tx_runtime.world.actor_dimensions import COMFORT, Limits
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs


class OpenSpeed:
    """A driver without a command for the speed."""

    __slots__ = ("_held",)

    def __init__(self) -> None:
        self._held = 0.0  # m/s to gain again behind a bend; no more than the present speed: none

    def forget(self) -> None:
        """A speed was stated."""
        self._held = 0.0

    def speed_after(
        self, me: ActorState, inputs: StepInputs, route: Route | None, limits: Limits
    ) -> float:
        """Speed (m/s) at the next step.

        Args:
            me: The actor.
            inputs: The snapshot.
            route: Its route at forks.
            limits: Of the vehicle on the road as it is.
        """
        held = max(self._held, me.v)
        fastest = inputs.bend(me, route, limits)
        if me.v >= held and fastest >= held:
            return me.v
        self._held = held
        slowest = me.v - COMFORT * limits.deceleration * inputs.dt
        rising = me.v + COMFORT * limits.acceleration * inputs.dt
        return max(min(held, fastest, rising), slowest, 0.0)

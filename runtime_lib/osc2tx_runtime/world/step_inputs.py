"""Inputs of commands in a step: states, map, lights, limits."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from osc2tx_runtime.opendrive import Route
from osc2tx_runtime.world.surroundings.stop_lines_ahead import StopLine

from .actor_dimensions import Limits
from .state import ActorState


class Outlook(NamedTuple):
    """Expected motion of an actor over a time.

    Attributes:
        mean: Its mean speed over the time (m/s).
        speed: Its speed at the end (m/s).
    """

    mean: float
    speed: float


class StepInputs(Protocol):
    """The snapshot of the present step.

    Attributes:
        dt: Length of the step (s).
    """

    dt: float

    def state(self, actor: str) -> ActorState:
        """State of an actor."""

    def projected(self, state: ActorState, seconds: float) -> ActorState:
        """The position of an actor after a time if it continued in its lane at its speed."""

    def outlook(self, actor: str, steps: int) -> Outlook | None:
        """The expected motion of an actor over a number of steps.

        None if its command does not determine it.
        """

    def along(self, a: ActorState, b: ActorState) -> float | None:
        """Route distance (m) from a to b; None if not connected."""

    def aside(self, a: ActorState, b: ActorState) -> float | None:
        """Lateral distance (m) of b to the left of a, in the lane of a; None if not connected."""

    def obstacle(self, me: ActorState) -> tuple[float, float] | None:
        """Gap (m) to the nearest actor ahead on the path, and its speed (m/s) along it."""

    def stop_line(self, me: ActorState, route: Route | None, reach: float) -> StopLine | None:
        """First line within a distance (m) at which a light requires a stop; None without one."""

    def bend(self, me: ActorState, route: Route | None, limits: Limits) -> float:
        """Speed (m/s) at the next step at which a driver approaches the bends ahead."""

    def grip(self, me: ActorState) -> float:
        """Largest acceleration (m/s^2) that the road can transmit to wheels in any direction."""

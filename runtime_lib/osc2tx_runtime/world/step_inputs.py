"""Inputs of commands in a step: states, map, lights, limits."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from osc2tx_runtime.opendrive import Route
from osc2tx_runtime.world.surroundings.stop_lines_ahead import StopLine

from .actor_dimensions import Limits
from .state import ActorState


class Outlook(NamedTuple):
    """How an actor will go on for a time.

    Attributes:
        mean: Its mean speed until then (m/s).
        speed: Its speed then (m/s).
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
        """How an actor will go on for so many steps; None if its command does not tell."""

    def along(self, a: ActorState, b: ActorState) -> float | None:
        """Route distance (m) from a to b; None if not connected."""

    def aside(self, a: ActorState, b: ActorState) -> float | None:
        """How far (m) b is left of a, across the lane of a; None if not connected."""

    def obstacle(self, me: ActorState) -> tuple[float, float] | None:
        """Free metres to the nearest actor ahead in the way, and its speed (m/s) along it."""

    def stop_line(self, me: ActorState, route: Route | None, reach: float) -> StopLine | None:
        """First line within a distance (m) at which a light requires a stop; None without one."""

    def bend(self, me: ActorState, route: Route | None, limits: Limits) -> float:
        """Speed (m/s) at the next step at which a driver approaches the bends ahead."""

    def grip(self, me: ActorState) -> float:
        """Largest acceleration (m/s^2) that the road can transmit to wheels in any direction."""

"""What commands at work may read of the present step."""

from __future__ import annotations

from typing import Protocol

from .state import ActorState

__all__ = ["Senses"]


class Senses(Protocol):
    """The snapshot of the present step.

    Attributes:
        dt: Length of the step (s).
    """

    dt: float

    def state(self, actor: str) -> ActorState:
        """State of an actor."""

    def along(self, a: ActorState, b: ActorState) -> float | None:
        """Route distance (m) from a to b; None if not connected."""

    def aside(self, a: ActorState, b: ActorState) -> float | None:
        """How far (m) b is left of a, across the lane of a; None if not connected."""

    def obstacle(self, me: ActorState) -> tuple[float, float] | None:
        """Free metres to the nearest actor ahead in the way, and its speed (m/s) along it."""

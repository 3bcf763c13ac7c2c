"""What actors tell of their motion and of what they tow (DSL 8.7.5, 8.7.13, 8.7.14)."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Hitch", "Motion", "Translation"]


@dataclass(frozen=True, slots=True)
class Translation:
    """A velocity (m/s) or acceleration (m/s^2) along the own x axis.

    Worlds only tell how fast actors move along their heading; y and z are not known.
    """

    x: float


@dataclass(frozen=True, slots=True)
class Motion:
    """A velocity or acceleration of an actor against the world, in its own axes."""

    translational: Translation


@dataclass(frozen=True, slots=True)
class Hitch:
    """One half of a hitch: the receiver of a vehicle that tows, or the coupler of a trailer.

    Attributes:
        connected: Whether the other half hangs on it now.
    """

    connected: bool

    @property
    def is_towing(self) -> bool:
        """Of a receiver: whether it tows."""
        return self.connected

    @property
    def is_towed(self) -> bool:
        """Of a coupler: whether it is towed."""
        return self.connected

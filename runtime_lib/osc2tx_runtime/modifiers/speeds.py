"""Modifiers of the speed (DSL 8.9.4 to 8.9.7)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.errors import ScenarioError

from .base import At, Modifier, Value, at_most_one, value_of

if TYPE_CHECKING:
    from osc2tx_runtime.actors import PhysicalObject
    from osc2tx_runtime.world.profiles import DynamicProfile

__all__ = ["Acceleration", "ChangeSpeed", "KeepSpeed", "Speed"]


@dataclass(frozen=True, slots=True)
class Speed(Modifier):
    """Speed, absolute or relative to another actor.

    Attributes:
        speed: Speed, or difference to the reference (m/s); subtracted for `slower_than`.
        faster_than: Reference.
        slower_than: Reference.
        same_as: Reference.
        direction: Of the speed; `lateral`: to the left across the lane.
        factor: Multiplies the speed of the reference.
        rate_profile: Course of the acceleration.
        rate_peak: Peak of the acceleration (m/s^2).
        at: When it holds.
    """

    name = "speed"
    speed: Value | None = None
    faster_than: PhysicalObject | None = None
    slower_than: PhysicalObject | None = None
    same_as: PhysicalObject | None = None
    direction: Literal["longitudinal", "lateral"] = "longitudinal"
    factor: float = 1.0
    rate_profile: DynamicProfile = "none"
    rate_peak: float | None = None
    at: At = "all"

    def __post_init__(self) -> None:
        at_most_one(
            "speed: faster_than, slower_than, same_as",
            self.faster_than,
            self.slower_than,
            self.same_as,
        )
        if self.speed is None and self.reference is None:
            raise ScenarioError("speed: give a speed or a reference")

    @property
    def reference(self) -> PhysicalObject | None:
        """The actor it is relative to."""
        return self.faster_than or self.slower_than or self.same_as

    def difference(self) -> float:
        """Signed value (m/s) now: the speed, or what is added to that of the reference."""
        value = 0.0 if self.speed is None else value_of(self.speed)
        return -value if self.slower_than is not None else value


@dataclass(frozen=True, slots=True)
class ChangeSpeed(Modifier):
    """Speed relative to that at the start of the action (m/s)."""

    name = "change_speed"
    speed: Value = 0.0
    at: At = "all"


@dataclass(frozen=True, slots=True)
class KeepSpeed(Modifier):
    """The speed at the start of the action."""

    name = "keep_speed"


@dataclass(frozen=True, slots=True)
class Acceleration(Modifier):
    """Rate of change of the speed.

    Attributes:
        acceleration: m/s^2; how fast a speed is reached if one is given as well.
        at: `all`: from the start on; `start`: then, and falling to zero afterwards; `end`: reached
            at the end of the action, or ends it.
    """

    name = "acceleration"
    acceleration: Value = 0.0
    at: At = "all"

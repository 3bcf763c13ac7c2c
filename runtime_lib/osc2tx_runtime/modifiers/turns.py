"""Modifiers of the orientation (DSL 8.9.9, 8.9.10)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.errors import ScenarioError

from .base import At, Modifier, Value, upright

if TYPE_CHECKING:
    from osc2tx_runtime.actors import PhysicalObject

YawMeasure = Literal[
    "length_to_length",
    "length_to_width",
    "width_to_length",
    "width_to_width",
    "relative_to_north",
    "relative_to_road",
]

__all__ = ["Orient", "Yaw"]


@dataclass(frozen=True, slots=True)
class Yaw(Modifier):
    """Heading (rad) against the road, or against another actor.

    Attributes:
        angle: Counter-clockwise.
        relative_to: Reference; None: the road.
        measure_by: What the angle is measured against: the road, north, or an axis of the own box
            against one of the reference.
        at: When it holds.
    """

    name = "yaw"
    angle: Value
    relative_to: PhysicalObject | None = None
    measure_by: YawMeasure = "relative_to_road"
    at: At = "all"

    def __post_init__(self) -> None:
        """Checks that there is what to measure against."""
        if "_to_" in self.measure_by.removeprefix("relative_to") and self.relative_to is None:
            raise ScenarioError(f"yaw: measure_by {self.measure_by} needs relative_to")


@dataclass(frozen=True, slots=True)
class Orient(Modifier):
    """Heading (rad) in the world, or against another actor.

    Attributes:
        yaw: Counter-clockwise.
        pitch: Only 0: actors stand upright on the road.
        roll: Only 0.
        relative_to: Reference; None: the world.
        measure_by: What the angles are measured against; default: the reference, else the world.
        at: When it holds.
    """

    name = "orientation"
    yaw: Value | None = None
    pitch: float | None = None
    roll: float | None = None
    relative_to: PhysicalObject | None = None
    measure_by: Literal["absolute", "relative_to_reference", "relative_to_road"] | None = None
    at: At = "all"

    def __post_init__(self) -> None:
        upright("orientation", self.pitch, self.roll)
        if self.yaw is None:
            raise ScenarioError("orientation: give a yaw")
        if self.measure_by == "relative_to_reference" and self.relative_to is None:
            raise ScenarioError("orientation: measure_by relative_to_reference needs relative_to")

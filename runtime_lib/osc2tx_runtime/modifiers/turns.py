"""Modifiers of the orientation (DSL 8.9.9, 8.9.10)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.argument_rules import at_least_one, at_most_one

from .base import MovementModifier, Value, band_of, upright

if TYPE_CHECKING:
    from osc2tx_runtime.actors import PhysicalObject
    from osc2tx_runtime.behaviour.parameters import Range

YawMeasure = Literal[
    "length_to_length",
    "length_to_width",
    "width_to_length",
    "width_to_width",
    "relative_to_north",
    "relative_to_road",
]

BETWEEN_AXES = ("length_to_length", "length_to_width", "width_to_length", "width_to_width")

__all__ = ["Orient", "Yaw"]


@dataclass(frozen=True, slots=True)
class Yaw(MovementModifier):
    """Heading (rad) against the road, or against another actor.

    Attributes:
        angle: Counter-clockwise.
        angle_range: Instead of it: what it may be at any time.
        relative_to: Reference; None: the road.
        measure_by: What the angle is measured against: the road, north, or an axis of the own box
            against one of the reference.
    """

    name = "yaw"
    rules = (
        at_most_one("angle", "angle_range"),
        at_least_one("angle", "angle_range"),
        at_least_one("relative_to", when=["measure_by"], values=BETWEEN_AXES),
    )
    angle: Value | None = None
    angle_range: Range[float] | Callable[[], Range[float]] | None = None
    relative_to: PhysicalObject | None = None
    measure_by: YawMeasure = "relative_to_road"

    def angles(self) -> tuple[float, float]:
        """Least and greatest angle (rad) now; both the same without a range."""
        return band_of(self.angle, self.angle_range)


@dataclass(frozen=True, slots=True)
class Orient(MovementModifier):
    """Heading (rad) in the world, or against another actor.

    Attributes:
        yaw: Counter-clockwise.
        pitch: Only 0: actors stand upright on the road.
        roll: Only 0.
        relative_to: Reference; None: the world.
        measure_by: What the angles are measured against; default: the reference, else the world.
    """

    name = "orientation"
    rules = (
        at_least_one("yaw"),
        at_least_one("relative_to", when=["measure_by"], values=["relative_to_reference"]),
    )
    yaw: Value | None = None
    pitch: float | None = None
    roll: float | None = None
    relative_to: PhysicalObject | None = None
    measure_by: Literal["absolute", "relative_to_reference", "relative_to_road"] | None = None

    def __post_init__(self) -> None:
        MovementModifier.__post_init__(self)
        upright("orientation", self.pitch, self.roll)

    def angles(self) -> tuple[float, float]:
        """The yaw (rad), twice: it has no range."""
        return band_of(self.yaw, None)

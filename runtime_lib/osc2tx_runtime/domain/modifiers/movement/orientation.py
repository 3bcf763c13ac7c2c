"""Modifiers of the orientation (DSL 8.9.9, 8.9.10)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers.base import MovementModifier, Value, value_of, wanted
from osc2tx_runtime.domain.modifiers.registry import modifier
from osc2tx_runtime.domain.shapes import AnyShape, OwnShape
from osc2tx_runtime.enums import OrientationMeasuredBy, YawMeasureBy
from osc2tx_runtime.language.actions.modifier import LANE, SIDE
from osc2tx_runtime.language.actions.registry import LATERAL
from osc2tx_shared.classes import dataclass
from osc2tx_shared.rules import at_least_one, at_most_one, none_of

if TYPE_CHECKING:
    from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject
    from osc2tx_runtime.language.values.parameters import Range


BETWEEN_AXES = ("length_to_length", "length_to_width", "width_to_length", "width_to_width")

__all__ = ["Orient", "Yaw"]


@modifier("yaw", slots=(LATERAL,), topics=(LANE, SIDE), placement=True)
@dataclass(frozen=True, slots=True)
class Yaw(MovementModifier):
    """Heading (rad) against the road, or against another actor.

    Attributes:
        angle: Counter-clockwise.
        angle_range: Instead of the value: its range at all times.
        relative_to: Reference; None: the road.
        measure_by: Zero of the angle: the road, north, or an axis of the own box
            against one of the reference.
        shape: Profile of the angle, and its value if none is given here: a shape of the scenario,
            since angles have no common shapes.
    """

    shaped_by = AnyShape
    rules = (
        at_most_one("angle", "angle_range"),
        at_least_one("angle", "angle_range", "shape"),
        at_least_one("relative_to", when=["measure_by"], values=BETWEEN_AXES),
    )
    angle: Value | None = None
    angle_range: Range[float] | Callable[[], Range[float]] | None = None
    relative_to: PhysicalObject | None = None
    measure_by: YawMeasureBy = "relative_to_road"
    shape: AnyShape | OwnShape[AnyShape] | None = None

    def angles(self) -> tuple[float, float]:
        """Least and greatest angle (rad) now; equal without a range."""
        return wanted(self.angle, self.angle_range, self.shape)


@modifier("orientation", slots=(LATERAL,), topics=(LANE, SIDE), placement=True)
@dataclass(frozen=True, slots=True)
class Orient(MovementModifier):
    """Attitude (rad) against the road, the world or another actor: the angles that are given.

    Each angle counts from the same angle of the reference. Pitch and roll of vehicles follow the
    road, unless physics need not hold.

    Attributes:
        yaw: Counter-clockwise.
        pitch: Nose down.
        roll: Right side down.
        relative_to: Reference; None: the road.
        measure_by: Zero of the angles; default: the reference, else the road (the
            standard names both road and world; its examples have the road).
        shape: Profile of the yaw, as of `yaw`.
    """

    shaped_by = AnyShape
    rules = (
        at_least_one("yaw", "pitch", "roll"),
        at_least_one("yaw", when=["shape"]),
        none_of("pitch", "roll", when=["shape"]),
        at_least_one("relative_to", when=["measure_by"], values=["relative_to_reference"]),
    )
    yaw: Value | None = None
    pitch: Value | None = None
    roll: Value | None = None
    relative_to: PhysicalObject | None = None
    measure_by: OrientationMeasuredBy | None = None
    shape: AnyShape | OwnShape[AnyShape] | None = None

    def angles(self) -> tuple[float, float] | None:
        """The yaw (rad) as least and greatest value; None without a yaw."""
        return None if self.yaw is None else wanted(self.yaw, None, self.shape)

    def tilt(self) -> tuple[float | None, float | None]:
        """Pitch and roll (rad) against the reference, now."""
        return (
            None if self.pitch is None else value_of(self.pitch),
            None if self.roll is None else value_of(self.roll),
        )

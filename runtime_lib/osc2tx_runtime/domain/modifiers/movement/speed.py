"""Modifiers of the speed (DSL 8.9.4 to 8.9.7)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers.base import (
    Modifier,
    MovementModifier,
    Value,
    course_of,
    value_of,
    wanted,
)
from osc2tx_runtime.domain.modifiers.registry import modifier
from osc2tx_runtime.domain.shapes import (
    AnyAccelerationShape,
    AnySpeedShape,
    CommonSpeedShape,
    OwnShape,
)
from osc2tx_runtime.enums import DynamicProfile, LonLat
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.actions.modifier import COURSE, LANE, SIDE
from osc2tx_runtime.language.actions.registry import LONGITUDINAL
from osc2tx_shared.classes import dataclass
from osc2tx_shared.rules import LATERAL_SPEED, Sort, at_least_one, at_most_one

if TYPE_CHECKING:
    from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject
    from osc2tx_runtime.language.values.parameters import Range

__all__ = ["Acceleration", "ChangeSpeed", "KeepSpeed", "Speed"]


@modifier(
    "speed",
    slots=(LONGITUDINAL,),
    excludes=(COURSE,),
    sorts=(
        Sort(LATERAL_SPEED, given=("direction",), value="lateral", excludes=(LANE, SIDE, "along")),
    ),
    placement=True,
    paces=True,
    orders=("faster_than", "slower_than"),
    amounts=("speed", "speed_range"),
)
@dataclass(frozen=True, slots=True)
class Speed(MovementModifier):
    """Speed, absolute or relative to another actor.

    Attributes:
        speed: Speed, or difference to the reference (m/s); subtracted for `slower_than`.
        speed_range: Instead of the value: its range at all times.
        faster_than: Reference.
        slower_than: Reference.
        same_as: Reference.
        direction: Of the speed; `lateral`: to the left across the lane.
        factor: Multiplies the speed of the reference.
        rate_profile: Course of the acceleration.
        rate_peak: Peak of the acceleration (m/s^2).
        shape: Profile of the speed or difference, and its value if none is given here.
    """

    shaped_by = AnySpeedShape
    rules = (
        at_most_one("speed", "speed_range"),
        at_most_one("faster_than", "slower_than", "same_as"),
        at_least_one("speed", "speed_range", "same_as", "shape"),
        at_most_one("shape", "rate_profile"),
        at_most_one("shape", "rate_peak"),
    )
    speed: Value | None = None
    speed_range: Range[float] | Callable[[], Range[float]] | None = None
    faster_than: PhysicalObject | None = None
    slower_than: PhysicalObject | None = None
    same_as: PhysicalObject | None = None
    direction: LonLat = "longitudinal"
    factor: Value = 1.0
    rate_profile: DynamicProfile = "none"
    rate_peak: Value | None = None
    shape: AnySpeedShape | OwnShape[AnySpeedShape] | None = None

    def __post_init__(self) -> None:
        MovementModifier.__post_init__(self)
        if any(v is not None for v in (self.speed, self.speed_range, self.reference)):
            return
        if isinstance(self.shape, CommonSpeedShape) and self.shape.target is None:
            raise ScenarioError("speed: the shape has no target, so give a speed or a reference")

    @property
    def reference(self) -> PhysicalObject | None:
        """The actor it is relative to."""
        return self.faster_than or self.slower_than or self.same_as

    @property
    def times(self) -> float:
        """The factor, now."""
        return value_of(self.factor)

    def _own_course(self) -> tuple[DynamicProfile, float | None] | None:
        given = self.rate_profile != "none" or self.rate_peak is not None
        peak = None if self.rate_peak is None else value_of(self.rate_peak)
        return (self.rate_profile, peak) if given else None

    @property
    def course(self) -> tuple[DynamicProfile, float | None]:
        """Profile and peak of the acceleration (m/s^2)."""
        return self._own_course() or course_of(self.shape)

    @property
    def shaped(self) -> bool:
        """Whether it states how the speed is reached."""
        return isinstance(self.shape, OwnShape) or self.course != ("none", None)

    def difference(self) -> tuple[float, float]:
        """Least and greatest speed, or difference to the reference, now (m/s)."""
        low, high = wanted(self.speed, self.speed_range, self.shape)
        return (-high, -low) if self.slower_than is not None else (low, high)


@modifier(
    "change_speed",
    slots=(LONGITUDINAL,),
    topics=(COURSE,),
    no_start="cannot change the speed at the start",
    paces=True,
)
@dataclass(frozen=True, slots=True)
class ChangeSpeed(MovementModifier):
    """Speed relative to that at the start of the action.

    Attributes:
        speed: Difference (m/s).
        speed_range: Instead of it: the range of the difference.
        shape: Profile of the difference, and its value if none is given here.
    """

    shaped_by = AnySpeedShape
    rules = (
        at_most_one("speed", "speed_range"),
        at_least_one("speed", "speed_range", "shape"),
    )
    speed: Value | None = None
    speed_range: Range[float] | Callable[[], Range[float]] | None = None
    shape: AnySpeedShape | OwnShape[AnySpeedShape] | None = None

    @property
    def course(self) -> tuple[DynamicProfile, float | None]:
        """Profile and peak of the acceleration (m/s^2)."""
        return course_of(self.shape)

    def difference(self) -> tuple[float, float]:
        """Least and greatest value (m/s) now."""
        return wanted(self.speed, self.speed_range, self.shape)


@modifier(
    "keep_speed",
    slots=(LONGITUDINAL,),
    excludes=(COURSE, "speed", "acceleration"),
    paces=True,
)
@dataclass(frozen=True, slots=True)
class KeepSpeed(Modifier):
    """The speed at the start of the action."""


@modifier("acceleration", slots=(LONGITUDINAL,), excludes=(COURSE,), paces=True)
@dataclass(frozen=True, slots=True)
class Acceleration(MovementModifier):
    """Rate of change of the speed.

    `at`: `all` from the start; `start` at the start, and decreasing to zero afterwards; `end`
    reached at the end of the action, or ends it.

    Attributes:
        acceleration: m/s^2; how fast a speed is reached if one is given as well.
        acceleration_range: Instead of the value: its range at all times.
        shape: Profile of its change, and a value if none is given here.
    """

    shaped_by = AnyAccelerationShape
    rules = (
        at_most_one("acceleration", "acceleration_range"),
        at_least_one("acceleration", "acceleration_range", "shape"),
    )
    acceleration: Value | None = None
    acceleration_range: Range[float] | Callable[[], Range[float]] | None = None
    shape: AnyAccelerationShape | OwnShape[AnyAccelerationShape] | None = None

    def bounds(self) -> tuple[float, float]:
        """Least and greatest acceleration (m/s^2) now; equal without a range."""
        return wanted(self.acceleration, self.acceleration_range, self.shape)

    def value(self, now: float) -> float:
        """The allowed acceleration (m/s^2) nearest to the present one."""
        low, high = self.bounds()
        return min(max(now, low), high)

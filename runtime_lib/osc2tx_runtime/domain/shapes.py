"""Shapes: the value of a quantity over the time of a phase (DSL 8.9.1.2).

A shape computes the value of its modifier over time: a speed or speed difference; a distance along
the road or to another actor; a lateral position. The time counts from the start of the action.
Common shapes state how a target is reached; shapes of a scenario compute every value in their own
classes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar, Generic, TypeVar

from osc2tx_runtime.enums import DynamicProfile
from osc2tx_runtime.errors import NO_RESULT, ScenarioError, why_no_result
from osc2tx_runtime.world.checks.values import LARGEST
from osc2tx_runtime.world.geometry.function_profiles import Computed
from osc2tx_runtime.world.geometry.profiles import (
    QUINTIC_PEAK,
    Cosine,
    Linear,
    Profile,
    Quintic,
    cosine_duration,
)
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class AnyShape:
    """Base of all shapes.

    Attributes:
        kind: Name of the base in the DSL of all shapes for this quantity.
    """

    kind: ClassVar[str] = "any_shape"


@dataclass(frozen=True, slots=True)
class AnySpeedShape(AnyShape):
    """Of a speed (m/s)."""

    kind = "any_speed_shape"


@dataclass(frozen=True, slots=True)
class AnyAccelerationShape(AnyShape):
    """Of an acceleration (m/s^2)."""

    kind = "any_acceleration_shape"


@dataclass(frozen=True, slots=True)
class AnyPositionShape(AnyShape):
    """Of a position along the road, a distance covered, or a distance to another actor (m)."""

    kind = "any_position_shape"


@dataclass(frozen=True, slots=True)
class AnyLateralShape(AnyShape):
    """Of a lateral position (m)."""

    kind = "any_lateral_shape"


@dataclass(frozen=True, slots=True)
class CommonShape(AnyShape):
    """The common base of the common shapes.

    In an action they start from the motion of the actor; called directly they start at zero.

    Attributes:
        rate_profile: Profile of the first derivative of the quantity.
        rate_peak: Its peak.
        target: Value to reach, if the modifier states none.
    """

    rate_profile: DynamicProfile = "none"
    rate_peak: float | None = None
    target: float | None = None

    def duration(self) -> float:
        """Seconds from zero to the target.

        Raises:
            ScenarioError: Profile, peak or target do not determine it.
        """
        return self._from_zero().duration

    def compute(self, time: float) -> float:
        """Value at a time (s) after a start at zero; raises as `duration`."""
        return self._from_zero().value(time)

    def _from_zero(self) -> Profile:
        if self.target is None:
            raise ScenarioError("a common shape without a target has no values by itself")
        if not self.rate_peak or self.rate_profile not in ("constant", "smooth"):
            raise ScenarioError(
                "a common shape has values by itself with a rate_peak and the rate_profile"
                " constant or smooth; otherwise they depend on the actor"
            )
        if self.rate_profile == "constant":
            return Linear(0.0, self.target, abs(self.target) / self.rate_peak)
        return self._smooth(self.target, self.rate_peak)

    def _smooth(self, target: float, peak: float) -> Profile:
        return Quintic(0.0, target, QUINTIC_PEAK * abs(target) / peak)


@dataclass(frozen=True, slots=True)
class CommonSpeedShape(CommonShape, AnySpeedShape):
    """Of a speed (m/s); the rate is the acceleration (m/s^2)."""

    def _smooth(self, target: float, peak: float) -> Profile:
        return Cosine(0.0, target, cosine_duration(target, peak))


@dataclass(frozen=True, slots=True)
class CommonAccelerationShape(CommonShape, AnyAccelerationShape):
    """Of an acceleration (m/s^2); the rate is the jerk (m/s^3)."""


@dataclass(frozen=True, slots=True)
class CommonPositionShape(CommonShape, AnyPositionShape):
    """Of a position along the road or a distance (m); the rate is a speed (m/s).

    The speed is relative to the origin of the distance: the speed of the actor itself, or relative
    to the actor of `ahead_of` or `behind`.
    """


@dataclass(frozen=True, slots=True)
class CommonLateralShape(CommonShape, AnyLateralShape):
    """Of a lateral position (m); the rate is the lateral speed (m/s)."""

    def _smooth(self, target: float, peak: float) -> Profile:
        return Cosine(0.0, target, cosine_duration(target, peak))


ShapeT = TypeVar("ShapeT", bound=AnyShape, covariant=True)


class OwnShape(Generic[ShapeT]):
    """A shape of a scenario, with its methods.

    Args:
        shape: The object, with the members that the methods read.
        compute: The value at a time (s) after the start of the action.
        duration: Duration (s); None: as long as the action.
    """

    def __init__(
        self,
        shape: ShapeT,
        compute: Callable[[Any, float], float],
        duration: Callable[[Any], float] | None = None,
    ) -> None:
        self.kind = shape.kind
        self._shape = shape
        self._compute = compute
        self._duration = duration

    def course(self) -> Computed:
        """The profile; its duration is computed now, its values when they are needed.

        Raises:
            ScenarioError: A method has no value, as in a division by zero.
        """
        length = math.inf if self._duration is None else self._asked(self._duration)
        if not length >= 0.0:
            raise ScenarioError(f"the duration of the shape is {length:g} s")
        return Computed(self._value, length)

    def _value(self, time: float) -> float:
        value = self._asked(self._compute, time)
        if not abs(value) <= LARGEST:
            raise ScenarioError(f"`compute` of the shape is {value:g}, which is out of range")
        return value

    def _asked(self, method: Callable[..., float], *arguments: float) -> float:
        try:
            return float(method(self._shape, *arguments))
        except NO_RESULT as error:
            name = "compute" if arguments else "duration"
            raise ScenarioError(
                f"`{name}` of the shape has no value: {why_no_result(error)}"
            ) from error


def with_methods(shape: AnyShape) -> AnyShape | OwnShape[AnyShape]:
    """Return a shape with the methods of its class; others unchanged."""
    compute = getattr(type(shape), "compute", None)
    if compute is None or compute is CommonShape.compute:
        return shape
    duration = getattr(type(shape), "duration", None)
    return OwnShape(shape, compute, None if duration is CommonShape.duration else duration)

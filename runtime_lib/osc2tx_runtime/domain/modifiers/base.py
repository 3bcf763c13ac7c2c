"""Base class of movement modifiers; evaluation of values, ranges and shapes."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, ClassVar, TypeAlias, TypeVar

from osc2tx_runtime.domain.shapes import AnyShape, CommonShape, OwnShape, with_methods
from osc2tx_runtime.enums import At, DynamicProfile, MovementMode, Track
from osc2tx_runtime.errors import NO_RESULT, ScenarioError, why_no_result
from osc2tx_runtime.language.actions.modifier import Modifier
from osc2tx_shared.classes import dataclass, replace

if TYPE_CHECKING:
    from osc2tx_runtime.language.values.parameters import Range
    from osc2tx_runtime.world.geometry.function_profiles import Computed

__all__ = [
    "Late",
    "Modifier",
    "MovementModifier",
    "Shape",
    "Value",
    "band_of",
    "course_of",
    "now",
    "own_course",
    "settled",
    "target_of",
    "value_of",
    "wanted",
]

ValueT = TypeVar("ValueT")
Late: TypeAlias = ValueT | Callable[[], ValueT]
"""A value, or a function that is called for it when the action starts."""

Value: TypeAlias = Late[float]
Shape = AnyShape | OwnShape[AnyShape]

_SAME = 1e-3  # between the value that a shape reaches and the required one


def now(value: ValueT | Callable[[], ValueT]) -> ValueT:
    """Return a value that may be evaluated late.

    Raises:
        ScenarioError: The expression has no value, as in a division by zero.
    """
    if not callable(value):
        return value
    try:
        return value()
    except NO_RESULT as error:
        raise ScenarioError(f"an argument has no value: {why_no_result(error)}") from error


def settled(modifiers: Sequence[Modifier]) -> tuple[Modifier, ...]:
    """The modifiers with the present values of arguments that are evaluated late.

    Raises:
        ScenarioError: An argument has no value, or one that the modifier does not accept.
    """
    return tuple(map(_settled, modifiers))


def _settled(modifier: Modifier) -> Modifier:
    late = {name: now(value) for name, value in modifier.given().items() if callable(value)}
    return replace(modifier, **late) if late else modifier


def value_of(value: Value) -> float:
    """The present number."""
    return float(now(value))


def band_of(
    value: Value | None, band: Range[float] | Callable[[], Range[float]] | None
) -> tuple[float, float]:
    """The least and the greatest allowed number now; equal for a single number.

    Args:
        value: The scalar parameter; 0 if neither is given.
        band: Its `*_range` twin.
    """
    if band is None:
        number = 0.0 if value is None else value_of(value)
        return number, number
    bounds = now(band)
    return float(bounds.low), float(bounds.high)


def wanted(
    value: Value | None,
    band: Range[float] | Callable[[], Range[float]] | None,
    shape: Shape | None,
) -> tuple[float, float]:
    """The least and the greatest allowed number now, or the target of a shape.

    Raises:
        ScenarioError: The target of the shape contradicts the given value.
    """
    target = target_of(shape)
    if value is None and band is None:
        return target or 0.0, target or 0.0
    low, high = band_of(value, band)
    if target is not None and not low - _SAME <= target <= high + _SAME:
        there = f"{low:g}" if low == high else f"{low:g} to {high:g}"
        raise ScenarioError(f"the shape reaches {target:g}, which is not {there}")
    return low, high


def course_of(shape: Shape | None) -> tuple[DynamicProfile, float | None]:
    """Profile and peak of the rate of a common shape."""
    if isinstance(shape, CommonShape):
        return shape.rate_profile, shape.rate_peak
    return "none", None


def own_course(shape: Shape | None) -> Computed | None:
    """The profile that a shape of the scenario computes; None for others."""
    return shape.course() if isinstance(shape, OwnShape) else None


def target_of(shape: Shape | None) -> float | None:
    """The target of a shape; None if it states none, or never ends."""
    if isinstance(shape, OwnShape):
        course = shape.course()
        return None if math.isinf(course.duration) else course.end
    return shape.target if isinstance(shape, CommonShape) else None


@dataclass(frozen=True, slots=True, kw_only=True)
class MovementModifier(Modifier):
    """Base of the modifiers with the common parameters (DSL 8.9.1.1).

    Attributes:
        at: When it holds.
        movement_mode: `monotonous`: within the limits of the actor, and the controlled quantity
            never reverses; an infeasible motion fails.
        track: The motion of the reference that counts: the actual motion, or (`projected`) the
            motion extrapolated in its lane at its speed at the start of the action.
        shaped_by: The base of the shapes of its value; None: it has no shapes.
    """

    shaped_by: ClassVar[type[AnyShape] | None] = None

    at: At = "all"
    movement_mode: MovementMode = "other"
    track: Track = "actual"

    @property
    def projected(self) -> bool:
        """Whether the extrapolated motion of the reference counts."""
        return self.track == "projected"

    @property
    def monotonous(self) -> bool:
        """Whether the motion has to be monotonous."""
        return self.movement_mode == "monotonous"

    def check(self) -> None:
        """Checks that the shape is one of the value."""
        shape: AnyShape | OwnShape[AnyShape] | None = getattr(self, "shape", None)
        if isinstance(shape, AnyShape):
            shape = with_methods(shape)
            object.__setattr__(self, "shape", shape)
        wanted = self.shaped_by
        if shape and wanted and wanted.kind not in (shape.kind, AnyShape.kind):
            raise ScenarioError(f"{self.name}: a shape of it is an {wanted.kind}")

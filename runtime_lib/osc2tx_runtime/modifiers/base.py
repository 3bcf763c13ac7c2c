"""What all modifiers share: the base classes, numbers and ranges that may be read late, checks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, ClassVar, Literal, TypeVar

from osc2tx_runtime.argument_rules import Rule, check_arguments
from osc2tx_runtime.behaviour.conditions import EVALUATION_ERRORS
from osc2tx_runtime.errors import ScenarioError, UnsupportedError

if TYPE_CHECKING:
    from osc2tx_runtime.behaviour.parameters import Range
    from osc2tx_runtime.shapes import CommonShape
    from osc2tx_runtime.world.profiles import DynamicProfile

__all__ = [
    "At",
    "Modifier",
    "MovementModifier",
    "Side",
    "Value",
    "band_of",
    "course_of",
    "now",
    "upright",
    "value_of",
]

ValueT = TypeVar("ValueT")
Value = float | Callable[[], float]
Side = Literal["left", "right"]
At = Literal["start", "end", "all"]


def now(value: ValueT | Callable[[], ValueT]) -> ValueT:
    """A value that may be read late.

    Raises:
        ScenarioError: The expression has no value, as in a division by zero.
    """
    if not callable(value):
        return value
    try:
        return value()
    except EVALUATION_ERRORS as error:
        raise ScenarioError(f"an argument has no value: {error}") from error


def value_of(value: Value) -> float:
    """The number now."""
    return float(now(value))


def band_of(
    value: Value | None, band: Range[float] | Callable[[], Range[float]] | None
) -> tuple[float, float]:
    """The least and the greatest allowed number now; both the same for a plain one.

    Args:
        value: The scalar parameter; 0 if neither is given.
        band: Its `*_range` twin.
    """
    if band is None:
        number = 0.0 if value is None else value_of(value)
        return number, number
    bounds = now(band)
    return float(bounds.low), float(bounds.high)


def course_of(shape: CommonShape | None) -> tuple[DynamicProfile, float | None]:
    """Profile and peak of the rate that a shape gives."""
    return ("none", None) if shape is None else (shape.rate_profile, shape.rate_peak)


def upright(what: str, pitch: float | None, roll: float | None) -> None:
    """Refuses pitch and roll."""
    if pitch or roll:
        raise UnsupportedError(f"{what}: pitch and roll are not there yet")


@dataclass(frozen=True, slots=True)
class Modifier:
    """Base of all modifiers.

    Attributes:
        name: Name in the DSL.
        rules: Which parameters go together; the compiler knows them as well.
    """

    name: ClassVar[str] = ""
    rules: ClassVar[tuple[Rule, ...]] = ()

    def __post_init__(self) -> None:
        """Checks the rules. With slots, subclasses cannot reach it by `super()`."""
        check_arguments(self.name, self.rules, self.given())

    def given(self) -> dict[str, Any]:
        """Parameters with values that are not those of a modifier without arguments."""
        values = ((field, getattr(self, field.name)) for field in fields(self))
        return {
            field.name: value
            for field, value in values
            if value is not None and value != field.default
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class MovementModifier(Modifier):
    """Base of the modifiers with the common parameters (DSL 8.9.1.1).

    Attributes:
        at: When it holds.
        movement_mode: `monotonous` forbids detours of the controlled quantity; the courses of this
            runtime only turn back where their ends leave no other way, so both values do the same.
        track: What counts of a reference: what it does, or (`projected`) what it would do if it
            went on in its lane at the speed it has at the start of the action.
    """

    at: At = "all"
    movement_mode: Literal["monotonous", "other"] = "other"
    track: Literal["actual", "projected"] = "actual"

    @property
    def projected(self) -> bool:
        """Whether the reference counts as it would go on."""
        return self.track == "projected"

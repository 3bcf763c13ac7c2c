"""What all modifiers share: the base class, numbers that may be read late, checks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, Literal

from osc2tx_runtime.errors import ScenarioError, UnsupportedError

__all__ = ["At", "Modifier", "Side", "Value", "at_most_one", "upright", "value_of"]

Value = float | Callable[[], float]
Side = Literal["left", "right"]
At = Literal["start", "end", "all"]


def value_of(value: Value) -> float:
    """The number now."""
    return float(value()) if callable(value) else float(value)


def at_most_one(what: str, *given: object) -> None:
    """Refuses parameters that exclude each other."""
    if sum(value is not None for value in given) > 1:
        raise ScenarioError(f"{what}: give at most one of them")


def upright(what: str, pitch: float | None, roll: float | None) -> None:
    """Refuses pitch and roll."""
    if pitch or roll:
        raise UnsupportedError(f"{what}: pitch and roll are not there yet")


@dataclass(frozen=True, slots=True)
class Modifier:
    """Base of all modifiers.

    Attributes:
        name: Name in the DSL.
    """

    name: ClassVar[str] = ""

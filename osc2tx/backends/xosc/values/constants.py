"""Values of expressions that do not change during a run."""

from __future__ import annotations

from typing import TypeAlias

from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Member:
    """A member of an enum."""

    enum: str
    name: str


@dataclass(frozen=True, slots=True)
class Named:
    """An actor or struct of the scenario, by its name."""

    name: str


@dataclass(frozen=True, slots=True)
class Bounds:
    """A range."""

    lower: float
    upper: float


@dataclass(frozen=True, slots=True)
class MethodResult:
    """What a method of the library makes of constants: a point, a path, states of lamps.

    Attributes:
        method: The method.
        owner: Name of the actor or struct whose method it is.
        arguments: By parameter.
    """

    method: str
    owner: str
    arguments: tuple[tuple[str, Constant], ...]

    def get(self, parameter: str) -> Constant | None:
        """Return an argument."""
        return dict(self.arguments).get(parameter)


Constant: TypeAlias = (
    "bool | int | float | str | Member | Named | Bounds | MethodResult | tuple[Constant, ...]"
)


def as_number(value: Constant | None) -> float | None:
    """Return the number that a value is; `None` if it is none."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    return float(value)

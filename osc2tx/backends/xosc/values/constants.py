"""Values of expressions that do not change during a run."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from osc2tx import ir
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


class UserTypes:
    """The actors and structs that the files of a module declare.

    Args:
        types: Those types.
    """

    def __init__(self, types: Iterable[ir.UserType] = ()) -> None:
        self._types = {own.name: own for own in types}

    def default(self, type_name: str, path: tuple[str, ...]) -> ir.Expression | None:
        """Return what a member of an object has if nothing else is said about it.

        Args:
            type_name: The type of the object.
            path: The member, and members of it.
        """
        field = self._field(type_name, path[0])
        if field is None or len(path) == 1:
            return None if field is None else field.default
        return self.default(field.type.name, path[1:])

    def _field(self, type_name: str, name: str) -> ir.UserField | None:
        lineage = ir.lineage(type_name, self._types)
        types = (self._types[each] for each in lineage if each in self._types)
        fields = (field for own in types for field in own.fields)
        return next((field for field in fields if field.name == name), None)

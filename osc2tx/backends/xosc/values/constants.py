"""Values of expressions that do not change during a run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
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


def as_number(value: Constant | None) -> float | None:
    """Return the number that a value is; `None` if it is none."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    return float(value)


class UserTypes:
    """The actors and structs that the files of a module declare."""

    def __init__(self, types: Iterable[ir.UserType] = ()) -> None:
        self._types = {own.name: own for own in types}
        self._fields: dict[str, tuple[ir.UserField, ...]] = {}

    def default(self, type_name: str, path: tuple[str, ...]) -> ir.Expression | None:
        """Return what a member of an object, or a member of that, has if nothing else is said."""
        field = self._field(type_name, path[0])
        if field is None or len(path) == 1:
            return None if field is None else field.default
        return self.default(field.type.name, path[1:])

    def fields(self, type_name: str) -> Sequence[ir.UserField]:
        """Return the fields that a type has by files of the module, those of bases first."""
        if type_name not in self._fields:
            lineage = reversed(ir.lineage(type_name, self._types))
            known = (self._types[name] for name in lineage if name in self._types)
            self._fields[type_name] = tuple(field for each in known for field in each.fields)
        return self._fields[type_name]

    def _field(self, type_name: str, name: str) -> ir.UserField | None:
        return next((field for field in self.fields(type_name) if field.name == name), None)


@lru_cache(maxsize=4)
def types_of(module: ir.Module) -> UserTypes:
    """Return the types of a module, for all the documents that are made of it."""
    return UserTypes(module.types)

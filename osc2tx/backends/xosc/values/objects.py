"""What a scenario fixes about its actors and structs."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache

from osc2tx import ir
from osc2tx.backends.xosc.values.constants import Constant, Member, Named, as_number
from osc2tx.losses.entries import Inexpressible


class UserTypes:
    """The actors and structs that the files of a module declare."""

    def __init__(self, types: Iterable[ir.UserType]) -> None:
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


class Objects(ABC):
    """The actors and structs of a scenario, whose members are expressions."""

    def __init__(self, scenario: ir.Scenario, types: UserTypes) -> None:
        self._declared = {d.name: d for d in scenario.declarations}
        self._types = types

    @abstractmethod
    def of(self, expression: ir.Expression) -> Constant:
        """Return the value of an expression."""

    def field(self, name: str, *path: str) -> Constant | None:
        """Return what a constraint fixes about an actor or struct; `None` if nothing does."""
        declaration = self._declared.get(name)
        if declaration is None and "." in name:
            owner, *inner = name.split(".")
            return self.field(owner, *inner, *path)
        if isinstance(declaration, (ir.Actor, ir.Struct)):
            for value in declaration.values:
                if value.path == path:
                    return self.of(value.value)
                is_part = value.path == path[: len(value.path)] and len(value.path) < len(path)
                whole = self.of(value.value) if is_part else None
                if isinstance(whole, Named):  # a struct of the scenario says it
                    return self.field(whole.name, *path[len(value.path) :])
            is_inner = any(value.path[: len(path)] == path for value in declaration.values)
            if is_inner and isinstance(declaration, ir.Struct):
                return Named(".".join((name, *path)))  # whose own members are fixed
            default = self._types.default(declaration.type, path)
            return None if default is None else self.of(default)
        return None

    def number_in(self, name: str, *path: str) -> float | None:
        """Return the number that a constraint fixes; `None` if nothing does."""
        return as_number(self.field(name, *path))

    def member_in(self, name: str, *path: str) -> str | None:
        """Return the name of the member of an enum, likewise."""
        value = self.field(name, *path)
        return value.name if isinstance(value, Member) else None

    def own_fields(self, name: str) -> Iterator[tuple[str, str | float]]:
        """Yield the plain values of the fields that files of the user give to an actor.

        Nothing in a document depends on them, so what only the run knows is left out.
        """
        for field in self._types.fields(self.type_of(name)):
            try:
                value = self.field(name, field.name)
            except Inexpressible:
                continue
            if isinstance(value, Member):
                yield field.name, value.name
            elif isinstance(value, (int, float, str)):
                yield field.name, value

    def type_of(self, name: str) -> str:
        """Return the type of an actor or struct."""
        declaration = self._declared.get(name)
        return declaration.type if isinstance(declaration, (ir.Actor, ir.Struct)) else ""

    def is_library_shape(self, name: str) -> bool:
        """Whether a struct is a course that the library describes (§8.9.22)."""
        declaration = self._declared.get(name)
        return isinstance(declaration, ir.Struct) and declaration.type.startswith("common_")

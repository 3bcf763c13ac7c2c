"""Default values of fields of the scenario's own types."""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx import ir


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

"""Constructor calls of objects: actors, and values of structs."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from osc2tx import ir
from osc2tx.backends.py_trees.code import Level, PyExpr, PyName, name_expression
from osc2tx.backends.py_trees.comments import comments
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.naming import identifier
from osc2tx.backends.py_trees.runtime_api import text_class
from osc2tx.backends.py_trees.type_table import TypeTable
from osc2tx.backends.py_trees.view import ArgumentView, CallView
from osc2tx.catalogue.constructors import (
    constructor_path,
    list_element,
    nested_object,
)
from osc2tx_shared.classes import replace


class ObjectWriter:
    """Writes the objects of one scenario.

    Args:
        expressions: Writer of their content.
        types: All types that the module knows.
    """

    def __init__(self, expressions: ExpressionWriter, types: TypeTable) -> None:
        self._expressions = expressions
        self._types = types

    def write(self, lineage: tuple[str, ...], values: tuple[ir.FieldValue, ...]) -> ArgumentView:
        """Write the constructor of an object; members that are objects are inside."""
        arguments: dict[str, ArgumentView] = {}
        owners = {field.name: owner for owner, field in self._types.owned_fields(lineage)}
        keyed = [replace(v, path=constructor_path(lineage, v.path)) for v in values]
        for value in keyed:
            first = value.path[0]
            inner = self._member_lineage(lineage, first)
            if len(value.path) > 1 and (element := list_element(lineage, first)) is not None:
                class_of_it = self._types.class_of(element) if element else None
                inside = [v for v in keyed if v.path[0] == first]
                write = self._expressions.write
                arguments[first] = write_elements(class_of_it, inside, write)
            elif inner is None or len(value.path) == 1:
                arguments[".".join(value.path)] = self._plain(lineage, value)
            elif first not in arguments:
                below = tuple(replace(v, path=v.path[1:]) for v in keyed if v.path[0] == first)
                arguments[first] = self.write(inner, below)
        for field in self._types.fields(lineage):
            if field.type.kind is ir.Kind.STRUCT and field.name not in arguments:
                arguments[field.name] = self.write(self._types.lineage(field.type.name), ())
        written = (
            replace(a, keyword=self._types.member(owners.get(keyword, ""), keyword))
            for keyword, a in arguments.items()
        )
        class_ = name_expression(self._types.class_of(lineage))
        return ArgumentView(call=CallView(class_, tuple(written)))

    def _plain(self, lineage: tuple[str, ...], value: ir.FieldValue) -> ArgumentView:
        """Write a value without a constructor, or with the constructor of its kind of string."""
        written = self._expressions.write(value.value)
        above = comments(value.comments)
        class_ = text_class(lineage, value.path[0])
        if class_ is None or value.value.type.kind is not ir.Kind.STRING:
            return ArgumentView(code=written, comments=above)
        callee = name_expression(self._types.runtime_class(class_))
        return ArgumentView(call=CallView(callee, (ArgumentView(code=written),)), comments=above)

    def _member_lineage(self, lineage: tuple[str, ...], member: str) -> tuple[str, ...] | None:
        """Return the types of a member that is an object itself; `None` for other members."""
        field = self._types.field(lineage, member)
        if field is not None:
            is_object = field.type.kind is ir.Kind.STRUCT
            return self._types.lineage(field.type.name) if is_object else None
        library = nested_object(lineage, member)
        return None if library is None else (library,)


def write_elements(
    class_: PyName | None,
    values: Sequence[ir.FieldValue],
    write: Callable[[ir.Expression], PyExpr],
) -> ArgumentView:
    """Write the values that constraints fix of elements, by their numbers.

    Args:
        class_: Class of the elements; `None` if they are plain values.
        values: The fixed values; paths consist of the list, the number and the member.
        write: Writes an expression.
    """
    whole: dict[int, str] = {}
    members: dict[int, list[str]] = {}
    for value in values:
        _, number, *path = value.path
        written = write(value.value).within(Level.CONDITIONAL)
        if path:
            name = ".".join(str(PyName(identifier(member))) for member in path)
            members.setdefault(int(number), []).append(f"{name}={written}")
        else:
            whole[int(number)] = written
    made = {place: f"{class_}({', '.join(parts)})" for place, parts in members.items()}
    entries = [f"{place}: {text}" for place, text in sorted({**made, **whole}.items())]
    said = tuple(line for value in values for line in value.comments)
    text = PyExpr(f"{{{', '.join(entries)}}}", Level.ATOM)
    return ArgumentView(code=text, comments=comments(said))

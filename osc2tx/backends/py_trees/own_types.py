"""Actors and structs of the scenario's own files, as classes of the module."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx import ir
from osc2tx.backends.py_trees.calls import comments
from osc2tx.backends.py_trees.code import PyDocLine, PyName, literal
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.naming import NameTable, identifier
from osc2tx.backends.py_trees.runtime_api import ACTOR_CLASSES, ANNOTATIONS, STRUCT_CLASSES
from osc2tx.backends.py_trees.uses import Uses
from osc2tx.backends.py_trees.view import FieldView, TypeView


def class_key(type_: str) -> str:
    """Return the key of a type in the table of the module's classes."""
    return f"type {type_}"


def write_types(
    types: Sequence[ir.OwnType], classes: NameTable, uses: Uses
) -> tuple[TypeView, ...]:
    """Return the view models of the types, in their order.

    Args:
        types: The types, bases first.
        classes: Names of the module's classes.
        uses: What the module has to import.
    """
    writer = ExpressionWriter(NameTable(), uses.unit, uses.name)
    own = {each.name for each in types}
    return tuple(_write(each, own, classes, uses, writer) for each in types)


def _write(
    own: ir.OwnType, names: set[str], classes: NameTable, uses: Uses, writer: ExpressionWriter
) -> TypeView:
    if not own.is_actor:
        uses.standard("dataclasses", "dataclass")
    elif own.fields:
        uses.standard("typing", "Any")
    word = "Actor" if own.is_actor else "Struct"
    about = [f"{word} `{own.name}` ({own.span}).", *(["", *own.comments] if own.comments else [])]
    return TypeView(
        class_name=classes[class_key(own.name)],
        base=_base(own, names, classes, uses),
        kind=literal(own.name),
        is_actor=own.is_actor,
        docstring=tuple(PyDocLine.of(line) for line in about),
        fields=tuple(
            FieldView(
                name=PyName(identifier(field.name)),
                annotation=PyName(ANNOTATIONS[field.type.kind.value]),
                default=None if field.default is None else writer.write(field.default),
                comments=comments(field.comments),
            )
            for field in own.fields
        ),
    )


def _base(own: ir.OwnType, names: set[str], classes: NameTable, uses: Uses) -> PyName | None:
    if own.base is None:
        return None
    if own.base in names:
        return classes[class_key(own.base)]
    return uses.name({**ACTOR_CLASSES, **STRUCT_CLASSES}[own.base])

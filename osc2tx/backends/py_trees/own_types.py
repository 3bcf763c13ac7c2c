"""Actors and structs of the scenario's own files, as classes of the module."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx import ir
from osc2tx.backends.py_trees.calls import comments
from osc2tx.backends.py_trees.code import PyDocLine, literal
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.naming import NameTable
from osc2tx.backends.py_trees.type_table import TypeTable
from osc2tx.backends.py_trees.uses import Uses
from osc2tx.backends.py_trees.view import FieldView, TypeView


def write_types(own: Sequence[ir.UserType], table: TypeTable, uses: Uses) -> tuple[TypeView, ...]:
    """Return the view models of the types, in their order.

    Args:
        own: The types, bases first.
        table: All types that the module knows.
        uses: What the module has to import.
    """
    writer = ExpressionWriter(NameTable(), uses.unit, uses.name)
    names = [each.name for each in own]
    return tuple(
        _write(each, frozenset(names[index:]), table, uses, writer)
        for index, each in enumerate(own)
    )


def _write(
    own: ir.UserType, later: frozenset[str], table: TypeTable, uses: Uses, writer: ExpressionWriter
) -> TypeView:
    if not own.is_actor:
        uses.standard("dataclasses", "dataclass")
    elif own.fields:
        uses.standard("typing", "Any")
    word = "Actor" if own.is_actor else "Struct"
    about = [f"{word} `{own.name}`.", *(["", *own.comments] if own.comments else [])]
    return TypeView(
        class_name=table.class_of((own.name,)),
        base=table.base_of(own),
        kind=literal(own.name),
        is_actor=own.is_actor,
        docstring=tuple(PyDocLine.of(line) for line in about),
        fields=tuple(
            FieldView(
                name=table.member(own.name, field.name),
                annotation=table.annotation(field.type, later),
                default=None if field.default is None else writer.write(field.default),
                comments=comments(field.comments),
            )
            for field in own.fields
        ),
    )

"""An AST as plain data of JSON and back, for texts that are parsed before they are used.

The data consist of lists, strings and numbers only, one column for each field of each class of
node. Columns are filled in by loops that run in C, so unpacking takes a fraction of the time that
parsing takes. The data cannot execute code.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import fields
from enum import Enum
from functools import cache
from itertools import accumulate, pairwise, repeat
from operator import add
from typing import Any

from osc2tx.diagnostics import SourceFile, Span
from osc2tx.syntax import ast

Column = Sequence[Any]  # its shape and its content
Group = Sequence[Any]  # name of the class, number of nodes, columns of its fields
Packed = Sequence[Group]

NONE = -1  # the index of `None`


class PackingError(ValueError):
    """The data are not those of an AST."""


def pack(file: ast.File) -> Packed:
    """Return an AST as plain data; the `File` is the only node of its class, and comes first."""
    nodes: dict[str, list[ast.Node]] = {}
    for node in _nodes(file):
        nodes.setdefault(type(node).__name__, []).append(node)
    indexes = {node: i for i, node in enumerate(n for group in nodes.values() for n in group)}
    return [
        (name, len(group), [_column(group, field, indexes) for field in _fields(name)])
        for name, group in nodes.items()
    ]


@cache
def _fields(name: str) -> tuple[str, ...]:
    """Return the fields of a class of nodes."""
    return tuple(field.name for field in fields(_NODES[name]))


def _nodes(file: ast.File) -> Iterator[ast.Node]:
    """Yield a node before those below it, without recursion."""
    pending: list[ast.Node] = [file]
    while pending:
        node = pending.pop()
        yield node
        for field in _fields(type(node).__name__):
            value = getattr(node, field)
            items = value if isinstance(value, tuple) else (value,)
            pending += [item for item in items if isinstance(item, ast.Node)]


def _column(group: Sequence[ast.Node], field: str, indexes: dict[ast.Node, int]) -> Column:
    """Return the values of a field in the plainest shape that holds them all."""
    values = [getattr(node, field) for node in group]
    if field == "span":
        starts = [span.start for span in values]
        steps = [after - before for before, after in pairwise([0, *starts])]
        return "spans", (steps, [span.end - span.start for span in values])
    if all(isinstance(value, Enum) for value in values):
        return "enum", (type(values[0]).__name__, [value.value for value in values])
    if all(isinstance(value, tuple) for value in values):
        if any(isinstance(item, ast.Node) for value in values for item in value):
            return "tuples", [tuple(indexes[item] for item in value) for value in values]
        return "plain tuples", values
    if not any(isinstance(value, ast.Node) for value in values):
        return "plain", values
    if all(value is None or isinstance(value, ast.Node) for value in values):
        return "nodes", [NONE if value is None else indexes[value] for value in values]
    return "mixed", [
        (True, indexes[value]) if isinstance(value, ast.Node) else (False, value)
        for value in values
    ]


def unpack(data: Packed, source: SourceFile) -> ast.File:
    """Return the AST of a text from its data.

    Raises:
        PackingError: If the data are not what `pack` returns; not every defect is detected.
    """
    try:
        return _unpack(data, source)
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise PackingError(f"{type(error).__name__}: {error}") from error


def _unpack(data: Packed, source: SourceFile) -> ast.File:
    nodes: list[Any] = []
    for name, count, _ in data:
        kind = _NODES[name]
        nodes += map(kind.__new__, repeat(kind, count))
    file = nodes[0]
    nodes.append(None)  # at `NONE`
    node_at = nodes.__getitem__
    position = 0
    for name, count, columns in data:
        group = nodes[position : position + count]
        position += count
        for field, column in zip(_fields(name), columns, strict=True):
            values = _values(column, source, node_at)
            deque(map(getattr(_NODES[name], field).__set__, group, values), maxlen=0)
    if not isinstance(file, ast.File):
        raise PackingError("no file")
    return file


def _values(
    column: Column, source: SourceFile, node_at: Callable[[int], ast.Node | None]
) -> Iterable[Any]:
    shape, content = column
    match shape:
        case "plain":
            return list(content)
        case "plain tuples":
            return map(tuple, content)
        case "spans":
            steps, lengths = content
            starts = list(accumulate(steps))
            return map(Span, repeat(source), starts, map(add, starts, lengths))
        case "nodes":
            return map(node_at, content)
        case "tuples":
            return (tuple(map(node_at, indexes)) for indexes in content)
        case "enum":
            name, values = content
            return map(_ENUMS[name], values)
        case "mixed":
            return (node_at(value) if is_node else value for is_node, value in content)
    raise PackingError(f"no shape {shape!r}")


def _classes(base: type) -> dict[str, Any]:
    return {
        name: kind
        for name, kind in vars(ast).items()
        if isinstance(kind, type) and issubclass(kind, base)
    }


_NODES = _classes(ast.Node)
_ENUMS = _classes(Enum)

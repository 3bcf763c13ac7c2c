"""Elements of a list of an actor that are said one by one: `axles={0: Axle(track_width=2 * m)}`."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from osc2tx import ir
from osc2tx.backends.py_trees.calls import comments
from osc2tx.backends.py_trees.code import Level, PyExpr, PyName
from osc2tx.backends.py_trees.naming import identifier
from osc2tx.backends.py_trees.view import ArgumentView


def write_elements(
    class_: PyName | None,
    values: Sequence[ir.FieldValue],
    write: Callable[[ir.Expression], PyExpr],
) -> ArgumentView:
    """Write what constraints fix about elements, by their numbers.

    Args:
        class_: Class of the elements; `None` if they are plain values.
        values: What is fixed; paths are of the list, the number and the member.
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

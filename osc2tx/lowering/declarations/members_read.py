"""Members of objects as their values, where two objects read members of each other.

Only members depend on each other in the language (§7.3.11.1): with `p.a == q.b` and `q.a == p.b`
nothing is defined by itself. A module makes objects as a whole; a value that it cannot read from
an object in time is written in place of the read.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from osc2tx import ir
from osc2tx_shared.classes import replace

Path = tuple[str, ...]


def path_of(part: ir.Expression) -> Path:
    """Return the name of an object and the members down from it; empty for anything else."""
    path: list[str] = []
    while isinstance(part, ir.Attribute):
        path.append(part.name)
        part = part.base
    return (part.name, *reversed(path)) if path and isinstance(part, ir.FieldRef) else ()


def with_members_written(circle: Sequence[ir.Declaration]) -> tuple[ir.Declaration, ...]:
    """Return declarations that need each other, with the values of members that they read.

    Args:
        circle: The declarations. Members that are defined by themselves are still read.
    """
    stated: dict[Path, ir.Expression] = {
        (each.name, *value.path): value.value
        for each in circle
        if isinstance(each, ir.Actor | ir.Struct)
        for value in each.values
    }
    return tuple(_written(each, stated) for each in circle)


def with_reads_written(
    value: ir.Expression, own: Path, value_at: Callable[[Path], ir.Expression | None]
) -> ir.Expression:
    """Return a value with values in place of the reads of members, at any depth.

    Args:
        value: The value.
        own: The path of the member whose value it is. Members that are defined by themselves are
            still read: `in_order_of_use` reports that.
        value_at: Returns the value of a member; `None` if it is read.
    """
    pending = [own]

    def replacement(part: ir.Expression) -> ir.Expression | None:
        path = path_of(part)
        found = value_at(path) if path and path not in pending else None
        if found is None:
            return None
        pending.append(path)
        written = ir.rewrite(found, replacement)
        pending.pop()
        return written

    return ir.rewrite(value, replacement)


def _written(declaration: ir.Declaration, stated: Mapping[Path, ir.Expression]) -> ir.Declaration:
    def written(value: ir.Expression, own: Path) -> ir.Expression:
        return with_reads_written(value, own, stated.get)

    name = declaration.name
    match declaration:
        case ir.Actor(values=values) | ir.Struct(values=values, value=None):
            found = (replace(v, value=written(v.value, (name, *v.path))) for v in values)
            return replace(declaration, values=tuple(found))
        case ir.Parameter(value=value) if value is not None:
            return replace(declaration, value=written(value, (name,)))
        case _:
            return declaration

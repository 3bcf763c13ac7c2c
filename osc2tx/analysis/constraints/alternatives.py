"""Alternatives: the consequences that several conditions have in common.

`x in [0..4] or x in [6..8]` implies neither part, but that `x` is between 0 and 8. Each alternative
is propagated separately; the domain of a parameter is the union over all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from typing import TypeAlias

from osc2tx.analysis.constraints.domains import (
    FALSE,
    TRUE,
    Domain,
    EmptyDomainError,
    intersect,
    join,
)
from osc2tx.analysis.constraints.operation_list import Key, Operation

ALTERNATIVES = frozenset({"or", "and", "=>"})
"""Operations whose result has several possible causes."""

Propagate: TypeAlias = Callable[[list[Domain], range], None]
"""Narrows the values of the operations in a range, from the last one down to the first."""

Literal: TypeAlias = tuple[int, Domain]
"""An operation, and the value that it has."""


def narrow_alternatives(
    items: Sequence[Operation], position: int, values: list[Domain], propagate: Propagate
) -> None:
    """Narrow the domains of the parameters below an operation, one of whose operands decides.

    Args:
        items: The operations of an expression.
        position: Position of the operation.
        values: The possible values of each operation; those of parameters below are narrowed.
        propagate: Propagates the operations of one alternative.

    Raises:
        EmptyDomainError: If none of the alternatives is possible.
    """
    alternatives = _alternatives(items, (position, values[position]))
    if len(alternatives) < 2 or any(values[each] == what for each, what in alternatives):
        return
    starts = _starts(items)
    found = []
    for operand, what in alternatives:
        part = range(starts[operand], operand + 1)
        before = values[part.start : part.stop]
        try:
            values[operand] = intersect(values[operand], what)
            propagate(values, part)
            found.append(_parameters(items, part, values))
        except EmptyDomainError:
            pass
        values[part.start : part.stop] = before
    if not found:
        raise EmptyDomainError
    in_all = {key: reduce(join, (each[key] for each in found)) for key in _common(found)}
    for each in range(starts[position], position):
        key = items[each].key
        if key is not None and key in in_all:
            values[each] = intersect(values[each], in_all[key])


def _alternatives(items: Sequence[Operation], whole: Literal) -> list[Literal]:
    """Return the operations of which one, at least, has the value beside it."""
    found, waiting = [], [whole]
    while waiting:
        position, value = waiting.pop()
        parts = _parts(items[position], value)
        waiting += parts
        if not parts:
            found.append((position, value))
    return found


def _parts(operation: Operation, value: Domain) -> list[Literal]:
    match operation.name:
        case "or" if value == TRUE:
            return [(operand, TRUE) for operand in operation.operands]
        case "and" if value == FALSE:
            return [(operand, FALSE) for operand in operation.operands]
        case "=>" if value == TRUE:
            condition, consequence = operation.operands
            return [(condition, FALSE), (consequence, TRUE)]
        case _:
            return []


def _starts(items: Sequence[Operation]) -> list[int]:
    """Return where the operands of each operation begin: they all precede it."""
    starts: list[int] = []
    for position, operation in enumerate(items):
        starts.append(min((starts[operand] for operand in operation.operands), default=position))
    return starts


def _parameters(
    items: Sequence[Operation], part: range, values: Sequence[Domain]
) -> dict[Key, Domain]:
    """Return the possible values of each parameter in a part.

    Raises:
        EmptyDomainError: If two occurrences of it have no value in common.
    """
    known: dict[Key, Domain] = {}
    for each in part:
        key = items[each].key
        if key is not None:
            known[key] = intersect(known[key], values[each]) if key in known else values[each]
    return known


def _common(found: Sequence[dict[Key, Domain]]) -> list[Key]:
    """Return the parameters that all alternatives mention."""
    return [key for key in found[0] if all(key in each for each in found[1:])]

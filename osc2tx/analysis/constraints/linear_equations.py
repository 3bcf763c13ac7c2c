"""Linear equations between parameters: `a * 2 == 10`, `j + k == 10` with `j - k == 4`.

Propagation looks at one occurrence of a parameter at a time; Gaussian elimination sees all. A value
that an equation would only have because an integer wraps around does not count.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import TypeAlias

from osc2tx.analysis.constraints.domains import Domain, Interval
from osc2tx.analysis.constraints.operation_list import Key, OperationList
from osc2tx_shared.classes import dataclass

MOST_EQUATIONS = 40

Form: TypeAlias = dict[Key | None, Fraction]
"""Factors of parameters; that of `None` is a plain number."""


def linear_solutions(
    expressions: Sequence[OperationList], active: Sequence[int], domains: Mapping[Key, Domain]
) -> Iterator[tuple[Key, Interval]]:
    """Yield the parameters that equations leave one value, with that value."""
    kinds: dict[Key, str] = {}
    rows: list[Form] = []
    for index in active:
        if all(_is_point(domains[key]) for key in expressions[index].keys_in_order):
            continue
        row = _equation(expressions[index], domains, kinds)
        if row is not None and any(key is not None for key in row):
            rows.append(row)
    if len(rows) > MOST_EQUATIONS:
        return
    for key, value in _solved(rows):
        number = _number(value, kinds[key])
        domain = domains[key]
        if number is not None and isinstance(domain, Interval) and domain.contains(number):
            yield key, Interval(number, number)


def _equation(
    operations: OperationList, domains: Mapping[Key, Domain], kinds: dict[Key, str]
) -> Form | None:
    """Return `left - right` of an equality; `None` if it is no linear one."""
    root = operations.root
    if root.name != "==":
        return None
    forms: list[Form | None] = []
    for operation in operations.items[:-1]:
        if operation.kind not in ("int", "uint", "float"):
            return None
        domain = operation.initial if operation.key is None else domains[operation.key]
        below = [forms[position] for position in operation.operands]
        if operation.key is not None and not _is_point(domain):
            kinds[operation.key] = operation.kind
            forms.append({operation.key: Fraction(1)})
        elif not operation.operands:
            forms.append(_constant(domain))
        else:
            forms.append(_combined(operation.name, operation.kind, below))
    left, right = (forms[position] for position in root.operands)
    return None if left is None or right is None else _sum(left, right, Fraction(-1))


def _is_point(domain: Domain) -> bool:
    return isinstance(domain, Interval) and domain.is_point


def _constant(domain: Domain) -> Form | None:
    is_finite = isinstance(domain, Interval) and math.isfinite(domain.lower)
    if not isinstance(domain, Interval) or not domain.is_point or not is_finite:
        return None
    return {None: Fraction(domain.lower)}


def _combined(name: str, kind: str, forms: Sequence[Form | None]) -> Form | None:
    known = [form for form in forms if form is not None]
    if len(known) != len(forms):
        return None
    match name, known:
        case "convert", [form]:
            return form
        case "-", [form]:
            return _scaled(form, Fraction(-1))
        case "+", [left, right]:
            return _sum(left, right, Fraction(1))
        case "-", [left, right]:
            return _sum(left, right, Fraction(-1))
        case "*", [left, right] if left.keys() <= {None}:
            return _scaled(right, left.get(None, Fraction(0)))
        case "*", [left, right] if right.keys() <= {None}:
            return _scaled(left, right.get(None, Fraction(0)))
        case "/", [left, right] if kind == "float" and right.keys() == {None} and right[None]:
            return _scaled(left, 1 / right[None])
        case _:
            return None


def _scaled(form: Form, factor: Fraction) -> Form:
    return {key: value * factor for key, value in form.items() if value * factor}


def _sum(left: Form, right: Form, factor: Fraction) -> Form:
    keys = dict.fromkeys((*left, *right))
    total = {key: left.get(key, Fraction(0)) + factor * right.get(key, Fraction(0)) for key in keys}
    return {key: value for key, value in total.items() if value}


def _solved(rows: list[Form]) -> Iterator[tuple[Key, Fraction]]:
    """Yield the parameters of rows that are left with one after elimination."""
    reduced: dict[Key, Form] = {}
    for row in rows:
        for pivot, other in reduced.items():
            if pivot in row:
                row = _sum(row, other, -row[pivot])
        pivots = [key for key in row if key is not None]
        if not pivots:
            continue  # reported already, or a contradiction, which others report
        own = _scaled(row, 1 / row[pivots[0]])
        for pivot, other in reduced.items():
            if pivots[0] in other:
                reduced[pivot] = _sum(other, own, -other[pivots[0]])
        reduced[pivots[0]] = own
    for pivot, row in reduced.items():
        if all(key in (pivot, None) for key in row):
            yield pivot, -row.get(None, Fraction(0))


def _number(value: Fraction, kind: str) -> int | float | None:
    if kind == "float":
        return float(value)
    return int(value) if value.denominator == 1 else None


# Which sides of a comparison are the smaller one, 0 left and 1 right, and whether strictly.
SMALLER: Mapping[str, tuple[tuple[int, ...], bool]] = {
    "<": ((0,), True),
    "<=": ((0,), False),
    ">": ((1,), True),
    ">=": ((1,), False),
    "==": ((0, 1), False),
    "!=": ((0, 1), True),
}


@dataclass(frozen=True, slots=True, eq=False)
class _Edge:
    """A parameter that is not above another, by the constraint at a position."""

    start: Key
    end: Key
    constraint: int


Graph: TypeAlias = Mapping[Key, Sequence[_Edge]]


def find_contradiction(
    expressions: Sequence[OperationList], active: Sequence[int]
) -> tuple[int, ...]:
    """Return constraints that require an impossible order of parameters; empty if there are none.

    Args:
        expressions: All constraints; the root of each must be true.
        active: Positions of the effective ones.
    """
    graph: dict[Key, list[_Edge]] = {}
    denied: list[_Edge] = []
    for index in active:
        for name, left, right in _comparisons(expressions[index]):
            sides, is_strict = SMALLER[name]
            for side in sides:
                start, end = (left, right) if side == 0 else (right, left)
                edge = _Edge(start, end, index)
                if name != "!=":
                    graph.setdefault(start, []).append(edge)
                if is_strict:
                    denied.append(edge)
    for edge in denied:
        # A pair that may not be equal must not be tied from the larger back to the smaller one, and
        # for `!=`, whose edges are none of the graph, in both directions.
        way = _way(graph, edge.end, edge.start)
        if way is None:
            continue
        if edge not in graph.get(edge.start, ()):
            if not way:
                continue  # `a != a` is true of NaN
            other = _way(graph, edge.start, edge.end)
            if other is None:
                continue
            way = (*way, *other)
        return tuple(sorted({edge.constraint, *(step.constraint for step in way)}))
    return ()


def _comparisons(operations: OperationList) -> Iterator[tuple[str, Key, Key]]:
    """Yield the comparisons of two parameters that have to hold."""
    pending = [len(operations.items) - 1]
    while pending:
        operation = operations.items[pending.pop()]
        if operation.name == "and":
            pending += operation.operands
        elif operation.name in SMALLER:
            left, right = (operations.items[o].key for o in operation.operands)
            if left is not None and right is not None:
                yield operation.name, left, right


def _way(graph: Graph, start: Key, end: Key) -> tuple[_Edge, ...] | None:
    """Return the shortest path along edges; `None` if there is none."""
    reached: dict[Key, tuple[_Edge, ...]] = {start: ()}
    queue = deque([start])
    while queue:
        key = queue.popleft()
        if key == end:
            return reached[key]
        for edge in graph.get(key, ()):
            if edge.end not in reached:
                reached[edge.end] = (*reached[key], edge)
                queue.append(edge.end)
    return None

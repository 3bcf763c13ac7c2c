"""Contradictory orders of parameters, `a < b < c < a`, which no interval shows.

Comparisons of two parameters are edges of a graph: from the smaller one to the larger one, both
ways for equal ones. A cycle says that all on it are equal, which `<` and `!=` deny. Only plain
parameters count: `a + 1` may be `a` among floats, and wrap around among integers.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from osc2tx.analysis.operation_list import Key, OperationList
from osc2tx_classes import dataclass

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
    """Return constraints that put parameters in an impossible order; empty if there are none.

    Args:
        expressions: All constraints; the root of each must be true.
        active: Positions of those that count.
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
        # What may not be equal must not be tied from the larger back to the smaller one, and for
        # `!=`, whose edges are none of the graph, in both directions.
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
    """Return the shortest way along edges; `None` if there is none."""
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

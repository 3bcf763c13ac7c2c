"""Propagation of constraints to a fixed point (HC4: forward and backward over each expression).

Sound, not complete: no value that satisfies all constraints is ever excluded, and a contradiction
that is found is one. Not every contradiction is found, and the number of steps is bounded.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field
from functools import partial

from osc2tx.analysis.constraints.alternatives import ALTERNATIVES, narrow_alternatives
from osc2tx.analysis.constraints.backward import narrow
from osc2tx.analysis.constraints.domains import TRUE, Domain, EmptyDomainError, Interval, intersect
from osc2tx.analysis.constraints.forward import evaluate
from osc2tx.analysis.constraints.linear_equations import find_contradiction, linear_solutions
from osc2tx.analysis.constraints.operation_list import Key, OperationList
from osc2tx_shared.classes import dataclass

PASSES = 40  # how often a constraint is visited on average, at most
FREE_PASSES = 4  # from then on only steps that change something visibly are followed
VISIBLE = 1e-6
LARGEST_CORE = 60  # constraints among which a minimal contradiction is searched


@dataclass(frozen=True, slots=True)
class Solution:
    """The state at the fixed point.

    Attributes:
        domains: The possible values of each parameter.
        conflict: Positions of constraints that cannot hold together; empty if none was found.
    """

    domains: Mapping[Key, Domain]
    conflict: tuple[int, ...] = ()


@dataclass(slots=True, eq=False)
class _State:
    expressions: Sequence[OperationList]
    domains: dict[Key, Domain] = field(default_factory=dict)
    reasons: dict[Key, int] = field(default_factory=dict)  # bit sets of constraints
    visits: int = 0


def solve(
    expressions: Sequence[OperationList],
    active: Sequence[int],
    given: Mapping[Key, Domain] | None = None,
) -> Solution:
    """Propagate some constraints of a list.

    Args:
        expressions: All constraints; the root of each is boolean, and must be true.
        active: Positions of the effective ones.
        given: Further known domains of parameters.
    """
    state = _State(expressions, dict(given or {}))
    users: dict[Key, list[int]] = {}
    for index in active:
        for operation in expressions[index].items:
            if operation.key is not None:
                state.domains.setdefault(operation.key, operation.initial)
        for key in expressions[index].keys:
            users.setdefault(key, []).append(index)
    queue = deque(active)
    waiting = set(active)
    limit = PASSES * len(active) + 100
    while queue and state.visits < limit:
        index = queue.popleft()
        waiting.discard(index)
        state.visits += 1
        try:
            changed = _revise(state, index)
        except EmptyDomainError:
            return Solution(state.domains, _positions(_blamed(state, index)))
        done = index if expressions[index].is_plain else None  # it has nothing to add to its own
        _enqueue(queue, waiting, (user for key in changed for user in users[key] if user != done))
        if not queue:
            solved = dict(linear_solutions(expressions, active, state.domains))
            state.domains.update(solved)
            _enqueue(queue, waiting, (user for key in solved for user in users[key]))
    return Solution(state.domains, find_contradiction(expressions, active))


def _enqueue(queue: deque[int], waiting: set[int], users: Iterable[int]) -> None:
    for user in users:
        if user not in waiting:
            waiting.add(user)
            queue.append(user)


def smallest_conflict(
    expressions: Sequence[OperationList], conflict: Sequence[int]
) -> tuple[int, ...]:
    """Drop constraints that a contradiction does not need, the first ones first."""
    core = list(conflict)
    if len(core) > LARGEST_CORE:
        return tuple(core)
    for index in conflict:
        if index not in core or len(core) == 1:
            continue
        found = solve(expressions, [other for other in core if other != index]).conflict
        if found:
            core = [other for other in core if other in found]
    return tuple(core)


def values_on(operations: OperationList, domains: Mapping[Key, Domain]) -> list[Domain]:
    """Return the possible values of each operation of an expression."""
    values: list[Domain] = []
    for operation in operations.items:
        if operation.key is not None:
            values.append(domains.get(operation.key, operation.initial))
        else:
            values.append(evaluate(operation, [values[o] for o in operation.operands]))
    return values


def _revise(state: _State, index: int) -> list[Key]:
    """Narrow parameters by one constraint; return the narrowed ones."""
    operations = state.expressions[index]
    if operations.is_plain and _is_untouched(state, operations):
        return _settle(state, index)
    return _narrowed(state, index, operations)


def _is_untouched(state: _State, operations: OperationList) -> bool:
    """Whether nothing is known yet of the parameters but their types."""
    return all(o.key is None or state.domains[o.key] is o.initial for o in operations.items)


def _settle(state: _State, index: int) -> list[Key]:
    """Narrow a parameter by a simple constraint, whose domain is computed once."""
    operations = state.expressions[index]
    (key,) = operations.keys_in_order
    if operations.alone is None:
        changed = _narrowed(state, index, operations)
        operations.alone = state.domains[key]
        return changed
    if operations.alone is state.domains[key]:
        return []
    state.domains[key] = operations.alone
    state.reasons[key] = 1 << index
    return [key]


def _narrowed(state: _State, index: int, operations: OperationList) -> list[Key]:
    values = values_on(operations, state.domains)
    values[-1] = intersect(values[-1], TRUE)
    _propagate(operations, values, range(len(values)))
    for position, operation in enumerate(operations.items):
        if operation.name in ALTERNATIVES:
            narrow_alternatives(operations.items, position, values, partial(_propagate, operations))
    changed: dict[Key, None] = {}
    for operation, value in zip(operations.items, values, strict=True):
        if operation.key is None:
            continue
        old = state.domains[operation.key]
        new = intersect(old, value)
        if new != old and _counts(state, old, new):
            state.domains[operation.key] = new
            changed[operation.key] = None
    if changed:
        blamed = _blamed(state, index)
        for key in changed:
            state.reasons[key] = blamed
    return list(changed)


def _propagate(operations: OperationList, values: list[Domain], part: range) -> None:
    """Narrow operands by their operations, from the last operation of a part to the first."""
    for position in reversed(part):
        operation = operations.items[position]
        if not operation.operands:
            continue
        operands = [values[o] for o in operation.operands]
        for which, domain in narrow(operation, values[position], operands):
            operand = operation.operands[which]
            values[operand] = intersect(values[operand], domain)


def _blamed(state: _State, index: int) -> int:
    blamed = 1 << index
    for key in state.expressions[index].keys:
        blamed |= state.reasons.get(key, 0)
    return blamed


def _positions(bits: int) -> tuple[int, ...]:
    return tuple(index for index in range(bits.bit_length()) if bits >> index & 1)


def _counts(state: _State, old: Domain, new: Domain) -> bool:
    """Whether a change is worth following; series that creep to a limit are cut off."""
    if state.visits <= FREE_PASSES * len(state.expressions) + 20:
        return True
    if not isinstance(old, Interval) or not isinstance(new, Interval):
        return True
    return any(
        _moved(before, after) for before, after in ((old.lower, new.lower), (old.upper, new.upper))
    )


def _moved(before: float, after: float) -> bool:
    if math.isinf(before) or math.isinf(after):
        return before != after
    return abs(after - before) > VISIBLE * max(abs(before), abs(after))

"""Queries about trees of behavior: members around a member, when they start, what ends them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache

from osc2tx.catalogue import ActionEntry, catalogue
from osc2tx.ir.behaviors import (
    Behavior,
    Call,
    Composition,
    Emit,
    Finish,
    Invoke,
    InvokeScenario,
    On,
    OneOf,
    Parallel,
    Serial,
    Wait,
)
from osc2tx.ir.verify import walk_behaviors


def entry_of(node: Invoke) -> ActionEntry | None:
    """Return the catalogue entry of an action; `None` for one that the scenario declares."""
    return catalogue().actions.get(node.qualified_name)


def invocations(root: Behavior) -> Iterator[Invoke]:
    """Yield the invocations of actions in a behavior, in source order."""
    return (node for node in walk_behaviors(root) if isinstance(node, Invoke))


def predecessor(body: Behavior, node: Invoke) -> Invoke | None:
    """Return the invocation that ends where another one starts; emissions take no time."""
    return _beside(body, node, -1)


def follower(body: Behavior, node: Invoke) -> Invoke | None:
    """Return the invocation that starts where another one ends; emissions take no time."""
    return _beside(body, node, 1)


def _beside(body: Behavior, node: Invoke, way: int) -> Invoke | None:
    for serial in walk_behaviors(body):
        if not isinstance(serial, Serial):
            continue
        members = [each for each in serial.members if not isinstance(each, Emit)]
        for index, each in enumerate(members):
            if each is node:
                found = index + way
                other = members[found] if 0 <= found < len(members) else None
                return other if isinstance(other, Invoke) else None
    return None


def is_first(body: Behavior, node: Invoke | InvokeScenario) -> bool:
    """Whether an invocation begins with the run."""
    match body:
        case Serial(members=members):
            first = next((each for each in members if not isinstance(each, Emit)), None)
            return first is not None and is_first(first, node)
        case Parallel(members=members, start_to_start=None) | OneOf(members=members):
            return any(is_first(each, node) for each in members)
    return body is node


def runs_beside(
    body: Behavior,
    node: Behavior,
    kinds: tuple[type[Parallel | OneOf], ...] = (Parallel, OneOf),
) -> Iterator[Behavior]:
    """Yield the other members of the compositions around a member, which may run while it does."""
    for each in walk_behaviors(body):
        if isinstance(each, kinds) and holds(each, node):
            yield from (member for member in each.members if not holds(member, node))


def holds(body: Behavior, node: Behavior) -> bool:
    """Whether a member is a part of a behavior."""
    return any(each is node for each in walk_behaviors(body))


def is_last(body: Behavior, node: Behavior) -> bool:
    """Whether the run ends with a member."""
    if isinstance(body, Serial) and body is not node:
        members = [each for each in body.members if not isinstance(each, Emit)]
        return bool(members) and is_last(members[-1], node)
    return body is node


def is_timed(node: Behavior) -> bool:
    """Whether a member holds others for a time, and fails if they take longer."""
    match node:
        case Serial() | Parallel() | OneOf() | InvokeScenario():
            return node.duration is not None
        case _:
            return False


def may_be_cut(body: Behavior, label: str) -> bool:
    """Whether a composition around a labelled member may end before the member does."""
    for node in walk_behaviors(body):
        if not isinstance(node, Serial | Parallel | OneOf):
            continue
        is_bounded = bool(node.until) or node.duration is not None or isinstance(node, OneOf)
        inside = (each.label for each in walk_behaviors(node) if each is not node)
        if is_bounded and label in inside:
            return True
    return False


def actors_of(node: Behavior) -> tuple[str, ...]:
    """Return the actors of the actions in a tree, in source order."""
    names = (each.actor_name for each in invocations(node))
    return tuple(dict.fromkeys(name for name in names if name is not None))


def takes_time(node: Invoke) -> bool:
    """Whether an action of the library goes on for some time."""
    entry = entry_of(node)
    return entry is not None and entry.ends in ("goal", "open")


def starts_together(node: Parallel) -> bool:
    """Whether the members of a `parallel` begin when it does, and end when they like."""
    return node.overlap in (None, "start") and not (node.start_to_start or node.end_to_end)


def first_actions(member: Behavior) -> list[Invoke]:
    """Return the actions that begin when a member does, and take time."""
    match member:
        case Serial(members=members):
            return first_actions(members[0])
        case Parallel(members=members) if starts_together(member):
            return [found for each in members for found in first_actions(each)]
        case Invoke() if takes_time(member):
            return [member]
        case _:
            return []


def around(
    body: Behavior, node: Behavior
) -> Iterator[tuple[Composition, Sequence[Behavior], Sequence[Behavior]]]:
    """Yield the compositions around a member, from the inside out.

    Each goes with the members before and after that one, if they follow one another.
    """
    parents = _parents(body)
    while (parent := parents.get(id(node))) is not None:
        members = parent.members if isinstance(parent, Serial) else (node,)
        index = next(i for i, each in enumerate(members) if each is node)
        yield parent, members[:index], members[index + 1 :]
        node = parent


@lru_cache(maxsize=16)  # of a scenario and those that it invokes
def _parents(body: Behavior) -> Mapping[int, Composition]:
    """Return the composition that each member stands in, by the id of the member."""
    return {
        id(member): each
        for each in walk_behaviors(body)
        if isinstance(each, Serial | Parallel | OneOf)
        for member in each.members
    }


def starts_at_once(node: Behavior) -> bool:
    """Whether all actions in a member start when it does: nothing in it is left to be stopped."""
    match node:
        case Parallel(overlap=None, start_to_start=None, end_to_end=None, members=members):
            return all(map(starts_at_once, members))
        case Invoke():
            return True
        case _:
            return False


def is_single(node: Behavior) -> bool:
    """Whether nothing has to be stopped but one action: a leaf, or waits before and after it."""
    return _leaves(node) <= 1


def _leaves(node: Behavior) -> int:
    match node:
        case Parallel(members=members) if len(members) > 1:
            return 2
        case Serial(members=members) | Parallel(members=members) | OneOf(members=members):
            return sum(_leaves(member) for member in members)
        case Wait():
            return 0
        case Invoke():
            return 1
        case Emit() | Finish() | Call() | On() | InvokeScenario():
            return 2

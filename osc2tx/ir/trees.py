"""Queries about trees of behavior: members before, after, beside and around a member."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.ir.behaviors import Behavior, Emit, Invoke, InvokeScenario, OneOf, Parallel, Serial
from osc2tx.ir.verify import walk_behaviors


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

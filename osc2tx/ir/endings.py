"""Queries about trees of behavior: how members end."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.catalogue import catalogue
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
from osc2tx.ir.trees import around, entry_of, starts_together
from osc2tx_shared.rules.endings import (
    Enclosing,
    Ending,
    ending_of_one_of,
    ending_of_parallel,
    ending_of_serial,
    keeps_goals,
)


def is_instant(node: Behavior) -> bool:
    """Whether a member takes no time."""
    return _ending_of(node) == "instant"


def is_open(node: Behavior, *, is_planned: bool = False) -> bool:
    """Whether a member continues until its surroundings end it.

    Args:
        node: The member.
        is_planned: A duration around it states when it ends; its goals are reached then.
    """
    return _ending_of(node, is_planned=is_planned) == "open"


def _ending_of(node: Behavior, *, is_planned: bool = False) -> Ending:
    match node:
        case Emit() | Finish() | Call() | On():
            return "instant"
        case InvokeScenario() | Wait():
            return "bounded"
    if node.duration is not None or node.until:
        return "bounded"
    match node:
        case Invoke():
            return _ending_of_action(node, is_planned=is_planned)
        case Serial(members=members):
            return ending_of_serial(_ending_of(each, is_planned=is_planned) for each in members)
        case Parallel(members=members):
            return ending_of_parallel(_ending_of(each, is_planned=is_planned) for each in members)
        case OneOf(members=members):
            return ending_of_one_of(_ending_of(each, is_planned=is_planned) for each in members)


def _ending_of_action(node: Invoke, *, is_planned: bool) -> Ending:
    entry = entry_of(node)
    if entry is not None and entry.ends == "instant":
        return "instant"
    is_endless = entry is not None and entry.ends == "open"
    return "open" if is_endless and (is_planned or not goals_of(node)) else "bounded"


def ends_with_open(node: Composition, *, is_fixed: bool = False) -> bool:
    """Whether a composition ends with its open-ended last members.

    Args:
        node: The composition.
        is_fixed: Its duration is a single number.
    """
    if isinstance(node, Parallel) and starts_together(node):
        kinds = [_ending_of(member, is_planned=True) for member in node.members]
        return is_fixed or ending_of_parallel(kinds) == "open"
    return isinstance(node, Serial)


def goals_of(node: Invoke) -> tuple[str, ...]:
    """Return the names of the modifiers that state a goal, with which an action may end."""
    modifiers = catalogue().modifiers
    return tuple(
        call.name
        for call in node.modifiers
        if call.at == "end" or (call.name in modifiers and modifiers[call.name].bounds)
    )


def lasts_until_event(body: Behavior, node: Invoke) -> bool:
    """Whether an action of a body keeps its goals, once reached, until an `until` ends it."""
    entry = entry_of(node)
    is_endless = entry is not None and entry.ends == "open" and node.duration is None
    return is_endless and keeps_goals(goals_of(node), _enclosing(body, node))


def _enclosing(body: Behavior, node: Invoke) -> Iterator[Enclosing]:
    if node.until:
        yield "until"
    for parent, _, after in around(body, node):
        is_same = parent.duration is None and not after and ends_with_open(parent)
        yield "same end" if is_same else "other"
        if parent.until:
            yield "until"

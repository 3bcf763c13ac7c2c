"""Queries about `one_of`: which members are drawn before the run (§7.3.13.3)."""

from __future__ import annotations

from itertools import combinations

from osc2tx.catalogue import catalogue
from osc2tx.ir.behaviors import Behavior, Invoke, OneOf
from osc2tx.ir.expressions import FieldRef
from osc2tx.ir.trees import entry_of, first_actions


def is_drawn(node: OneOf, policy: str) -> bool:
    """Whether one member is drawn before the run.

    In a race it is if each two members control the same of an actor from the start.
    """
    if policy == "race":
        pairs = _rivalries(node)
        return bool(pairs) and all(pairs)
    return policy == "seeded"


def is_partly_drawn(node: OneOf, policy: str) -> bool:
    """Whether some members of a race are drawn, and others take part in any case."""
    pairs = _rivalries(node)
    return policy == "race" and any(pairs) and not all(pairs)


def _rivalries(node: OneOf) -> list[bool]:
    """Return for each two members whether both control the same of an actor at first."""
    claims = map(_claims_at_once, node.members)
    return [bool(one & other) for one, other in combinations(claims, 2)]


def _claims_at_once(member: Behavior) -> set[tuple[str, str]]:
    """Return the actors and slots that a member controls from the start."""
    return {
        (action.actor.name, slot)
        for action in first_actions(member)
        if isinstance(action.actor, FieldRef)
        for slot in _slots(action)
    }


def _slots(action: Invoke) -> set[str]:
    entry, known = entry_of(action), catalogue().modifiers
    slots = set(() if entry is None else entry.slots)
    return slots.union(*(known[call.name].slots for call in action.modifiers if call.name in known))

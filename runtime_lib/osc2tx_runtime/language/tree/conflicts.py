"""Detection of conflicts: two actions that control the same quantity at one instant.

Claims are checked at the end of an instant, so a hand-over from one action to the next is silent,
whatever the order of the visit; effects of an instant are checked when they are applied.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from osc2tx_runtime.errors import SlotConflict
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.slots import Owner
from osc2tx_runtime.language.tree.base import Behaviour, place_key
from osc2tx_runtime.language.tree.compositions import Serial
from osc2tx_runtime.language.tree.invocation import started_at_once
from osc2tx_runtime.language.tree.one_of import OneOf


def check_claims(context: ExecutionContext) -> None:
    """Check the claims of a settled instant.

    Raises:
        SlotConflict: Two actions control the same quantity.
    """
    for (actor_id, slot), owners in context.slots.contested():
        raise conflict(f"the {slot} slot of {actor_id}", owners)
    for (actor_id, slot), *both in context.slots.passed():
        if not in_sequence(*both):
            raise conflict(f"the {slot} slot of {actor_id}", both)


def check_effects(context: ExecutionContext) -> None:
    """Check the effects to apply.

    Raises:
        SlotConflict: Parallel actions request different values of one quantity.
    """
    found = [
        (place_key(one.owner), place_key(other.owner), key, one.owner, other.owner)
        for key, one, other in context.effects.contested()
        if not in_sequence(one.owner, other.owner)
    ]
    if found:  # sorted by position, so that the report does not depend on the order of the visit
        *_, key, one, other = min(found, key=lambda each: (each[2], *sorted(each[:2])))
        raise conflict(" ".join(key), [one, other])


def conflict(what: str, owners: Sequence[Owner]) -> SlotConflict:
    """Return the error that names two owners and their positions, in the order of the source."""
    first, second = sorted(owners, key=place_key)[:2]
    return SlotConflict(
        f"{first.name} ({first.source}) and {second.name} ({second.source}) control {what}"
        f" at the same time; {remedy(first, second)}",
        second.source or None,
    )


def remedy(one: Owner, other: Owner) -> str:
    """Return a remedy for two nodes that must not run at the same time."""
    if isinstance(nearest_above(one, other), OneOf):
        return "all members of a race run: let `--one-of first` or `seeded` choose one of them"
    return "let them run one after the other"


def find_rivals(race: OneOf) -> dict[Behaviour, set[Behaviour]]:
    """Return for each alternative those that control a slot of the same actor from the start.

    They exclude each other: exactly one alternative is invoked (§7.3.13.3).
    """
    claims = [(member, {*_claims_at_once(member)}) for member in race.children]
    rivals: dict[Behaviour, set[Behaviour]] = {}
    for (one, first), (other, second) in combinations(claims, 2):
        if first & second:
            rivals.setdefault(one, set()).add(other)
            rivals.setdefault(other, set()).add(one)
    return rivals


def _claims_at_once(member: Behaviour) -> Iterator[tuple[object, str]]:
    for node, at_once in started_at_once(member, race=True):
        if at_once and isinstance(node, Action):
            yield from ((node.actor, slot) for slot in node.slots)


def in_sequence(one: Owner, other: Owner) -> bool:
    """Return whether a serial composition orders the two nodes."""
    return isinstance(nearest_above(one, other), Serial)


def nearest_above(one: Owner, other: Owner) -> Behaviour | None:
    """Return the innermost common ancestor of two nodes."""
    above = []
    node = one.parent
    while node is not None:
        above.append(node)
        node = node.parent
    node = other.parent
    while node is not None and node not in above:
        node = node.parent
    return node

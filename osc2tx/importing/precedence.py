"""Which steps end or replace others."""

from __future__ import annotations

from collections.abc import Hashable, Iterator

from osc2tx.importing.steps import Block, Step


def moment(step: Step) -> Hashable:
    """Return what is the same for steps that start at once, by their last triggers."""
    return step.act, tuple(
        tuple(
            (each.kind, each.text, each.edge, each.element, each.state, each.quantity)
            for each in group
        )
        for group in step.trigger.groups
    )


def replaces_at_once(later: Step, earlier: Step) -> bool:
    """Whether a step takes over the motion from an earlier one without duration, on one trigger."""
    if isinstance(later, Block) or isinstance(earlier, Block) or later.act != earlier.act:
        return False
    if later.before:  # another execution waits for its trigger anew
        return False
    return (
        bool(later.slots & earlier.slots)
        and all(each.statement.length == 0.0 for each in earlier.effects)
        and not later.trigger.is_immediate
        and later.trigger.groups == earlier.trigger.groups
    )


def below(step: Step) -> Iterator[Step]:
    """Yield a step and those that follow it."""
    left = [step]
    while left:
        at = left.pop()
        yield at
        left += reversed(at.successors)


def conflict(one: Step, other: Step) -> bool:
    """Whether steps, or those that follow them, may end each other."""
    return any(_conflict_of(a, b) for a in below(one) for b in below(other))


def _conflict_of(a: Step, b: Step) -> bool:
    return breaks_off(a, b) or breaks_off(b, a)


def breaks_off(later: Step, earlier: Step) -> bool:
    """Whether a step that starts ends one that has started before, if that still runs."""
    if later.slots & earlier.slots:
        return True
    is_beside = later.overrides and later.maneuver == earlier.maneuver
    return is_beside and bool(later.actors & earlier.actors)

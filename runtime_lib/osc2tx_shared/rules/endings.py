"""How members end, and when actions keep what they have reached (§7.6.2.1, §7.6.2.5.4).

The compiler applies these rules to the trees that it writes, the runtime to those that it runs.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal, TypeAlias

Ending: TypeAlias = Literal["instant", "bounded", "open"]
"""A member takes no time, ends by itself, or continues until its surroundings end it."""

Enclosing: TypeAlias = Literal["until", "same end", "other"]
"""What is around a member: an `until`, a composition that ends when the member does, or else."""

HELD_GOALS = frozenset({"change_lane", "change_speed", "lane", "lateral", "speed"})
"""Modifiers whose value at the end an actor keeps once it is reached; a place is passed."""


def ending_of_serial(members: Iterable[Ending]) -> Ending:
    """Return how members end that follow one another: as the last one does."""
    kinds = list(members)
    if all(kind == "instant" for kind in kinds):
        return "instant"
    return "open" if kinds[-1] == "open" else "bounded"


def ending_of_parallel(members: Iterable[Ending]) -> Ending:
    """Return how members end together: those of zero time do not count (§7.6.2.1)."""
    kinds = set(members) - {"instant"}
    if not kinds:
        return "instant"
    return "open" if kinds == {"open"} else "bounded"


def ending_of_one_of(members: Iterable[Ending]) -> Ending:
    """Return how a race ends: with the first member that does."""
    kinds = set(members)
    return kinds.pop() if len(kinds) == 1 else "bounded"


def keeps_goals(goals: Iterable[str], around: Iterable[Enclosing]) -> bool:
    """Return whether an action keeps its goals, once reached, until an event (§7.6.2.5.4).

    An `until` ends what it is stated for exactly at its event, not before.

    Args:
        goals: The modifiers that state a goal of an open-ended action without a duration.
        around: What is around the action, from the inside out.
    """
    names = set(goals)
    if not names or not names <= HELD_GOALS:
        return False
    return next((each for each in around if each != "same end"), "other") == "until"

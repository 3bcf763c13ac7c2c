"""The duration with which an action ends, or has to end: that of the enclosing composition.

In `parallel(duration: 8s)` open-ended members end after 8 s, independent of the others; their `at:
end` has to hold then. Members with a goal have at most 8 s.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.tree import Parallel, Serial, Until
from osc2tx_runtime.language.tree.members import is_instant, is_open, is_service, length_of
from osc2tx_shared.rules.endings import (
    Enclosing,
    Ending,
    ending_of_parallel,
    ending_of_serial,
    keeps_goals,
)

if TYPE_CHECKING:
    from osc2tx_runtime.language.tree import Behaviour
    from osc2tx_runtime.language.tree.duration_limits import DurationLimits


def phase_of(action: BaseAction, *, strict: bool) -> DurationLimits | None:
    """The duration with which an open-ended action ends; None if it is unknown in advance.

    Args:
        action: The action.
        strict: Whether durations are met exactly, not at the latest.
    """
    if action.registered.ends != "open" or action.duration is not None:
        return None
    node: Behaviour = action
    while isinstance(node.parent, Serial | Parallel):
        parent = node.parent
        if isinstance(parent, Serial) and parent.children[-1] is not node:
            return None
        limits = parent.limits
        fixed = limits is not None and limits.fixed is not None and strict
        if isinstance(parent, Parallel) and not (_is_plain(parent) if fixed else _all_open(parent)):
            return None
        if limits is not None:
            return limits if limits.fixed is not None else None
        node = parent
    return None


def lasts_until_event(action: BaseAction, goals: Sequence[Modifier], *, strict: bool) -> bool:
    """Whether an action holds its goal until an `until` ends it, not before (DSL 7.6.2.5.4).

    The `until` is its own, or that of a composition that ends with it. A place or a distance is
    passed, so it ends the action.

    Args:
        action: The action.
        goals: Its modifiers that state a goal.
        strict: Whether the `until` is met exactly, not at the latest.
    """
    is_open = action.registered.ends == "open" and action.duration is None
    return strict and is_open and keeps_goals((each.name for each in goals), _enclosing(action))


def _enclosing(node: Behaviour) -> Iterator[Enclosing]:
    """Yield what is around a node, from the inside out."""
    while (parent := node.parent) is not None:
        yield "until" if isinstance(parent, Until) else _ends_with(parent, node)
        node = parent


def _ends_with(parent: Behaviour, node: Behaviour) -> Enclosing:
    if not isinstance(parent, Serial | Parallel) or parent.limits is not None:
        return "other"
    is_last = parent.children[-1] is node if isinstance(parent, Serial) else _all_open(parent)
    return "same end" if is_last else "other"


def most_steps(action: BaseAction) -> float | None:
    """The steps that a duration around an action leaves it to reach its goal; may be infinite.

    Members after it in a `serial` need their lengths; open-ended ones have a step, which is the
    least that they can take.

    Args:
        action: The action.

    Returns:
        None if it has its own duration, or if other members have to follow before the end.
    """
    if action.registered.ends != "goal" or action.duration is not None:
        return None
    node: Behaviour = action
    following = 0.0
    while isinstance(node.parent, Serial | Parallel):
        parent = node.parent
        if isinstance(parent, Serial):
            after = parent.children[parent.children.index(node) + 1 :]
            following += sum(map(_least_steps, after))
            if math.isinf(following):
                return None
        elif not _is_plain(parent):
            return None
        if parent.limits is not None:
            return parent.limits.most_left - following
        node = parent
    return None


def _least_steps(node: Behaviour) -> float:
    """The steps that a member needs; infinite if only the run shows them."""
    if is_instant(node):
        return 0.0
    if isinstance(node, BaseAction) and _ending_of(node) == "open":
        return math.inf if getattr(node, "has_goal", False) else 1.0
    length = None if is_open(node) else length_of(node)
    return math.inf if length is None else float(length)


def _is_plain(parallel: Parallel) -> bool:
    """Whether all members start and end with the composition."""
    simple = parallel.overlap == "start" and parallel.end_to_end is None
    return simple and not parallel.start_to_start


def _all_open(parallel: Parallel) -> bool:
    """Whether all members are open-ended."""
    return _is_plain(parallel) and ending_of_parallel(map(_ending_of, parallel.children)) == "open"


def _ending_of(node: Behaviour) -> Ending:
    """Return how a member ends if a duration around it states when, and goals are reached then."""
    if is_instant(node) or is_service(node):
        return "instant"
    if isinstance(node, BaseAction):
        goes_on = node.registered.ends == "open" and node.duration is None
        return "open" if goes_on and not getattr(node, "follows_path", False) else "bounded"
    if isinstance(node, Serial) and node.limits is None:
        return ending_of_serial(map(_ending_of, node.children))
    if isinstance(node, Parallel) and node.limits is None and _is_plain(node):
        return ending_of_parallel(map(_ending_of, node.children))
    return "bounded"

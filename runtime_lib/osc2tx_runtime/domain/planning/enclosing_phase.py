"""The duration with which an action ends, or has to end: that of the enclosing composition.

In `parallel(duration: 8s)` open-ended members end after 8 s, independent of the others; their `at:
end` has to hold then. Members with a goal have at most 8 s.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.tree import Parallel, Serial, Until
from osc2tx_runtime.language.tree.base import Node
from osc2tx_shared.rules.combinations import HELD_GOALS

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

    The `until` is its own, or that of a serial of which it is the last member. A place or a
    distance is passed, so it ends the action.

    Args:
        action: The action.
        goals: Its modifiers that state a goal.
        strict: Whether the `until` is met exactly, not at the latest.
    """
    is_open = action.registered.ends == "open" and action.duration is None
    is_held = bool(goals) and all(each.name in HELD_GOALS for each in goals)
    if not (strict and is_open and is_held):
        return False
    node: Behaviour = action
    while isinstance(parent := node.parent, Serial):
        if parent.limits is not None or parent.children[-1] is not node:
            return False
        node = parent
    return isinstance(node.parent, Until)


def limit_of(action: BaseAction) -> DurationLimits | None:
    """The duration around an action in which it has to reach its goal.

    Args:
        action: The action.

    Returns:
        None if it has its own duration, or if further members have to follow before the end.
    """
    if action.registered.ends != "goal" or action.duration is not None:
        return None
    node: Behaviour = action
    while isinstance(node.parent, Serial | Parallel):
        parent = node.parent
        if isinstance(parent, Serial):
            after = parent.children[parent.children.index(node) + 1 :]
            if not all(isinstance(each, Node) and each.instant for each in after):
                return None
        elif not _is_plain(parent):
            return None
        if parent.limits is not None:
            return parent.limits
        node = parent
    return None


def _is_plain(parallel: Parallel) -> bool:
    """Whether all members start and end with the composition."""
    simple = parallel.overlap == "start" and parallel.end_to_end is None
    return simple and not parallel.start_to_start


def _all_open(parallel: Parallel) -> bool:
    """Whether all members are open-ended."""
    return _is_plain(parallel) and all(map(_is_open, parallel.children))


def _is_open(node: Behaviour) -> bool:
    if isinstance(node, BaseAction):
        ends = node.registered.ends
        goes_on = node.duration is None and not getattr(node, "follows_path", False)
        return ends == "instant" or (ends == "open" and goes_on)
    if isinstance(node, Serial) and node.limits is None:
        return _is_open(node.children[-1]) if node.children else False
    return isinstance(node, Parallel) and node.limits is None and _all_open(node)

"""Durations of what never ends by itself: a range is a parameter like any other (§7.3.5.1.3).

What ends by itself, or with an `until`, takes the time it takes; there a range only bounds it.
"""

from __future__ import annotations

from typing import TypeVar

from osc2tx import ir
from osc2tx.catalogue import catalogue
from osc2tx.lowering.context import LoweringContext
from osc2tx_classes import replace

__all__ = ["is_open_ended", "with_open_duration"]

Member = TypeVar("Member", bound=ir.Serial | ir.OneOf | ir.Parallel | ir.Invoke)


def with_open_duration(ctx: LoweringContext, node: Member, name: str) -> Member:
    """Return a member whose duration is drawn from its range, if nothing else ends the member.

    Args:
        ctx: The scenario.
        node: The member.
        name: Of the parameter.
    """
    duration = node.duration
    if node.until or not isinstance(duration, ir.RangeValue):
        return node
    if not is_open_ended(replace(node, duration=None)):
        return node
    drawn = ctx.draw(name, duration, duration.lower.type)
    return replace(node, duration=drawn)


def is_open_ended(node: ir.Behavior) -> bool:
    """Return whether a member never ends by itself."""
    match node:
        case ir.Serial(members=members):
            return not _is_bounded(node) and is_open_ended(members[-1])
        case ir.OneOf(members=members):
            return not _is_bounded(node) and all(map(is_open_ended, members))
        case ir.Parallel(members=members):
            lasting = [member for member in members if not _is_instant(member)]
            return not _is_bounded(node) and bool(lasting) and all(map(is_open_ended, lasting))
        case ir.Invoke():
            return not _is_bounded(node) and _ends(node) == "open" and not _has_goal(node)
        case _:
            return False


def _is_bounded(node: ir.Serial | ir.Parallel | ir.OneOf | ir.Invoke) -> bool:
    return node.duration is not None or bool(node.until)


def _is_instant(node: ir.Behavior) -> bool:
    match node:
        case ir.Emit() | ir.Call() | ir.On():
            return True
        case ir.Invoke():
            return node.duration is None and _ends(node) == "instant"
        case _:
            return False


def _ends(node: ir.Invoke) -> str:
    entry = catalogue().actions.get(node.qualified_name)
    return "" if entry is None else entry.ends


def _has_goal(node: ir.Invoke) -> bool:
    """Whether a modifier says what is to be reached, so that the action may end with it."""
    modifiers = catalogue().modifiers
    return any(
        call.at == "end" or (call.name in modifiers and modifiers[call.name].bounds)
        for call in node.modifiers
    )

"""How long members take, and when they begin, as far as that is known before the run."""

from __future__ import annotations

from math import inf

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.values.constants import Bounds
from osc2tx.losses.entries import Inexpressible
from osc2tx_shared.classes import replace

SLACK = 1e-9  # s


def length_of(ctx: Context, node: ir.Behavior) -> float | None:
    """Return how long (s) a member takes; `None` if only the run shows it."""
    match node:
        case ir.Serial() | ir.Parallel() | ir.OneOf() | ir.Invoke() if node.until:
            return None
        case ir.Serial() | ir.Parallel() | ir.OneOf() | ir.Invoke() if node.duration is not None:
            try:
                value = ctx.values.of(node.duration)
            except Inexpressible:
                return None
            return None if isinstance(value, Bounds) else ctx.values.number(node.duration)
        case ir.Wait(trigger=ir.Trigger(event=None, condition=ir.Elapsed(duration=duration))):
            return ctx.values.number(duration)
        case ir.Serial(members=members):
            lengths = [length_of(ctx, member) for member in members]
            return None if None in lengths else sum(filter(None, lengths))
        case ir.Parallel(members=members) if node.overlap in (None, "start"):
            lengths = [
                (least_length if ir.is_open(member) else length_of)(ctx, member)
                for member in members
            ]
            return None if None in lengths else max(filter(None, lengths), default=0.0)
        case _ if ir.is_instant(node):
            return 0.0
    return None


def least_length(ctx: Context, node: ir.Behavior) -> float | None:
    """Return how long (s) an open-ended member takes at least; `None` if only the run shows it."""
    match node:
        case ir.Serial(members=(*before, last)):
            lengths = [*(length_of(ctx, member) for member in before), least_length(ctx, last)]
            return None if None in lengths else sum(filter(None, lengths))
        case ir.Parallel(members=members):
            lengths = [least_length(ctx, member) for member in members]
            return None if None in lengths else max(filter(None, lengths), default=0.0)
        case ir.OneOf(members=members):
            lengths = [least_length(ctx, member) for member in members]
            return None if None in lengths else min(length or 0.0 for length in lengths)
    return 0.0


def length_at_least(ctx: Context, node: ir.Behavior) -> float:
    """Return how long (s) a member surely takes."""
    length = length_of(ctx, node)
    if length is not None:
        return length
    match node:
        case ir.Serial(members=members, until=()):
            return sum(length_at_least(ctx, member) for member in members)
        case ir.Parallel(members=members, until=()):
            timed = [member for member in members if not ir.is_open(member)]
            return max((length_at_least(ctx, member) for member in timed), default=0.0)
        case ir.OneOf(members=members, until=()):
            return min(length_at_least(ctx, member) for member in members)
    return 0.0


def takes(length: float, duration: tuple[float, float]) -> bool:
    """Whether a length (s) lies within a duration, given by its least and most seconds."""
    low, high = duration
    return low - SLACK <= length <= high + SLACK


def fitting(ctx: Context, node: ir.OneOf) -> ir.OneOf:
    """Return a race without the members that cannot take its duration: no run starts them."""
    if node.duration is None or ctx.module.dialect == "carla":
        return node
    duration = ctx.values.bounds(node.duration)
    lengths = [None if ir.is_open(each) else length_of(ctx, each) for each in node.members]
    members = tuple(
        member
        for member, length in zip(node.members, lengths, strict=True)
        if length is None or takes(length, duration)
    )
    return replace(node, members=members) if 0 < len(members) < len(node.members) else node


def may_end_after(ctx: Context, node: ir.Behavior, time: float) -> bool:
    """Whether its surroundings surely may end a member at a time (s) after its start.

    An alternative without an end lets them end the whole race.
    """
    if isinstance(node, ir.Composition) and (node.until or node.duration is not None):
        return False
    match node:
        case ir.Serial(members=(*before, last)):
            lengths = [length_of(ctx, member) for member in before]
            passed = inf if None in lengths else sum(filter(None, lengths))
            return may_end_after(ctx, last, time - passed)
        case ir.Parallel(members=members) if ir.starts_together(node):
            lasting = [member for member in members if not ir.is_instant(member)]
            return bool(lasting) and all(may_end_after(ctx, each, time) for each in lasting)
        case ir.OneOf(members=members) if not ir.is_drawn(node, ctx.module.one_of):
            return any(may_end_after(ctx, member, time) for member in members)
        case ir.Invoke():
            return ir.is_open(node) and time >= 0.0
    return False


def begin_of(ctx: Context, node: ir.Behavior) -> float | None:
    """Return when (s) a member of the scenario begins; `None` if only the run shows it."""
    begin = 0.0
    for parent, before, _ in ir.around(ctx.scenario.body, node):
        if isinstance(parent, ir.Parallel) and not ir.starts_together(parent):
            return None
        for member in before:
            length = length_of(ctx, member)
            if length is None:
                return None
            begin += length
    return begin

"""Start times of the members of a `parallel` (§7.3.13.2) that are known before the run."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts.run_options import plan_starts
from osc2tx.backends.xosc.flattening.tree_queries import entry_of, is_instant
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.values.constants import Bounds


def starts_of(ctx: Context, node: ir.Parallel) -> list[float | None]:
    """Return the start (s) of each member after that of the composition.

    `None`: it starts when the first member ends.

    Raises:
        Inexpressible: It depends on lengths that only the run shows.
    """
    if node.overlap in (None, "start", "any") and not (node.start_to_start or node.end_to_end):
        return [0.0] * len(node.members)
    timed = [member for member in node.members if not is_instant(member)]
    parts = [(member.name, length_of(ctx, member), is_open(member)) for member in timed]
    overlap = node.overlap or ("any" if node.start_to_start else "start")
    planned = plan_starts(
        parts, overlap, _bounds(ctx, node.start_to_start), _bounds(ctx, node.end_to_end), node.span
    )
    by_member = dict(zip(map(id, timed), planned, strict=True))
    return [by_member.get(id(member), 0.0) for member in node.members]


def _bounds(ctx: Context, expression: ir.Expression | None) -> tuple[float, float] | None:
    if expression is None:
        return None
    value = ctx.values.of(expression)
    if isinstance(value, Bounds):
        return value.lower, value.upper
    number = ctx.values.number(expression)
    return number, number


def is_open(node: ir.Behavior) -> bool:
    """Whether a member goes on for as long as one likes."""
    match node:
        case ir.Invoke():
            entry = entry_of(node)
            is_endless = entry is not None and entry.ends == "open"
            return is_endless and node.duration is None and not node.until
        case ir.Serial(members=members):
            return not node.until and node.duration is None and is_open(members[-1])
        case ir.Parallel(members=members) | ir.OneOf(members=members):
            return not node.until and node.duration is None and all(map(is_open, members))
        case _:
            return False


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
            lengths = [length_of(ctx, member) for member in members if not is_open(member)]
            return None if None in lengths else max(filter(None, lengths), default=0.0)
        case _ if is_instant(node):
            return 0.0
    return None

"""Reactions to a period (`on every`): an event that starts again and again.

A variable goes up and down, half a period each: each edge is what the other one waits for. A level
would not do, for tools differ in what a delay does to a condition that stays true.
"""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.conditions.flow import Flow, Test, single
from osc2tx.backends.xosc.flattening.storyboard_builder import StoryboardBuilder
from osc2tx.backends.xosc.report import GENERIC, Inexpressible
from osc2tx.backends.xosc.xml.tree import Element
from osc2tx_classes import replace

MANY_TIMES = 1000000
"""Executions of an event that may start again for as long as its act runs."""


def react_periodically(
    builder: StoryboardBuilder,
    node: ir.On,
    every: ir.Every,
    start: Flow,
    actions: tuple[Element, ...],
) -> None:
    """Write down what is done at the start and in each period after it."""
    ctx = builder.ctx
    if not ctx.profile.has_edges:
        reason = f"{ctx.profile.name} does not start an event again"
        raise Inexpressible(reason, node.span, GENERIC)
    period = ctx.values.number(every.period)
    begin = start.later(0.0 if every.offset is None else ctx.values.number(every.offset))
    pulse = ctx.names.new("pulse")
    up = (*actions, ctx.mark(pulse))
    emitted = dict.fromkeys(r.event.name for r in node.reactions if isinstance(r, ir.Emit))
    down = (*(builder.events.setting(name, "false") for name in emitted),)
    down = (*down, ctx.set_variable(pulse, "false"))
    is_up = Test(ctx.variable_is(pulse, "equalTo", "true"), delay=0.5 * period)
    # The first look of an event sees no edge, so it has to come before the first occurrence.
    half, full = replace(is_up, edge="rising"), replace(is_up, edge="falling")
    builder.add(ctx.names.new("half_time"), down, single(half), repeats=MANY_TIMES)
    builder.add(ctx.names.new("first_time"), up, begin)
    builder.add(ctx.names.new("every_time"), up, single(full), repeats=MANY_TIMES)

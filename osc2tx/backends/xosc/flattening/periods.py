"""Reactions to a period (`on every`): an event that starts again and again.

It waits for a period in its own standby state, so each round begins when the one before is over:
one step later in tools that see a change of state in the next step.
"""

from __future__ import annotations

from dataclasses import replace

from osc2tx import ir
from osc2tx.backends.xosc.conditions.flow import Flow, Test, single, state_of
from osc2tx.backends.xosc.flattening.storyboard_builder import StoryboardBuilder
from osc2tx.backends.xosc.report import Inexpressible, Remedy
from osc2tx.backends.xosc.xml.tree import Element

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
        raise Inexpressible(reason, node.span, Remedy(profile="generic"))
    period = ctx.values.number(every.period)
    begin = start.later(0.0 if every.offset is None else ctx.values.number(every.offset))
    # The first look of an event sees no edge, so it has to come before the first occurrence.
    for emitted in dict.fromkeys(r.event.name for r in node.reactions if isinstance(r, ir.Emit)):
        is_set = ctx.variable_is(builder.events.variable(emitted), "equalTo", "true")
        halfway = replace(Test(is_set, "rising"), delay=0.5 * period)
        reset = (builder.events.setting(emitted, "false"),)
        builder.add(ctx.names.new(f"after_{emitted}"), reset, single(halfway), repeats=MANY_TIMES)
    done = builder.add(ctx.names.new("first_time"), actions, begin)
    name = ctx.names.new("every_time")
    again = single(state_of("event", name, "standbyState")) & done
    builder.add(name, actions, again.later(period), repeats=MANY_TIMES)

"""Directives: `emit`, `call`, `on`, the end of the scenario."""

from __future__ import annotations

from dataclasses import replace

from osc2tx import ir
from osc2tx.backends.xosc.actions.behavioral_models import no_model
from osc2tx.backends.xosc.actions.user_actions import command_of
from osc2tx.backends.xosc.conditions.flow import NEVER, Edge, Flow
from osc2tx.backends.xosc.flattening.event_parameters import carried
from osc2tx.backends.xosc.flattening.periods import MANY_TIMES, react_periodically
from osc2tx.backends.xosc.flattening.storyboard_builder import Loom
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.xml.names import plain
from osc2tx.backends.xosc.xml.tree import element

VERDICT = "verdict"
"""Name of the monitor that says whether the scenario has succeeded."""

OPPOSITE: dict[Edge, Edge] = {"rising": "falling", "falling": "rising", "none": "none"}


def emit(loom: Loom, node: ir.Emit, start: Flow) -> Flow:
    """Let an event occur; return when it has."""
    ctx, events = loom.ctx, loom.events
    name = ctx.names.new(f"emit_{ctx.scope.prefix}{node.event.name}")
    setting = events.setting(node.event.name)
    done = loom.add(name, (*carried(ctx, node), setting), start, actor=loom.voice)
    if events.is_emitted_often(node.event):  # the next occurrence needs an edge of its own
        reset = events.setting(node.event.name, "false")
        loom.add(ctx.names.new(f"after_{name}"), (reset,), done)
    else:
        done = loom.is_set(events.variable(node.event.name))
    ctx.report.exact("emit", node.span)
    return loom.ended(node, start if start.is_latched else done)


def call(loom: Loom, node: ir.Call, start: Flow) -> Flow:
    """Give the tool a command; nothing waits for its end, for tools do not tell it."""
    ctx = loom.ctx
    ctx.require_support("CustomCommandAction", node.span)
    called = node.call
    if not isinstance(called, ir.MethodCall):
        raise Inexpressible("only methods are called", node.span)
    if called.method == "set_bm" and called.owner == "physical_object":
        raise no_model("another behavioral model", node.span)
    arguments = {each.parameter: ctx.values.of(each.value) for each in called.arguments}
    name = ctx.names.new(f"call_{plain(called.method)}")
    start = loom.latched(start, name)
    loom.add(name, (command_of(called.method, arguments),), start, actor=loom.voice)
    ctx.report.exact("call", node.span, f"the tool has to know the command `{called.method}`")
    return loom.ended(node, start)


def finish(loom: Loom, node: ir.Finish, start: Flow) -> Flow:
    """Let the scenario end; that it fails is told by a monitor."""
    ctx = loom.ctx
    if not node.succeeds:
        ctx.require("a verdict", "1.3", node.span)
        ctx.require_support("SetMonitorAction", node.span)
        ctx.monitors[VERDICT] = True
        action = element("SetMonitorAction", monitorRef=VERDICT, value=False)
        actions = (element("GlobalAction", action),)
        start = loom.add(ctx.names.new("fail"), actions, start, actor=loom.voice)
    loom.finished = loom.finished | start
    ctx.report.exact("emit end" if node.succeeds else "emit fail", node.span)
    return start


def react(loom: Loom, node: ir.On, start: Flow) -> Flow:
    """Write down reactions as an event that starts again at each occurrence."""
    ctx, events = loom.ctx, loom.events
    emitted, actions = [], []
    for reaction in node.reactions:
        if not isinstance(reaction, ir.Emit):
            raise Inexpressible("only `emit` can react", reaction.span)
        emitted.append(reaction.event.name)
        actions += [*carried(ctx, reaction), events.setting(reaction.event.name)]
    condition = node.trigger.condition
    if isinstance(condition, ir.Every) and node.trigger.event is None:
        react_periodically(loom, node, condition, loom.latched(start, "on"), tuple(actions))
        ctx.report.exact("on", node.span)
        return NEVER
    once = node.trigger.event is not None  # such an event has one edge
    if not once and not isinstance(node.trigger.condition, ir.Edge):
        raise Inexpressible("only an event or an edge can be reacted to", node.span)
    occurs = loom.after(node.trigger, start)
    repeats = None if once else MANY_TIMES
    name = ctx.names.new(f"on_{plain(node.trigger.span.text)}")
    loom.add(name, tuple(actions), occurs, repeats=repeats)
    if not once:  # the opposite edge makes room for the next occurrence
        over = Flow(
            tuple(
                tuple(replace(test, edge=OPPOSITE[test.edge]) for test in group)
                for group in occurs.groups
            )
        )
        reset = tuple(events.setting(event, "false") for event in emitted)
        loom.add(ctx.names.new(f"after_{name}"), reset, over, repeats=repeats)
    ctx.report.exact("on", node.span)
    return NEVER

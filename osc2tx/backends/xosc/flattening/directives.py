"""Directives as events: `emit`, `call`, `on`, the end of the scenario; and global actions."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Globals, Later
from osc2tx.backends.xosc.actions.registry import GLOBAL_ACTIONS
from osc2tx.backends.xosc.actions.signals.vehicle_lights import followed_lights
from osc2tx.backends.xosc.actions.user_actions import command_of, no_model, own_command
from osc2tx.backends.xosc.conditions.event_parameters import set_parameters
from osc2tx.backends.xosc.conditions.flow import NEVER, Edge, Flow, Test, single
from osc2tx.backends.xosc.flattening.builder import RUN_START, StoryboardBuilder, construct_of
from osc2tx.backends.xosc.names import event_name
from osc2tx.losses.entries import GENERIC, Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx.xosc.names import plain
from osc2tx_shared.classes import replace

MANY_TIMES = 1000000
"""Executions of an event that may start again for as long as its act runs."""


def react_periodically(
    builder: StoryboardBuilder,
    node: ir.On,
    every: ir.Every,
    start: Flow,
    actions: tuple[xml.ActionPart, ...],
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
    emitted = dict.fromkeys(ir.emitted_by(node))
    down = (*(builder.events.setting(name, "false") for name in emitted),)
    down = (*down, ctx.set_variable(pulse, "false"))
    is_up = Test(ctx.variable_is(pulse, "equalTo", "true"), delay=0.5 * period)
    # The first look of an event sees no edge, so it has to come before the first occurrence.
    half, full = replace(is_up, edge="rising"), replace(is_up, edge="falling")
    builder.add(ctx.names.new("half_time"), down, single(half), repeats=MANY_TIMES)
    builder.add(ctx.names.new("first_time"), up, begin)
    builder.add(ctx.names.new("every_time"), up, single(full), repeats=MANY_TIMES)


OPPOSITE: dict[Edge, Edge] = {"rising": "falling", "falling": "rising", "none": "none"}


def emit(builder: StoryboardBuilder, node: ir.Emit, start: Flow) -> Flow:
    """Let an event occur; return when it has."""
    ctx, events = builder.ctx, builder.events
    name = ctx.names.new(f"emit_{ctx.scope.prefix}{node.event.name}")
    setting = events.setting(node.event.name)
    done = builder.add(name, (*set_parameters(ctx, node), setting), start, actor=builder.mark_actor)
    if events.occurrences.is_emitted_often(node.event.name):
        # The next occurrence needs an edge of its own.
        reset = events.setting(node.event.name, "false")
        builder.add(ctx.names.new(f"after_{name}"), (reset,), done, actor=builder.mark_actor)
    else:
        done = builder.is_set(events.variable(node.event.name))
    return builder.mark_end(node, start if start.is_latched else done)


def call(builder: StoryboardBuilder, node: ir.Call, start: Flow) -> Flow:
    """Give the tool a command; nothing waits for its end, for tools do not tell it."""
    ctx = builder.ctx
    ctx.require_support("CustomCommandAction")
    called = node.call
    if not isinstance(called, ir.MethodCall):
        raise Inexpressible("only methods are called")
    if called.method == "set_bm" and called.owner == "physical_object":
        raise no_model("another behavioral model", node.span)
    arguments = {each.parameter: ctx.values.of(each.value) for each in called.arguments}
    name = ctx.names.new(f"call_{plain(called.method)}")
    start = builder.latched(start, name)
    builder.add(name, (command_of(called.method, arguments),), start, actor=builder.mark_actor)
    ctx.report.exact("call", node.span, f"the tool has to know the command `{called.method}`")
    return builder.mark_end(node, start)


def finish(builder: StoryboardBuilder, node: ir.Finish, start: Flow) -> Flow:
    """Let the scenario end; that it fails is told by a monitor."""
    ctx = builder.ctx
    if not node.succeeds:
        ctx.require("a verdict", "1.3")
        ctx.require_support("SetMonitorAction")
        start = builder.tell_failure("fail", start)
    elif not builder.is_outermost:  # events that are stopped with their act are complete too
        start = builder.keep(ctx.names.new("finished"), start)
    builder.finished = builder.finished | start
    return start


def react(builder: StoryboardBuilder, node: ir.On, start: Flow) -> Flow:
    """Write down reactions as an event that starts again at each occurrence."""
    ctx, events, actions = builder.ctx, builder.events, []
    for reaction in node.reactions:
        if not isinstance(reaction, ir.Emit):
            raise Inexpressible("only `emit` can react", reaction.span)
        actions += [*set_parameters(ctx, reaction), events.setting(reaction.event.name)]
    trigger = events.as_used(node.trigger)
    condition = trigger.condition
    if isinstance(condition, ir.Every) and trigger.event is None:
        react_periodically(builder, node, condition, builder.latched(start, "on"), tuple(actions))
        return NEVER
    is_time = isinstance(condition, ir.Elapsed) and trigger.event is None
    if trigger.event is None and not is_time and not isinstance(condition, ir.Edge):
        raise Inexpressible("only an event, an edge or a time can be reacted to")
    once = is_time or not events.occurrences.may_recur(trigger)
    occurs = builder.after(trigger, start)
    if not once:
        occurs = _each_time(occurs, start)
    repeats = None if once else MANY_TIMES
    name = ctx.names.new(f"on_{plain(node.trigger.span.text)}")
    builder.add(name, tuple(actions), occurs, repeats=repeats)
    if not once:  # the opposite edge makes room for the next occurrence
        turned = (
            tuple(replace(test, edge=OPPOSITE[test.edge]) for test in group)
            for group in occurs.groups
        )
        over = Flow(tuple(turned))
        reset = tuple(events.setting(event, "false") for event in ir.emitted_by(node))
        builder.add(ctx.names.new(f"after_{name}"), reset, over, repeats=repeats)
    return NEVER


def _each_time(occurs: Flow, start: Flow) -> Flow:
    """Return a flow with an edge in each group: a variable that is set comes and goes."""
    since = {test for group in start.groups for test in group}
    groups = [
        tuple(
            (
                test
                if test in since or any(t.edge != "none" for t in group)
                else replace(test, edge="rising")
            )
            for test in group
        )
        for group in occurs.groups
    ]
    return Flow(tuple(groups))


# --- actions that concern no entity ---------------------------------------------------------------


def invoke_global(builder: StoryboardBuilder, node: ir.Invoke, start: Flow) -> Flow:
    """Write down an action that concerns no entity; at the very start it goes to `Init`."""
    ctx, entry = builder.ctx, ir.entry_of(node)
    actions: Globals = ()
    with ctx.report_as(construct_of(node), node.span):
        arguments = Arguments(ctx, node)
        if entry is None:
            actions = (own_command(ctx, node, arguments),)
        else:
            actions = GLOBAL_ACTIONS[node.action](ctx, node, arguments)
        arguments.finish()
    lasts = entry is None or entry.ends == "open"
    if lasts:
        start = builder.latched(start, builder.name_of(node))
    if node.modifiers or (not lasts and (node.until or node.duration is not None)):
        raise Inexpressible("it takes no time, so it has no duration and no modifiers")
    name = event_name(ctx.scope.deeds, node)
    goal = _act_globally(builder, name, actions, start)
    for actor, lights in followed_lights(ctx).items():
        builder.add(ctx.names.new(f"{actor}_lights_{name}"), lights, start, actor=actor)
    if not lasts:
        return builder.mark_end(node, goal)
    return builder.mark_end(node, builder.limit(node, start))


def _act_globally(builder: StoryboardBuilder, name: str, actions: Globals, start: Flow) -> Flow:
    """Add an event for actions that concern no entity; return when they are done."""
    ctx = builder.ctx
    at_once = tuple(action for action in actions if not isinstance(action, Later))
    later: dict[float, list[xml.ActionPart]] = {}
    for action in actions:
        if isinstance(action, Later):
            later.setdefault(action.seconds, []).append(action.action)
    done = start
    if start == RUN_START and builder.is_outermost:
        ctx.init_globals.extend(at_once)
    elif at_once:
        done = builder.add(ctx.names.new(name), at_once, start)
    for seconds, switches in later.items():
        builder.add(ctx.names.new(name), tuple(switches), start.later(seconds))
    return done

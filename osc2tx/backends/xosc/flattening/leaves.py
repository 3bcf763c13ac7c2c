"""Invocations of actions as events."""

from __future__ import annotations

from math import inf

from osc2tx import ir
from osc2tx.backends.xosc.actions.lateral.lanes import lateral
from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.actions.position.walkers import walk_on
from osc2tx.backends.xosc.actions.registry import ACTIONS, GLOBAL_ACTIONS, WITHOUT_FORM
from osc2tx.backends.xosc.actions.speed.courses import ends_evenly, hold_speed, in_steps
from osc2tx.backends.xosc.actions.user_actions import user_action
from osc2tx.backends.xosc.conditions.flow import NEVER, Flow, Test
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.flattening.builder import RUN_START, StoryboardBuilder
from osc2tx.backends.xosc.flattening.directives import invoke_global
from osc2tx.backends.xosc.flattening.durations import time_frame
from osc2tx.backends.xosc.flattening.failures import Role
from osc2tx.backends.xosc.flattening.until_ends import end_at_until, end_within
from osc2tx.backends.xosc.names import event_name
from osc2tx.backends.xosc.state import LATERAL, LONGITUDINAL, WAY, ActorState
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import replace


def invoke(builder: StoryboardBuilder, node: ir.Invoke, start: Flow, role: Role) -> Flow:
    """Write down an invocation that starts with a flow; return when it ends."""
    is_known = ir.entry_of(node) is not None
    if node.actor is None or (is_known and node.action in GLOBAL_ACTIONS):
        return invoke_global(builder, node, start)
    ctx = builder.ctx
    leaf_handler = ACTIONS.get(node.action) if is_known else user_action
    if leaf_handler is None:
        raise Inexpressible(WITHOUT_FORM["action"][node.action])
    member = ctx.cast.get(ctx.values.actor(node.actor))
    if member is None:
        raise Inexpressible(f"`{node.actor.span.text}` is no entity of the XML")
    builder.mark_actor = member.name
    overriding = builder.overriding(node)
    is_measured = any(call.name == "distance" for call in node.modifiers)
    if node.until or overriding or node.duration is not None or is_measured:
        start = builder.latched(start, builder.name_of(node))
    name = ctx.names.new(event_name(ctx.scope.deeds, node, member.name))
    is_start = start == RUN_START or ir.is_first(ctx.scenario.body, node)
    left, limit = time_frame(ctx, node)
    leaf = Leaf(ctx, node, member, name, is_start=is_start, time_left=left, time_limit=limit)
    ctx.present.add(member.name)
    performance = Performance((), "instant")
    with ctx.report_as(leaf.arguments.construct, node.span):
        try:
            performance = leaf_handler(leaf)
        except ArithmeticError as error:
            raise Inexpressible("its values are no movement: they divide by zero") from error
        leaf.arguments.finish()
    if performance.lasts is not None:
        start = builder.latched(start, builder.name_of(node))
    leaf.demand_of(performance.changes)
    if performance.ends == "open":  # it takes time, in which a tool sees that the jump is over
        ctx.states[member.name] = replace(ctx.states[member.name], jumped=False)
    actions, goal = performance.actions, start
    is_cut = bool(node.until or overriding or builder.is_race)
    lasting = _least_length(builder, node, performance)
    if actions:
        length = 0.0 if is_cut else _event_length(performance)
        is_whole = not overriding and all(_is_over(c, lasting) for c in performance.changes)
        steps = in_steps(leaf, performance) if is_whole else ()
        for index, step in enumerate(steps):
            called = ctx.names.new(name) if index else name
            goal = builder.add(called, (step,), goal, actor=member.name, is_step=True)
        is_first = builder.is_with_run(start) and not is_cut
        if is_first and _is_initial(leaf, performance):
            _set_out(ctx, member.name, actions)
        elif not steps:
            goal = builder.add(name, actions, start, actor=member.name, lasting=length)
        for other, action, word in leaf.others:
            follows = ctx.names.new(f"{other.name}_{word}")
            builder.add(follows, (action,), goal, actor=other.name)
            state = replace(ctx.states[other.name], speed=None).finished(LONGITUDINAL)
            ctx.states[other.name] = state
            ctx.note_move(other.name, node, state, state)
    ends = _ends(builder, node, start, goal, performance, role)
    successors = builder.claimed_by(overriding)
    # Along a path its place is that of the path, whatever else changes.
    for change in sorted(performance.changes, key=lambda each: each.domain == LATERAL):
        is_over = not overriding and _is_over(change, lasting)
        record_end_state(builder, leaf, change, is_over=is_over)
        if (member.name, change.domain) in successors:
            cut = ctx.states[member.name]
            ctx.states[member.name] = cut.finished(change.domain).going_on(cut)
    onward = walk_on(leaf, performance.changes)
    if onward is not None:
        builder.add(ctx.names.new(f"{name}_onward"), (onward,), goal, actor=member.name)
    return builder.mark_end(node, ends)


def _is_initial(leaf: Leaf, performance: Performance) -> bool:
    """Whether `Init` can say an action at the start: it takes no time, and nobody refers to it."""
    name, placed, others = leaf.member.name, leaf.ctx.init_privates, leaf.others
    if performance.ends != "goal" or others or performance.reached or leaf.node.duration:
        return False
    actions = performance.actions
    refers = any(node.get("entityRef") for action in actions for node in action.walk())
    is_plain = all(
        type(each.inner) in (xml.TeleportAction, xml.LongitudinalAction) for each in actions
    )
    is_reference = any(
        node.get("entityRef") == name
        for private in placed.values()
        for action in private.children
        for node in action.walk()
    )
    is_at_once = all(change.time == 0.0 for change in performance.changes)
    return name in placed and is_at_once and is_plain and not refers and not is_reference


def _set_out(ctx: Context, name: str, actions: tuple[xml.ActionPart, ...]) -> None:
    """Let an actor begin with actions, instead of those of their kinds."""
    private, kinds = ctx.init_privates[name], {type(action.inner) for action in actions}
    kept = [each for each in private.all(xml.PrivateAction) if type(each.inner) not in kinds]
    set_out = [each for each in actions if isinstance(each, xml.PrivateAction)]
    ordered = sorted((*kept, *set_out), key=lambda each: not each.find(xml.TeleportAction))
    ctx.init_privates[name] = xml.Private(*ordered, entityRef=name)


def _ends(
    builder: StoryboardBuilder,
    node: ir.Invoke,
    start: Flow,
    goal: Flow,
    performance: Performance,
    role: Role,
) -> Flow:
    """Return when an action is over: at its goal, or when others end it."""
    is_strict = builder.ctx.module.dialect != "carla"
    if is_strict and ir.lasts_until_event(builder.ctx.scope.scenario.body, node):
        return builder.until(node, start) | builder.overridden(node, start)
    is_endless = performance.ends == "open" and performance.lasts is None
    if is_strict and node.until and node.duration is not None:
        content = NEVER if is_endless and not performance.reached else goal
        return end_within(builder, node, start, content, role)
    if is_endless and not performance.reached:
        return builder.limit(node, start)
    length = _length(builder, performance)
    if performance.reached:
        goal = goal & Flow((tuple(map(Test, performance.reached)),))
    elif performance.lasts is not None:
        goal = start.later(performance.lasts)
    return end_at_until(builder, node, start, goal, length, role)


def _length(builder: StoryboardBuilder, performance: Performance) -> tuple[float, float]:
    """Return how long (s) an action takes at least and at most that nothing cuts short."""
    if performance.reached or builder.ctx.choosing.parameters:
        return 0.0, inf
    if performance.lasts is not None:
        return performance.lasts, performance.lasts
    times = [change.time for change in performance.changes if change.actions]
    known = [time for time in times if time is not None]
    least = max(known, default=0.0)
    return least, least if len(known) == len(times) else inf


def _event_length(performance: Performance) -> float:
    """Return how long (s) an event takes whose actions nothing cuts short."""
    if performance.ends != "goal":
        return 0.0
    times = (change.time for change in performance.changes if change.actions)
    return max((time for time in times if time is not None and time < inf), default=0.0)


def _least_length(
    builder: StoryboardBuilder, node: ir.Invoke, performance: Performance
) -> float | None:
    """Return how long (s) an action surely lasts; infinite if only its goal ends it."""
    if builder.is_race:
        return None
    lengths = [] if performance.lasts is None else [performance.lasts]
    if performance.ends == "open" and performance.lasts is None:
        lasting = builder.length_of(node)
        lengths += [] if lasting is None else [lasting]
    for trigger in node.until:
        match trigger:
            case ir.Trigger(event=None, condition=ir.Elapsed(duration=duration)):
                lengths.append(builder.ctx.values.number(duration))
            case _:
                return None
    if performance.ends == "open" and not lengths:
        return None
    return min(lengths, default=inf)


def _is_over(change: Change, lasting: float | None) -> bool:
    """Whether a change is surely done when the action ends."""
    if change.time == 0.0 or lasting == inf:
        return True
    return lasting is not None and change.time is not None and change.time <= lasting


BACK_TO_CENTRE = 1.5
"""Seconds for the way back after a lane change that was cut short."""

Claims = frozenset[tuple[str, str]]


def record_end_state(
    builder: StoryboardBuilder, leaf: Leaf, change: Change, *, is_over: bool
) -> None:
    """Note what is known about the actor when an action has ended."""
    before = builder.ctx.states[leaf.member.name]
    state = _merged(before, change.after if is_over else change.during, change.domain)
    state = state.finished(change.domain).going_on(state)
    if is_over and change.domain == LONGITUDINAL and ends_evenly(change):
        state = replace(state, jumped=True)
    if not is_over and not change.goes_on:
        state = state.with_unfinished(change.domain, leaf.event)
    builder.ctx.states[leaf.member.name] = state
    noted = [_merged(before, each, change.domain) for each in (change.during, change.after)]
    builder.ctx.note_move(leaf.member.name, leaf.node, *noted)
    for each in noted:
        builder.note(leaf.member.name, replace(each, unfinished=()))


CHANGED = {
    LONGITUDINAL: ("speed", "pose", "aim", "rate", "jumped"),
    LATERAL: ("offset", "lane", "pose"),
}
"""What a change may change, by domain; in others it is all."""


def _merged(before: ActorState, now: ActorState, domain: str) -> ActorState:
    """Return the state in which only one domain has changed."""
    if domain not in CHANGED:
        return replace(now, unfinished=before.unfinished)
    return replace(before, **{name: getattr(now, name) for name in CHANGED[domain]})


def end_open_actions(
    builder: StoryboardBuilder, flow: Flow, member: ir.Behavior, taken: Claims
) -> Flow:
    """End what is still changing when a member has ended, unless the next one takes it over.

    Return when the member ends, as a flow that stays true if something had to be ended.
    """
    ctx = builder.ctx
    ended = flow
    for actor in builder.acting(member):
        state = ctx.states[actor]
        left = [
            (domain, event)
            for domain, event in state.unfinished
            if domain != WAY and (actor, domain) not in taken
        ]
        if not left:
            continue
        actions = tuple(_ending(builder, actor, domain, member) for domain, _ in left)
        for domain, _ in left:
            state = state.finished(domain)
        ctx.states[actor] = state
        name = ctx.names.new(f"hold_{actor}")
        ended = builder.latched(ended, name)
        builder.add(name, actions, ended, actor=actor)
    return ended


def _ending(
    builder: StoryboardBuilder, actor: str, domain: str, member: ir.Behavior
) -> xml.PrivateAction:
    if domain == LONGITUDINAL:
        return hold_speed(actor)
    reason = (
        f"it returns to the centre of the lane that it is in within {BACK_TO_CENTRE:g} s, and"
        " without the lateral speed that it has"
    )
    construct = "an interrupted lane change"
    finishing = Remedy(
        instead="an uninterrupted lane change is exact", asks=("LaneChangeActionDynamics",)
    )
    builder.ctx.report.doubt(construct, member.span, reason, finishing)
    dynamics = xml.LaneChangeActionDynamics(
        dynamicsShape="sinusoidal", dynamicsDimension="time", value=BACK_TO_CENTRE
    )
    target = xml.LaneChangeTarget(xml.RelativeTargetLane(entityRef=actor, value=0))
    return lateral(xml.LaneChangeAction(dynamics, target))

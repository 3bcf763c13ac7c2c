"""Ends of actions: changes that are not complete are stopped.

In the DSL an actor keeps its speed and its lane when no action controls them. In the XML an action
runs on until it is done, or another one takes over.
"""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.lateral.lanes import LANE_WIDTH
from osc2tx.backends.xosc.actions.leaf import Change, Leaf
from osc2tx.backends.xosc.actions.speed.speed_elements import ends_evenly, hold_speed
from osc2tx.backends.xosc.conditions.flow import Flow
from osc2tx.backends.xosc.facts.actors import Pace, apart, course_of_shift
from osc2tx.backends.xosc.flattening.storyboard.builder import StoryboardBuilder
from osc2tx.backends.xosc.report import Metres, Remedy
from osc2tx.backends.xosc.state import LATERAL, LONGITUDINAL, WAY, ActorState
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import replace

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
    for noted in (change.during, change.after):
        builder.note(
            leaf.member.name, replace(_merged(before, noted, change.domain), unfinished=())
        )


def _merged(before: ActorState, now: ActorState, domain: str) -> ActorState:
    """Return the state in which only one domain has changed."""
    if domain == LATERAL:
        placed = replace(before, offset=now.offset, lane=now.lane, pose=now.pose)
        return replace(placed, drift=now.drift, aside=now.aside)
    if domain == LONGITUDINAL:
        return replace(
            now,
            offset=before.offset,
            lane=before.lane,
            drift=before.drift,
            aside=before.aside,
            unfinished=before.unfinished,
        )
    return replace(now, unfinished=before.unfinished)


def end_open_actions(
    builder: StoryboardBuilder, flow: Flow, member: ir.Behavior, taken: Claims
) -> Flow:
    """End what is still changing when a member has ended, unless the next one takes over.

    Args:
        builder: The storyboard.
        flow: When the member ends.
        member: The member.
        taken: Entities and domains that the next member takes over.

    Returns:
        When the member ends, as a flow that stays true if something had to be ended.
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


def _beside(builder: StoryboardBuilder, actor: str) -> float:
    """Return by how much (m) the way back to a centre differs at most from the world's."""
    (member,) = (each for each in builder.ctx.entities if each.name == actor)
    drift, ways = builder.ctx.states[actor].drift, (0.0, 0.25 * LANE_WIDTH, 0.5 * LANE_WIDTH)
    return max(
        apart(
            course_of_shift(way, Pace(), member.limits, rate),
            course_of_shift(way, Pace("smooth", None, BACK_TO_CENTRE), member.limits),
        )
        for way in ways
        for rate in (-drift, drift)
    )


def _ending(
    builder: StoryboardBuilder, actor: str, domain: str, member: ir.Behavior
) -> xml.PrivateAction:
    if domain == LONGITUDINAL:
        return hold_speed(actor)
    reason = (
        f"it returns to the centre of the lane that it is in within {BACK_TO_CENTRE:g} s, and"
        " without the lateral speed that it has"
    )
    bound = Metres(_beside(builder, actor), "beside, while it returns")
    construct = "an interrupted lane change"
    finishing = Remedy(
        instead="an uninterrupted lane change is exact", asks=("LaneChangeActionDynamics",)
    )
    builder.ctx.report.approximate(construct, member.span, reason, bound, finishing)
    return xml.PrivateAction(
        xml.LateralAction(
            xml.LaneChangeAction(
                xml.LaneChangeActionDynamics(
                    dynamicsShape="sinusoidal", dynamicsDimension="time", value=BACK_TO_CENTRE
                ),
                xml.LaneChangeTarget(xml.RelativeTargetLane(entityRef=actor, value=0)),
            )
        )
    )

"""Initial actions: `Storyboard/Init/Actions`."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.speed.speed_elements import speed_action
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.placing import InitialPlacing
from osc2tx.backends.xosc.entities.start_orientations import note_turn
from osc2tx.backends.xosc.entities.start_statements import (
    Start,
    in_order,
    speed_at_start,
    starts_of,
)
from osc2tx.backends.xosc.entities.towing import towing
from osc2tx.backends.xosc.report import NoPlace
from osc2tx.backends.xosc.state import ActorState
from osc2tx.xosc import elements as xml

OF_MOVEMENT = frozenset({"acceleration", "distance", "physical_movement"})
"""Modifiers that say nothing about the start, and are written down with their invocation."""


def initial_actions(ctx: Context) -> list[xml.Private]:
    """Return the start of each actor, references first, and note what is known about them."""
    for member in ctx.entities:
        ctx.states[member.name] = ActorState()
    starts = starts_of(ctx)
    placing = InitialPlacing(ctx, towing(ctx))
    try:
        placing.fill(starts)
    except NoPlace as error:
        ctx.report.cannot("placement", error.span or ctx.scenario.span, error.reason)
    privates = []
    for start in in_order(starts):
        if start.id in placing.refused:
            ctx.report.refuse("placement", start.span, placing.refused[start.id])
        elif start.id in placing.positions:
            with ctx.within(start.scope), ctx.report_as("placement", start.span):
                note_turn(ctx, start)
                privates.append(_private(ctx, start, placing.positions[start.id]))
    ctx.at_start = dict(ctx.states)
    return privates


def _private(ctx: Context, start: Start, position: xml.PositionPart) -> xml.Private:
    member = start.member
    actions = [xml.PrivateAction(xml.TeleportAction(xml.Position(position)))]
    speed = speed_at_start(ctx, start)
    if speed != 0.0:
        actions.append(speed_action(speed, "step", "time", 0.0))
    tows = start.modifiers.get("tow_trailer")
    if tows is not None:
        ctx.require("a trailer that is coupled", "1.3", tows.source.span)
        ctx.require_support("TrailerAction", tows.source.span)
        tows.entity("trailer")
    for name, arguments in start.modifiers.items():
        if name not in OF_MOVEMENT:
            arguments.finish()
    return xml.Private(*actions, entityRef=member.name)

"""Overrides (§7.3.12.1.1): members that do not start while another one is active."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.conditions.flow import NEVER, Flow
from osc2tx.backends.xosc.flattening.storyboard.builder import StoryboardBuilder
from osc2tx.backends.xosc.report import Inexpressible


def unless_active(builder: StoryboardBuilder, node: ir.Behavior, start: Flow) -> tuple[Flow, Flow]:
    """Return when a member starts that others may keep from starting, and when it is skipped.

    Both are marks that exclude each other: what counts is who is active at the start.

    Raises:
        Inexpressible: Whether one of the others is active cannot be told.
    """
    scenario = builder.ctx.scope.scenario
    blocking = [
        override
        for override in scenario.overrides
        if node.label == override.overridden and override.mode == "when_active"
    ]
    if not blocking:
        return start, NEVER
    name = builder.name_of(node)
    start = builder.latched(start, name)
    skip, go = builder.ctx.names.new(f"skip_{name}"), builder.ctx.names.new(f"go_{name}")
    active, idle = NEVER, Flow(((),))
    for override in blocking:
        if ir.may_be_cut(scenario.body, override.by):
            reason = f"whether `{override.by}` is active when it is interrupted is not known"
            raise Inexpressible(reason, override.span)
        began, ended = builder.events.activity(override.by)
        active = active | builder.is_set(began) & builder.is_unset(ended)
        idle = idle & (builder.is_unset(began) | builder.is_set(ended))
    skipped = builder.keep(skip, start & active & builder.is_unset(go))
    return builder.keep(go, start & idle & builder.is_unset(skip)), skipped

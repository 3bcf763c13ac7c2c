"""Members that others keep from starting: `override(a, b, when_active)` (§7.3.12.1.1)."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.conditions.flow import NEVER, Flow
from osc2tx.backends.xosc.flattening.storyboard_builder import Loom
from osc2tx.backends.xosc.flattening.tree_queries import may_be_cut
from osc2tx.backends.xosc.report import Inexpressible


def unless_active(loom: Loom, node: ir.Behavior, start: Flow) -> tuple[Flow, Flow]:
    """Return when a member starts that others may keep from starting, and when it is skipped.

    Both are marks that exclude each other: what counts is who is active at the start.

    Raises:
        Inexpressible: Whether one of the others is active cannot be told.
    """
    scenario = loom.ctx.scope.scenario
    blocking = [
        override
        for override in scenario.overrides
        if node.label == override.overridden and override.mode == "when_active"
    ]
    if not blocking:
        return start, NEVER
    name = loom.name_of(node)
    start = loom.latched(start, name)
    skip, go = loom.ctx.names.new(f"skip_{name}"), loom.ctx.names.new(f"go_{name}")
    active, idle = NEVER, Flow(((),))
    for override in blocking:
        if may_be_cut(scenario.body, override.by):
            reason = f"whether `{override.by}` is active when it is cut short is not known"
            raise Inexpressible(reason, override.span)
        began, ended = loom.events.activity(override.by)
        active = active | loom.is_set(began) & loom.is_unset(ended)
        idle = idle & (loom.is_unset(began) | loom.is_set(ended))
    skipped = loom.keep(skip, start & active & loom.is_unset(go))
    return loom.keep(go, start & idle & loom.is_unset(skip)), skipped

"""Members that get in each other's way: starts in a `parallel` (§7.3.13.2), conflicts, overrides.

The run ends with an error where two members control the same of one actor; in the XML one of them
would just take over from the other. Overrides (§7.3.12.1.1) keep members from starting while
another one is active.
"""

from __future__ import annotations

from itertools import product

from osc2tx import ir
from osc2tx.backends.xosc.conditions.flow import NEVER, Flow
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts.start_places import plan_starts
from osc2tx.backends.xosc.flattening.builder import StoryboardBuilder
from osc2tx.backends.xosc.flattening.lengths import length_of
from osc2tx.backends.xosc.flattening.tree_queries import claims
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx_shared.classes import replace


def starts_of(ctx: Context, node: ir.Parallel) -> list[float | None]:
    """Return the start (s) of each member after that of the composition.

    `None`: it starts when the first member ends.

    Raises:
        Inexpressible: It depends on lengths that only the run shows.
    """
    if node.overlap in (None, "start", "any") and not (node.start_to_start or node.end_to_end):
        return [0.0] * len(node.members)
    timed = [member for member in node.members if not ir.is_instant(member)]
    parts = [(member.name, length_of(ctx, member), ir.is_open(member)) for member in timed]
    overlap = node.overlap or "start"
    starts, ends = (
        None if each is None else ctx.values.bounds(each)
        for each in (node.start_to_start, node.end_to_end)
    )
    planned = plan_starts(parts, overlap, starts, ends, node.span)
    by_member = dict(zip(map(id, timed), planned, strict=True))
    return [by_member.get(id(member), 0.0) for member in node.members]


# --- conflicts ------------------------------------------------------------------------------------


def report_conflicts(ctx: Context, node: ir.Parallel) -> None:
    """Report actions that control what another one surely controls at the same time."""
    overridden = {override.overridden for override in ctx.scope.scenario.overrides}
    first = {id(each) for member in node.members for each in ir.first_actions(member)}
    at_once = first if ir.starts_together(node) else set()
    lasting = {id(each) for each in node.members if id(each) in first and ir.is_open(each)}
    claimants: dict[tuple[str, str], list[tuple[int, ir.Invoke]]] = {}
    for number, member in enumerate(node.members):
        for action in ir.invocations(member):
            if not ir.takes_time(action) or action.label in overridden:
                continue
            going_on = tuple(call for call in action.modifiers if call.at != "start")
            for what in claims(replace(action, modifiers=going_on)):
                claimants.setdefault(what, []).append((number, action))
    told = set()
    for rivals in claimants.values():
        holders = [each for each in rivals if id(each[1]) in lasting | at_once]
        for (one, holder), (other, rival) in product(holders, rivals):
            meet = id(holder) in lasting or id(rival) in at_once
            pair = (id(holder), id(rival))
            if not meet or one == other or pair in told:
                continue
            told.add(pair)
            head = holder.span.text.splitlines()[0].removesuffix(":").removesuffix(" with")
            reason = f"runs fail: it would control what `{head}` controls at the same time"
            instead = Remedy(instead="one after the other, or with an `override`, they are exact")
            ctx.report.cannot(f"action {rival.action}", rival.span, reason, instead)


# --- overrides ------------------------------------------------------------------------------------


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

"""Reports about changes of the place across the road by those that may be too slow for them.

In the world nobody goes sideways by more than a share of the way driven, and who stands does not at
all; a change of the XML takes its time whatever the speed.
"""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.backends.xosc.actions.leaf import Arguments, Leaf
from osc2tx.backends.xosc.facts.actors import SIDEWAYS, TOP_SPEED, Profile, fastest
from osc2tx.backends.xosc.report import Inexpressible

PACING = ("assign_speed", "change_speed", "drive", "move", "remain_stationary")
"""Actions that say a speed."""


def note_slow(leaf: Leaf, way: float, course: Profile) -> None:
    """Report a change across the road (m) that the speed of the actor may not allow."""
    if way == 0.0 or leaf.member.walks:
        return
    needed = fastest(course) / SIDEWAYS
    goals = list(_beside(leaf))
    low, high = leaf.state.speed or (0.0, TOP_SPEED)
    slowest = max(low, -high, 0.0)
    if min([slowest, *goals]) >= needed:
        return
    reason = f"below {needed:.2g} m/s it takes longer than a change of the XML, whose time is fixed"
    if max(-low, high) >= needed and min(goals, default=needed) >= needed:
        # Only if what it does now is cut short early: that is said, and shown by the run.
        leaf.ctx.report.exact("speed for a change across the road", leaf.node.span, reason)
        return
    slowest = min([slowest, *goals])
    late = "it is not over as long as it stands, and later if it is slow"
    if slowest > 0.0:
        late = f"it is over at most {way / (SIDEWAYS * slowest):.2g} s later"
    leaf.ctx.report.approximate(leaf.construct, leaf.node.span, reason, late)


def _beside(leaf: Leaf) -> Iterator[float]:
    """Yield the speeds (m/s) that it is told meanwhile, without signs."""
    for node in _meanwhile(leaf.ctx.scope.scenario.body, leaf.node):
        yield from _goals(leaf, node)
        for modifier in node.modifiers:
            yield from _goals(leaf, modifier)


def _goals(leaf: Leaf, source: ir.Invoke | ir.ModifierCall) -> Iterator[float]:
    if isinstance(source, ir.Invoke) and source.action == "remain_stationary":
        yield 0.0
    arguments = Arguments(leaf.ctx, source.arguments, source)
    for name in ("speed", "target"):
        if name in arguments:
            try:
                value = arguments.number(name)
            except Inexpressible:  # a lane as target, or a speed that only the run shows
                continue
            if value is not None:
                yield abs(value)


def _meanwhile(body: ir.Behavior, node: ir.Invoke) -> Iterator[ir.Invoke]:
    """Yield what the same actor does in other members of the compositions around."""
    for composition in ir.walk_behaviors(body):
        if not isinstance(composition, ir.Parallel):
            continue
        inside = [list(ir.walk_behaviors(member)) for member in composition.members]
        holding = [any(each is node for each in member) for member in inside]
        if not any(holding):
            continue
        for member, holds in zip(inside, holding, strict=True):
            for each in () if holds else member:
                if isinstance(each, ir.Invoke) and _paces(each, node):
                    yield each


def _paces(each: ir.Invoke, node: ir.Invoke) -> bool:
    """Whether an action is about the speed of the same actor."""
    if not isinstance(each.actor, ir.FieldRef) or not isinstance(node.actor, ir.FieldRef):
        return False
    return each.actor.name == node.actor.name and each.action in PACING

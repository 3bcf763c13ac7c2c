"""Reports about changes of the place across the road by those that may be too slow for them.

In the world nobody goes sideways by more than a share of the way driven, and who stands does not at
all; a change of the XML takes its time whatever the speed.
"""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Leaf
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
    leaf.approximate(reason, late)


def _beside(leaf: Leaf) -> Iterator[float]:
    """Yield the speeds (m/s) that it is told meanwhile, without signs."""
    name = leaf.node.actor_name
    if name is None:
        return
    for member in ir.runs_beside(leaf.ctx.scope.scenario.body, leaf.node, (ir.Parallel,)):
        for node in ir.invocations(member):
            if node.actor_name == name and node.action in PACING:
                yield from _goals(leaf, node)
                for modifier in node.modifiers:
                    yield from _goals(leaf, modifier)


def _goals(leaf: Leaf, source: ir.Invoke | ir.ModifierCall) -> Iterator[float]:
    if isinstance(source, ir.Invoke) and source.action == "remain_stationary":
        yield 0.0
    arguments = Arguments(leaf.ctx, source)
    for name in ("speed", "target"):
        if name in arguments:
            try:
                value = arguments.number(name)
            except Inexpressible:  # a lane as target, or a speed that only the run shows
                continue
            if value is not None:
                yield abs(value)

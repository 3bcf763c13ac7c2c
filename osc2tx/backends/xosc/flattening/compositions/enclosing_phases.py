"""The duration with which an open-ended action ends: that of the composition around it.

In `parallel(duration: 8s)` the members that never end by themselves end after 8 s; what holds
`at: end` for one of them holds then, as in a run.
"""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.flattening.compositions.parallel_overlaps import is_open, length_of
from osc2tx.backends.xosc.flattening.tree_queries import is_instant
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.values.constants import Bounds


def time_left(ctx: Context, node: ir.Invoke) -> float | None:
    """Return the time (s) from the start of an open-ended action to its end, if that is planned.

    Raises:
        Inexpressible: A duration ends it, and only the run shows when it starts; modifiers state
            what holds at its end.
    """
    if not is_open(node):
        return None
    passed: float | None = 0.0
    child: ir.Behavior = node
    for parent in reversed(_around(ctx.scope.scenario.body, node)):
        fixed = _fixed(ctx, parent)
        if isinstance(parent, ir.Serial):
            *before, last = parent.members
            if last is not child:
                return None
            for member in before:
                length = length_of(ctx, member)
                passed = None if passed is None or length is None else passed + length
        elif not _ends_with_it(parent, has_duration=fixed is not None):
            return None
        if fixed is not None:
            return _rest(node, fixed, passed)
        if parent.duration is not None:
            return None
        child = parent
    return None


def _rest(node: ir.Invoke, fixed: float, passed: float | None) -> float | None:
    """Return what is left of a duration (s) after a time, which may be unknown."""
    if passed is not None:
        return max(0.0, fixed - passed)
    ending = next((call for call in node.modifiers if call.at == "end"), None)
    if ending is None:
        return None
    reason = f"only the run shows how much is left of the {fixed:g} s when it starts"
    raise Inexpressible(reason, ending.span)


def _around(body: ir.Behavior, node: ir.Invoke) -> Sequence[ir.Composition]:
    """Return the compositions around a member, the outermost first."""
    compositions = (ir.Serial, ir.Parallel, ir.OneOf)
    return [
        each
        for each in ir.walk_behaviors(body)
        if isinstance(each, compositions) and ir.holds(each, node)
    ]


def _fixed(ctx: Context, node: ir.Composition) -> float | None:
    """Return a duration (s) that is one number."""
    if node.duration is None or ctx.module.dialect == "carla":
        return None
    is_range = isinstance(ctx.values.of(node.duration), Bounds)
    return None if is_range else ctx.values.number(node.duration)


def _ends_with_it(node: ir.Composition, *, has_duration: bool) -> bool:
    """Whether the open-ended members of a composition start and end with it."""
    if not isinstance(node, ir.Parallel) or node.overlap not in (None, "start"):
        return False
    if node.start_to_start or node.end_to_end:
        return False
    return has_duration or all(map(_never_ends, node.members))


def _never_ends(node: ir.Behavior) -> bool:
    """Whether a member of a `parallel` does not end it."""
    return is_instant(node) or is_open(node)

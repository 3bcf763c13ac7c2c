"""Compositions that have a duration (§7.3.13.4).

One whose content is over before is held until then; one whose content takes longer fails. A member
of a race that fails leaves it; elsewhere the scenario fails, which the verdict of 1.3 can tell.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.conditions.flow import NEVER, Flow
from osc2tx.backends.xosc.flattening.directives import VERDICT
from osc2tx.backends.xosc.flattening.parallel_overlaps import length_of
from osc2tx.backends.xosc.flattening.storyboard_builder import StoryboardBuilder, construct_of
from osc2tx.backends.xosc.report import Remedy
from osc2tx.backends.xosc.values.constants import Bounds
from osc2tx.backends.xosc.xml.tree import element
from osc2tx_classes import replace

Timed: TypeAlias = ir.Composition | ir.InvokeScenario

Role: TypeAlias = Literal["alone", "racer", "in a race"]
"""Whether a member that fails takes the scenario with it, leaves a race, or others of a race."""


def end_within_duration(
    builder: StoryboardBuilder, node: Timed, start: Flow, content: Flow, role: Role
) -> Flow:
    """Return when a member is over whose content starts and ends with flows.

    Of a racer the act is the present one.
    """
    until = builder.until(node, start)
    if node.duration is None:
        return content | until
    low, high = _bounds(builder, node.duration)
    builder.ctx.report.exact("duration", node.duration.span)
    if content.is_never:  # it goes on for as long as one likes
        return start.later(low) | until
    length = _length(builder, node)
    if length is not None and length <= high:
        return (content if low <= length else start.later(low)) | until
    in_time, late = NEVER, start.later(high)
    if length is None and not content.is_surely_after(late):
        done = builder.ctx.names.new(f"done_{builder.name_of(node)}")
        in_time = builder.keep(done, content) & start.later(low)
        late = late & builder.is_unset(done)
    return _failing(builder, node, in_time, late, role) | until


def _bounds(builder: StoryboardBuilder, duration: ir.Expression) -> tuple[float, float]:
    value = builder.ctx.values.of(duration)
    if isinstance(value, Bounds):
        return value.lower, value.upper
    number = builder.ctx.values.number(duration)
    return number, number


def _length(builder: StoryboardBuilder, node: Timed) -> float | None:
    """Return how long (s) the content takes, if that is known."""
    if isinstance(node, ir.InvokeScenario):
        return None
    return length_of(builder.ctx, replace(node, duration=None, until=()))


def _failing(
    builder: StoryboardBuilder, node: Timed, in_time: Flow, late: Flow, role: Role
) -> Flow:
    """Return when a member is over that fails with a flow."""
    ctx, name = builder.ctx, f"late_{builder.name_of(node)}"
    span = node.span if node.duration is None else node.duration.span
    construct = f"duration of a {construct_of(node)}"
    if role == "racer":
        mark = ctx.names.new(name)
        builder.keep(mark, late)
        builder.act.stops.append(mark)
        ctx.report.exact(construct, span, "if it takes longer, it leaves the race")
        return in_time
    bound = "the same if the content is over in time"
    if role == "in a race":
        reason = "what takes longer fails, and others of the race go on; the XML cuts it short"
        ctx.report.approximate(construct, span, reason, bound)
        return in_time | late
    if not ctx.can("SetMonitorAction", "1.3"):
        reason = "what takes longer fails; here the run just ends, for it has no verdict"
        ctx.report.approximate(construct, span, reason, bound, Remedy(version="1.3"))
        builder.finished = builder.finished | late
        return in_time
    ctx.monitors[VERDICT] = True
    action = element("SetMonitorAction", monitorRef=VERDICT, value=False)
    failing = (element("GlobalAction", action),)
    failed = builder.add(ctx.names.new(name), failing, late, actor=builder.mark_actor)
    builder.finished = builder.finished | failed
    ctx.report.exact(construct, span, f"if it takes longer, the monitor `{VERDICT}` says so")
    return in_time

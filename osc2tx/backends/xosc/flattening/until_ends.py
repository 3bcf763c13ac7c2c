"""Members that last until an `until` (§7.6.2.5.4): one that is over by itself before it fails.

In the dialect `carla` whatever comes first is the end.
"""

from __future__ import annotations

from math import inf
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.conditions.flow import NEVER, ROUNDING, Flow
from osc2tx.backends.xosc.flattening.builder import VERDICT, StoryboardBuilder
from osc2tx.backends.xosc.flattening.failures import Role, fail_scenario
from osc2tx.losses.entries import Inexpressible, Remedy

Ended: TypeAlias = ir.Composition | ir.Invoke | ir.InvokeScenario


def end_at_until(
    builder: StoryboardBuilder,
    node: Ended,
    start: Flow,
    content: Flow,
    length: tuple[float, float],
    role: Role,
) -> Flow:
    """Return when a member without a duration is over.

    Args:
        builder: The storyboard.
        node: The member.
        start: When it starts.
        content: When its content is over, in whatever way.
        length: How long (s) the content takes at least and at most.
        role: What a failure of it ends.

    Raises:
        Inexpressible: It is over before its `until` in every run.
    """
    overridden = builder.overridden(node, start)
    if not node.until or builder.ctx.module.dialect == "carla" or content.is_never:
        return content | builder.until(node, start) | overridden
    until = builder.until(node, start)
    times = [_time_of(builder, trigger) for trigger in node.until]
    known = [time for time in times if time is not None]
    least, most = length
    if any(time <= least + ROUNDING for time in known):
        return until | overridden
    if most < min(known, default=0.0) and len(known) == len(times) and overridden.is_never:
        if role == "racer":
            return NEVER
        reason = (
            f"it is over by itself after {most:g} s, before its `until` at {min(known):g} s:"
            " every run fails"
        )
        fitting = Remedy(instead=f"an `until` before {most:g} s, or none, is exact")
        raise Inexpressible(reason, node.until[0].span, fitting)
    return _whichever(builder, node, content, until, role) | overridden


def end_within(
    builder: StoryboardBuilder, node: Ended, start: Flow, content: Flow, role: Role
) -> Flow:
    """Return when a member is over whose `until` has to come within its duration.

    Of a range, the end is the end as well, if nothing else ends the content.
    """
    ctx, name = builder.ctx, builder.name_of(node)
    assert node.duration is not None, "it is written"
    low, high = ctx.values.bounds(node.duration)
    overridden, until = builder.overridden(node, start), builder.until(node, start)
    ctx.report.exact("duration", node.duration.span)
    latest = start.later(high) if content.is_never and low < high < inf else NEVER
    if all(_time_of(builder, trigger) is not None for trigger in node.until):
        return until | latest | overridden  # the rules of the language keep them within
    reason = "what its `until` does not end within its duration fails"
    span = node.until[0].span
    if role != "alone":
        ctx.report.doubt("until", span, f"{reason}, and the race goes on; the XML ends it")
        return until | latest | content | overridden
    filled, done = ctx.names.new(f"filled_{name}"), ctx.names.new(f"done_{name}")
    is_filled = builder.keep(filled, start.later(low)) if low > 0.0 else start
    over = builder.keep(done, until & is_filled | latest)
    failed = content if high == inf or not latest.is_never else content | start.later(high)
    failed = failed & builder.is_unset(done)
    if low > 0.0:
        failed = failed | until & builder.is_unset(filled)
    _tell(builder, node, f"fails_{name}", failed, reason)
    return over | overridden


def _time_of(builder: StoryboardBuilder, trigger: ir.Trigger) -> float | None:
    """Return the time (s) after the start of its member at which an `until` surely comes."""
    match trigger:
        case ir.Trigger(event=None, condition=ir.Elapsed(duration=duration)):
            return builder.ctx.values.number(duration)
    return None


def _whichever(
    builder: StoryboardBuilder, node: Ended, content: Flow, until: Flow, role: Role
) -> Flow:
    """Return when a member is over of which only the run shows whether it lasts long enough."""
    ctx, name = builder.ctx, builder.name_of(node)
    span = node.until[0].span
    reason = "what is over by itself before its `until` fails"
    if role == "in a race":
        ctx.report.doubt("until", span, f"{reason}, and the race goes on; the XML ends it")
        return content | until
    done, fails = ctx.names.new(f"done_{name}"), f"fails_{name}"
    if role == "racer":
        fails = ctx.names.new(fails)
        over = builder.keep(done, until & builder.is_unset(fails))
        builder.keep(fails, content & builder.is_unset(done))
        ctx.report.exact("until", span, f"{reason}, and leaves the race")
        return over
    over = builder.keep(done, until)
    _tell(builder, node, fails, content & builder.is_unset(done), reason)
    return over


def _tell(builder: StoryboardBuilder, node: Ended, name: str, failed: Flow, reason: str) -> None:
    """Let the scenario fail with a flow, and report how far the document tells it."""
    report, span = builder.ctx.report, node.until[0].span
    if fail_scenario(builder, name, failed):
        report.exact("until", span, f"{reason}: the monitor `{VERDICT}` says so")
    else:
        reason += "; here the run just ends, for it has no verdict"
        report.doubt("until", span, reason, Remedy(version="1.3"))

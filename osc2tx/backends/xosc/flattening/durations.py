"""Compositions that have a duration (§7.3.13.4), and the open-ended actions that it ends.

One whose content takes longer fails, and so does one whose content is over before and has no member
without end that fills the rest. A member of a race that fails leaves it; elsewhere the scenario
fails, which the verdict of 1.3 can tell. In the dialect `carla` whatever comes first is the end.

In `parallel(duration: 8s)` the members that never end by themselves end after 8 s; what holds
`at: end` for one of them holds then, as in a run.
"""

from __future__ import annotations

from math import inf
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.conditions.flow import NEVER, Flow
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.flattening.builder import VERDICT, StoryboardBuilder, construct_of
from osc2tx.backends.xosc.flattening.failures import Role, fail_scenario
from osc2tx.backends.xosc.flattening.lengths import (
    fitting,
    least_length,
    length_at_least,
    length_of,
    may_end_after,
    takes,
)
from osc2tx.backends.xosc.flattening.until_ends import end_at_until, end_within
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx_shared.classes import replace
from osc2tx_shared.steps import DEFAULT_STEP

Timed: TypeAlias = ir.Composition | ir.InvokeScenario


def end_within_duration(
    builder: StoryboardBuilder, node: Timed, start: Flow, content: Flow, role: Role
) -> Flow:
    """Return when a member is over whose content starts and ends with flows.

    Of a racer the act is the present one.
    """
    length = None  # of the content, if it is known
    if not isinstance(node, ir.InvokeScenario):
        length = length_of(builder.ctx, replace(node, duration=None, until=()))
    if node.duration is None:
        least = length_at_least(builder.ctx, replace(node, until=()))
        most = inf if length is None else length
        return end_at_until(builder, node, start, content, (least, most), role)
    if node.until and builder.ctx.module.dialect != "carla":
        return end_within(builder, node, start, content, role)
    until = builder.until(node, start) | builder.overridden(node, start)
    low, high = builder.ctx.values.bounds(node.duration)
    builder.ctx.report.exact("duration", node.duration.span)
    since = content.open_since
    if content.is_never and isinstance(node, ir.OneOf):
        needed = [least_length(builder.ctx, member) for member in node.members]
        if not any(length is not None and length <= low for length in needed):
            reason = "whether one of its open-ended members gets to its end, only the run shows"
            raise Inexpressible(reason, node.duration.span)
    if content.is_never and (since is None or start.later(low).is_surely_after(since)):
        return start.later(low) | until  # it goes on for as long as one likes
    if builder.ctx.module.dialect == "carla":
        return content | start.later(high) | until
    # A member without end fills what the others leave of a duration.
    fills = since is not None or (
        isinstance(node, ir.Parallel)
        and any(ir.is_open(member, is_planned=True) for member in node.members)
    )
    if low == high and (fills or isinstance(node, ir.OneOf)):
        content_of_node = replace(node, duration=None, until=())
        if may_end_after(builder.ctx, content_of_node, low):
            return start.later(low) | until
    if isinstance(node, ir.OneOf):
        return _first_in_time(builder, node, content) | until
    content = content if since is None else since
    if length is not None and length <= high and (fills or low <= length):
        return (start.later(low) if length < low else content) | until
    if length is not None and role != "racer":
        reason = f"it takes {length:g} s, longer than {high:g} s: every run fails"
        if length < low:
            reason = f"it is over after {length:g} s, and nothing fills the rest: every run fails"
        fitting = Remedy(instead=f"a duration of {length:g} s, or a member without end, is exact")
        raise Inexpressible(reason, node.duration.span, fitting)
    if length is not None:
        failed = content if length < low else start.later(high)
        return _failing(builder, node, NEVER, failed, role) | until
    late = start.later(high)
    if content.is_surely_after(late):
        return _failing(builder, node, NEVER, late, role) | until
    done = builder.ctx.names.new(f"done_{builder.name_of(node)}")
    over = builder.keep(done, content)
    failed = late & builder.is_unset(done)
    if low > 0.0 and not fills:
        filled = builder.ctx.names.new(f"filled_{builder.name_of(node)}")
        builder.keep(filled, start.later(low))
        failed = failed | over & builder.is_unset(filled)
    return _failing(builder, node, over & start.later(low), failed, role) | until


def _first_in_time(builder: StoryboardBuilder, node: ir.OneOf, content: Flow) -> Flow:
    """Return when a race within a duration is over, whose content is that of its fitting members.

    Raises:
        Inexpressible: Only the run shows which of them end within it, or none does.
    """
    assert node.duration is not None, "it is written"
    racing = fitting(builder.ctx, node)
    if racing is not node and ir.is_drawn(node, builder.ctx.module.one_of):
        raise Inexpressible("one of the members that take it is drawn", node.duration.span)
    lengths = [length_of(builder.ctx, member) for member in racing.members]
    if None in lengths or any(map(ir.is_open, racing.members)):
        reason = "the member that ends within the duration wins, which only the run shows"
        raise Inexpressible(reason, node.duration.span)
    duration = builder.ctx.values.bounds(node.duration)
    if not any(takes(length, duration) for length in lengths if length is not None):
        raise Inexpressible("none of its members takes it: every run fails", node.duration.span)
    return content


def _failing(
    builder: StoryboardBuilder, node: Timed, in_time: Flow, failed: Flow, role: Role
) -> Flow:
    """Return when a member is over that fails with a flow."""
    ctx, name = builder.ctx, f"fails_{builder.name_of(node)}"
    span = node.span if node.duration is None else node.duration.span
    construct = f"duration of a {construct_of(node)}"
    if role == "racer":
        mark = ctx.names.new(name)
        builder.keep(mark, failed)
        builder.act.stops.append(mark)
        ctx.report.exact(construct, span, "if it takes another time, it leaves the race")
        return in_time
    bound = "the same if the content takes as long as it should"
    if role == "in a race":
        reason = "what takes another time fails, and others of the race go on; the XML ends it"
        ctx.report.approximate(construct, span, reason, bound)
        return in_time | failed
    if fail_scenario(builder, name, failed):
        note = f"if it takes another time, the monitor `{VERDICT}` says so"
        ctx.report.exact(construct, span, note)
    else:
        reason = "what takes another time fails; here the run just ends, for it has no verdict"
        ctx.report.approximate(construct, span, reason, bound, Remedy(version="1.3"))
    return in_time


# --- what compositions leave an action ------------------------------------------------------------


def time_frame(ctx: Context, node: ir.Invoke) -> tuple[float | None, float | None]:
    """Return the time (s) from the start of an action to its planned end, and at most to its goal.

    Durations of compositions around it end open-ended actions, and limit the others. `None`:
    nothing is planned.

    Raises:
        Inexpressible: A duration ends it, and only the run shows when it starts; modifiers state
            what holds at its end.
    """
    ends = ir.is_open(node, is_planned=True)
    if ctx.module.dialect == "carla" or (not ends and node.duration is not None):
        return None, None
    passed: float | None = 0.0
    following: float | None = 0.0  # what members after it need at least
    for parent, before, after in ir.around(ctx.scope.scenario.body, node):
        for member in before:
            length = length_of(ctx, member)
            passed = None if passed is None or length is None else passed + length
        low, high = (0.0, inf) if parent.duration is None else ctx.values.bounds(parent.duration)
        is_planned = not after and ir.ends_with_open(parent, is_fixed=low == high)
        if not ends:
            for member in after:
                least = _needs_at_least(ctx, member)
                following = None if following is None or least is None else following + least
            is_planned = passed is not None and following is not None and _begins_with(parent)
        if not is_planned:
            break
        if parent.duration is None and parent.until:
            break
        if parent.duration is None:
            continue
        if passed is not None and following is not None:
            left = max(0.0, high - passed - following)
            return (left if low == high else None, None) if ends else (None, left)
        ending = next((call for call in node.modifiers if call.at == "end"), None)
        if ending is None or low != high:
            break
        reason = f"only the run shows how much is left of the {low:g} s when it starts"
        raise Inexpressible(reason, ending.span)
    return None, None


def _needs_at_least(ctx: Context, node: ir.Behavior) -> float | None:
    """Return the time (s) that a member needs, an open-ended action a step of the world.

    `None`: only the run shows it.
    """
    if isinstance(node, ir.Invoke) and ir.is_open(node):
        return None if ir.goals_of(node) else DEFAULT_STEP
    return length_of(ctx, node)


def _begins_with(node: ir.Composition) -> bool:
    """Whether members follow one another, or begin with a parallel and end when they like."""
    return isinstance(node, ir.Serial) or (
        isinstance(node, ir.Parallel) and ir.starts_together(node)
    )

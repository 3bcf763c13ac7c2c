"""Reports about speeds that a tool drives otherwise than the world, and about speeds that stay.

In the world nobody goes sideways by more than a share of the way driven, and who stands does not at
all; a change of the XML takes its time whatever the speed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Leaf, Uneven
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.actors import (
    SIDEWAYS,
    TOP_SPEED,
    Course,
    Linear,
    Pace,
    Profile,
    apart,
    fastest,
    way_between,
    way_by_acceleration,
)
from osc2tx.backends.xosc.report import GENERIC, Inexpressible, Metres, Remedy
from osc2tx.backends.xosc.state import STEADY, known
from osc2tx.catalogue import catalogue

PROFILE_ACTION = "SpeedProfileAction"

SINCE_PROFILES = Remedy(version="1.2")

STEP = 0.05
"""Seconds of a step of the run, unless it says otherwise."""

NEAR = 0.05
"""Metres along the road that count as the same place."""


def with_profiles(ctx: Context) -> Remedy:
    """Return what has `SpeedProfileAction`, where a document may not use it."""
    return SINCE_PROFILES if ctx.version < "1.2" else GENERIC


def note_acceleration(leaf: Leaf, target: float, pace: Pace) -> None:
    """Report that a change takes over an acceleration: that of the XML begins without any."""
    rate, speed, limits = leaf.state.rate, leaf.state.speed, leaf.limits
    rates = leaf.state.pending if rate is None else known(rate)
    has_profiles = leaf.ctx.can(PROFILE_ACTION, "1.2")
    if rates == STEADY:
        return
    if rate is None and has_profiles and leaf.ctx.profile.carries_acceleration:
        return  # it takes over that of a change that is interrupted, not of one that is over
    if speed is None:
        time = max(map(abs, rates)) / limits.jerk
        bound: Metres | str = f"it comes to its speed at most {2.0 * time:.2g} s sooner or later"
    else:
        ways = [way_by_acceleration(v, target, pace, rates, limits) for v in speed]
        bound = Metres(max(ways), "ahead or behind")
    leaf.approximate(
        "it takes over the acceleration of the change before; one of the XML begins without any",
        bound,
        Remedy(version=None if has_profiles else "1.2", profile="esmini"),
    )


def note_even_change(
    leaf: Leaf, courses: Iterable[tuple[Course, Linear]], length: float | None
) -> None:
    """Report that a change with limited jerk is an even one in the XML.

    Each course that the world may drive goes with that of the XML; both have the same speed after a
    length (s), by default at their ends.
    """
    known = tuple(courses)
    off = max(way_between(world, even, length) for world, even in known)
    leaf.uneven = Uneven(max(apart(world, even) for world, even in known), length)
    if off > NEAR:
        version = leaf.ctx.version
        leaf.approximate(
            f"OpenSCENARIO XML {version} has no limits of the jerk: the speed changes evenly",
            Metres(off, "ahead or behind"),
            SINCE_PROFILES,
        )


def note_cut(leaf: Leaf, *, is_by_duration: bool) -> None:
    """Report that an even change has another speed than that of the world where it is cut short.

    The invocation may be over before its change, if only by its duration.
    """
    uneven = leaf.uneven
    if uneven is None or (is_by_duration and uneven.length == leaf.duration):
        return
    leaf.approximate(
        "what cuts the even change short leaves it at another speed",
        f"at most {uneven.speed:.2g} m/s off from then on, until it has a new speed",
        SINCE_PROFILES,
    )


def refuse_contradiction(leaf: Leaf, peak: float, own: float, duration: float) -> None:
    """Refuse a peak that does not go with the duration.

    Raises:
        Inexpressible: They are more than a step of the run apart.
    """
    if abs(own - duration) > STEP:
        raise Inexpressible(
            f"with rate_peak {peak:g} m/s^2 it takes {own:.2f} s, not {duration:g} s: every run"
            " fails",
            leaf.node.span,
        )


# --- speeds that stay -----------------------------------------------------------------------------

_BESIDE_SPEED = ("keep_lane", "lane", "lateral", "change_lane")
"""Modifiers that say nothing of the speed."""


def note_open_speed(leaf: Leaf) -> None:
    """Report that a driver who is told no speed slows down for bends, which no XML says."""
    roads, speed = leaf.ctx.roads, leaf.state.speed
    if roads is None or leaf.member.walks:
        return
    if any(call.name not in _BESIDE_SPEED for call in leaf.node.modifiers):
        return
    fastest = TOP_SPEED if speed is None else max(map(abs, speed))
    if fastest**2 * roads.sharpest_bend > leaf.limits.lateral:
        bound = f"{fastest:.4g} m/s are too fast for the sharpest bend of the map"
        if speed is None:
            bound = "none where its speed, which only the run shows, suits the bends of the map"
        leaf.approximate(
            "no speed is stated: it slows down for bends in the world, but not in the XML",
            bound,
            Remedy(instead="`keep_speed()` holds the speed in both"),
        )


def speed_then(leaf: Leaf, other: CastMember) -> float | None:
    """Return the speed (m/s) of another actor at the start of an action; `None` if not known.

    Members beside one another are written down one after the other: the state of an actor that acts
    in one of them may be that before or after it.
    """
    if leaf.is_start:
        return leaf.ctx.at_start[other.name].known_speed
    body = leaf.ctx.scope.scenario.body
    beside = list(ir.runs_beside(body, leaf.node))
    may_act = any(_acts(member, other.actor.name) for member in beside)
    if may_act or not ir.holds(leaf.ctx.scenario.body, leaf.node):
        return steady_speed(leaf, other)
    return leaf.ctx.states[other.name].known_speed


def _acts(member: ir.Behavior, actor: str) -> bool:
    """Whether an actor may act in a member."""
    nodes = ir.walk_behaviors(member)
    return actor in ir.actors_of(member) or any(isinstance(n, ir.InvokeScenario) for n in nodes)


def steady_speed(leaf: Leaf, actor: CastMember) -> float | None:
    """Return the speed (m/s) that an actor has all the time; `None` if it may change."""
    start = leaf.ctx.at_start[actor.name].known_speed
    if start is None:
        return None
    for node in ir.walk_behaviors(leaf.ctx.scenario.body):
        if isinstance(node, ir.InvokeScenario):
            return None
        if not isinstance(node, ir.Invoke) or node.actor_name != actor.actor.name:
            continue
        if not _leaves_speed(leaf, node, start):
            return None
    return start


def _leaves_speed(leaf: Leaf, node: ir.Invoke, speed: float) -> bool:
    entry = catalogue().actions.get(node.qualified_name)
    if entry is None or (entry.paces and node.action != "keep_speed"):
        return False
    for call in node.modifiers:
        if call.name in _BESIDE_SPEED or call.name == "keep_speed":
            continue
        if call.name != "speed":
            return False
        arguments = Arguments(leaf.ctx, call)
        if any(name in arguments for name in ("faster_than", "slower_than", "same_as")):
            return False
        if arguments.number("speed") != speed:
            return False
    return True


# --- changes across the road by who may be too slow for them --------------------------------------

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

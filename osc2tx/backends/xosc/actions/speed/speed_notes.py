"""Reports about speeds that a tool drives otherwise than the world, and about speeds that stay.

In the world nobody goes sideways by more than a share of the way driven, and who stands does not at
all; a change of the XML takes its time whatever the speed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from osc2tx import ir
from osc2tx.backends.xosc.actions.leaf import Leaf, Uneven
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
from osc2tx.backends.xosc.report import Metres, Remedy
from osc2tx.backends.xosc.state import STEADY, known

PROFILE_ACTION = "SpeedProfileAction"

SINCE_PROFILES = Remedy(version="1.2")

NEAR = 0.05
"""Metres along the road that count as the same place."""


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


# --- changes across the road by who may be too slow for them --------------------------------------


def note_slow(leaf: Leaf, way: float, course: Profile) -> None:
    """Report a change across the road (m) that the speed of the actor may not allow."""
    if way == 0.0 or leaf.member.walks:
        return
    needed = fastest(course) / SIDEWAYS
    goals = list(_goals_beside(leaf))
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


def _goals_beside(leaf: Leaf) -> Iterator[float]:
    """Yield the speeds (m/s) to which it changes meanwhile, without signs."""
    for member in ir.runs_beside(leaf.ctx.scope.scenario.body, leaf.node, (ir.Parallel,)):
        for node in ir.invocations(member):
            move = (leaf.ctx.moves_of(leaf.member.name) or {}).get(id(node))
            if move is not None and move.after.known_speed is not None:
                yield abs(move.after.known_speed)

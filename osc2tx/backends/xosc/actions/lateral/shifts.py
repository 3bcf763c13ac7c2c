"""Movements across the road: their course, and how far the XML differs from it.

In the world nobody goes sideways by more than a share of the way driven, and who stands does not at
all; a change of the XML takes its time whatever the speed.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from osc2tx import ir
from osc2tx.backends.xosc.actions.leaf import Leaf
from osc2tx.backends.xosc.facts.actors import (
    SIDEWAYS,
    TOP_SPEED,
    Linear,
    Pace,
    Profile,
    apart,
    course_of_shift,
    fastest,
)
from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.report import Metres
from osc2tx.backends.xosc.state import ActorState
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import DynamicsShape


def shift(
    leaf: Leaf, way: float, pace: Pace, *, jumps: bool = False
) -> tuple[DynamicsShape, float, float]:
    """Return shape, length (s) and fastest speed (m/s) of a movement across the road.

    Reported is where the one of the XML, of as many metres, differs from that of the world.
    """
    planned = partial(course_of_shift, way, limits=leaf.limits)
    pace, course = leaf.within_limit(pace, planned)
    if jumps:
        return "step", 0.0, 0.0
    _note_drift(leaf, way, pace, course)
    _note_slow(leaf, way, course)
    # Where the scenario leaves the shape open, any is right.
    is_free = pace.profile == "none" and not leaf.ctx.profile.has_shapes
    is_even = isinstance(course, Linear) or is_free
    return "linear" if is_even else "sinusoidal", course.duration, fastest(course)


def _note_drift(leaf: Leaf, way: float, pace: Pace, course: Profile) -> None:
    """Report that a change takes over a speed across the road: the XML begins without any."""
    drift = leaf.state.drift
    if drift == 0.0 or pace.profile == "constant":
        return
    off = max(apart(course_of_shift(way, pace, leaf.limits, v), course) for v in (-drift, drift))
    leaf.approximate(
        "it takes over the lateral speed of the change before; one of the XML begins without any",
        Metres(off, "beside, while it changes"),
    )


def _note_slow(leaf: Leaf, way: float, course: Profile) -> None:
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


def along_t(leaf: Leaf, offset: float, lane: LanePosition | None = None) -> float:
    """Return an offset (m) to the left of travel as the XML counts it: along t of the road.

    Without a lane it is in that of the actor, as far as it is known.
    """
    roads = leaf.ctx.roads
    sign = None if roads is None else roads.leftwards(lane or leaf.state.lane)
    if offset == 0.0 or sign == 1:
        return offset
    if sign is None:
        leaf.approximate(
            "the XML counts an offset along t of the road, and whether its lane leads along the"
            " road or against it is only known during the run",
            Metres(2.0 * abs(offset), "to the other side where its lane leads against s"),
        )
        return offset
    return -offset


def offset_of(state: ActorState) -> float:
    """Return how far (m) left of the centre of its lane an actor is, as far as it is known."""
    return state.offset.low if state.offset is not None and state.offset.is_known else 0.0


def lateral(action: xml.LateralActionPart) -> xml.PrivateAction:
    """Return the private action around a lateral one."""
    return xml.PrivateAction(xml.LateralAction(action))

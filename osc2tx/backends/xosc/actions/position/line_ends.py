"""Where lines begin and end: the way to a trajectory, and the lateral speed that a line leaves."""

from __future__ import annotations

import math
from collections.abc import Sequence

from osc2tx.backends.xosc.actions.leaf import Leaf
from osc2tx.backends.xosc.actions.position.path_steering import NEAR
from osc2tx.backends.xosc.actions.position.points_and_lines import Line
from osc2tx.backends.xosc.facts.actors import Linear, apart, course_of_shift
from osc2tx.backends.xosc.facts.curves import Waypoint
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx.backends.xosc.flattening.tree_queries import is_first, is_last, predecessor
from osc2tx.backends.xosc.report import Metres, Remedy

ALONG_ITS_LANE = ("lane_relative", "object_relative", "road_relative")
"""Frames whose x axis is the direction of the lane."""

ARRIVING = Remedy(instead="a trajectory that begins where the actor is is exact")
PARALLEL = Remedy(instead="a way whose last stretch is parallel to its lane is exact")


def note_jump(leaf: Leaf, first: Waypoint) -> None:
    """Report that a trajectory with times begins where it does: the XML jumps there, if need be."""
    here, bound = _place(leaf), "by the way from where it is to the first point, until it is there"
    if here is not None:
        missing = math.hypot(first.x - here.x, first.y - here.y)
        if missing <= NEAR:
            return
        bound = f"at most {missing:.3g} m, until it is there"
    leaf.ctx.report.approximate(
        leaf.construct,
        leaf.node.span,
        "the XML puts it on the first point, in the world it drives there as fast as it can",
        bound,
        ARRIVING,
    )


def _place(leaf: Leaf) -> Pose | None:
    """Return where an actor begins: at its start, or after a drive from there at one speed."""
    state, ctx = leaf.state, leaf.ctx
    start = ctx.at_start[leaf.member.name]
    if state.pose is not None or ctx.roads is None or start.lane is None:
        return state.pose
    if leaf.is_start:
        return ctx.roads.pose(start.lane)
    before = predecessor(ctx.scenario.body, leaf.node)
    if before is None or before.duration is None or not is_first(ctx.scenario.body, before):
        return None
    speed = state.speed
    is_steady = speed is not None and speed.is_known and speed == start.speed
    if not is_steady or speed is None or state.offset != start.offset:
        return None
    there = ctx.roads.ahead(start.lane, speed.low * ctx.values.number(before.duration))
    return None if there is None else ctx.roads.pose(there)


def note_slant(
    leaf: Leaf, line: Line, corners: Sequence[Waypoint], lane: LanePosition | None, speed: float
) -> float:
    """Report what a slant at the end of a way makes; return the speed across the lane there.

    Args:
        leaf: The invocation.
        line: Its way.
        corners: Of the line.
        lane: Where it ends; `None` if that is unknown.
        speed: m/s at its end.
    """
    before, end = corners[-2], corners[-1]
    heading = math.atan2(end.y - before.y, end.x - before.x)
    if line.frame is None and lane is not None and leaf.ctx.roads is not None:
        heading -= leaf.ctx.roads.pose(lane).h
    elif line.frame not in ALONG_ITS_LANE:
        return 0.0
    drift = abs(speed * math.sin(heading))
    course = course_of_shift(0.0, "none", None, None, leaf.limits, drift)
    off = apart(course, Linear(0.0, 0.0, course.duration)) if course.duration > 0.0 else 0.0
    if off <= NEAR or leaf.member.walks or is_last(leaf.ctx.scenario.body, leaf.node):
        return 0.0
    leaf.ctx.report.approximate(
        leaf.construct,
        leaf.node.span,
        "at its end it is on a slant, and its speed across the lane runs out; in the XML it stops",
        Metres(off, "beside, when it is over"),
        PARALLEL,
    )
    return drift

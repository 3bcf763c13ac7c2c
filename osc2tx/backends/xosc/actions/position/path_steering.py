"""Lines of paths and trajectories against the way of the actor.

Actors steer through corners, which the lines of the XML have; they drive to where a trajectory
begins, and the speed across the lane that a line leaves runs out.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from osc2tx import ir
from osc2tx.backends.xosc.actions.leaf import Leaf
from osc2tx.backends.xosc.facts.actors import CRUISE, Linear, Pace, apart, course_of_shift
from osc2tx.backends.xosc.facts.curves import Line, Waypoint, off_the_line
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx.backends.xosc.report import Metres, Remedy

NEAR = 0.05
"""Metres beside its line that count as on it."""

ON_LINES = "FollowTrajectoryAction/Vehicle"
"""Feature of tools, as in `ToolProfile.unsupported`."""

ON_THE_LINE = Remedy(
    instead="`replay_path`, or `physical_movement(prefer_non_physical)`, is on the line exactly",
    asks=(ON_LINES,),
)
JUMPING = Remedy(
    instead="`replay_trajectory`, or `physical_movement(prefer_non_physical)`, jumps like the XML",
    asks=(ON_LINES,),
)


def note_steering(
    leaf: Leaf,
    line: Line,
    corners: Sequence[Waypoint],
    speed: float | None = None,
) -> None:
    """Report how far an actor that steers along a way is from the corners of the line of the XML.

    The speed (m/s) is by default what is known of the actor.
    """
    start = _start(leaf, line, corners)
    here = Waypoint(0.0, start.x, start.y, start.z)
    is_there = math.hypot(corners[0].x - start.x, corners[0].y - start.y) < 1e-6
    speed = _speed(leaf) if speed is None else speed
    from_here = tuple(corners) if is_there else (here, *corners)
    off = off_the_line(line, from_here, start, speed, (leaf.member.shape, leaf.limits))
    if off > NEAR:
        leaf.approximate(
            "it steers along the way as physics allows, the line of the XML has corners",
            Metres(off, f"at {speed:.3g} m/s"),
            ON_THE_LINE,
        )


def _speed(leaf: Leaf) -> float:
    """Return the fastest speed (m/s) that is known of an actor, else one at which it sets out."""
    speed = leaf.state.speed
    return CRUISE if speed is None or speed.high <= 0.0 else speed.high


def _start(leaf: Leaf, line: Line, corners: Sequence[Waypoint]) -> Pose:
    """Return where an actor is when it begins; if only the run shows that, at its way in its lane.

    Relative to itself it is where it is.
    """
    first, second = corners[0], corners[1]
    along = Pose(first.x, first.y, first.z, math.atan2(second.y - first.y, second.x - first.x))
    if line.frame is not None:
        is_own = line.reference == leaf.member.name and line.frame != "world_relative"
        return Pose(0.0, 0.0, 0.0, 0.0) if is_own else along
    here, roads = leaf.start_pose(), leaf.ctx.roads
    if here is not None or roads is None:
        return here or along
    on = roads.locate(first.x, first.y, first.z)
    return along if on is None else along._replace(h=roads.map.pose(on).h)


def note_schedule(leaf: Leaf, corners: Sequence[Waypoint]) -> None:
    """Report how late an actor gets where the speed of a trajectory jumps: it has limits."""
    stretches = [math.hypot(b.x - a.x, b.y - a.y) / (b.time - a.time) for a, b in pairwise(corners)]
    speed, limits = leaf.state.known_speed, leaf.limits
    begin = [] if speed is None else [speed]
    off = 0.0
    for before, after in pairwise((*begin, *stretches)):
        rate = limits.acceleration if after > before else limits.deceleration
        off += (after - before) ** 2 / (2.0 * rate)
    if off > NEAR:
        leaf.approximate(
            "the speed of the trajectory jumps; the line of the XML does so, the actor within its"
            " limits",
            Metres(off, "late"),
            JUMPING,
        )


# --- where lines begin and end --------------------------------------------------------------------

ALONG_ITS_LANE = ("lane_relative", "object_relative", "road_relative")
"""Frames whose x axis is the direction of the lane."""

ARRIVING = Remedy(instead="a trajectory that begins where the actor is is exact")
PARALLEL = Remedy(instead="a way whose last stretch is parallel to its lane is exact")


def note_jump(leaf: Leaf, first: Waypoint) -> None:
    """Report that a trajectory with times begins where it does: the XML jumps there, if need be."""
    here, bound = (
        leaf.start_pose(),
        "by the way from where it is to the first point, until it is there",
    )
    if here is not None:
        missing = math.hypot(first.x - here.x, first.y - here.y)
        if missing <= NEAR:
            return
        bound = f"at most {missing:.3g} m, until it is there"
    leaf.approximate(
        "the XML puts it on the first point, in the world it drives there as fast as it can",
        bound,
        ARRIVING,
    )


def note_slant(
    leaf: Leaf, line: Line, corners: Sequence[Waypoint], lane: LanePosition | None, speed: float
) -> float:
    """Report what a slant at the end of a way makes; return the speed across the lane there.

    The lane is that in which the way ends, the speed (m/s) that at its end.
    """
    before, end = corners[-2], corners[-1]
    heading = math.atan2(end.y - before.y, end.x - before.x)
    if line.frame is None and lane is not None and leaf.ctx.roads is not None:
        heading -= leaf.ctx.roads.map.pose(lane).h
    elif line.frame not in ALONG_ITS_LANE:
        return 0.0
    drift = abs(speed * math.sin(heading))
    course = course_of_shift(0.0, Pace(), leaf.limits, drift)
    off = apart(course, Linear(0.0, 0.0, course.duration)) if course.duration > 0.0 else 0.0
    if off <= NEAR or leaf.member.walks or ir.is_last(leaf.ctx.scenario.body, leaf.node):
        return 0.0
    leaf.approximate(
        "at its end it is on a slant, and its speed across the lane runs out; in the XML it stops",
        Metres(off, "beside, when it is over"),
        PARALLEL,
    )
    return drift

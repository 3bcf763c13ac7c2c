"""Corners of paths: actors steer through them, the lines of the XML have them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from osc2tx.backends.xosc.actions.leaf import Leaf
from osc2tx.backends.xosc.actions.position.points_and_lines import Line
from osc2tx.backends.xosc.facts.actors import CRUISE
from osc2tx.backends.xosc.facts.curves import Waypoint
from osc2tx.backends.xosc.facts.followers import off_the_line
from osc2tx.backends.xosc.facts.maps import Pose
from osc2tx.backends.xosc.report import Metres, Remedy

NEAR = 0.05
"""Metres beside its line that count as on it."""

ON_THE_LINE = Remedy(
    instead="`replay_path`, or `physical_movement(prefer_non_physical)`, is on the line exactly",
    asks=("FollowTrajectoryAction",),
)
JUMPING = Remedy(
    instead="`replay_trajectory`, or `physical_movement(prefer_non_physical)`, jumps like the XML",
    asks=("FollowTrajectoryAction",),
)


def note_steering(
    leaf: Leaf,
    line: Line,
    corners: Sequence[Waypoint],
    offsets: tuple[float, float],
    speed: float | None = None,
) -> None:
    """Report how far an actor that steers along a way is from the line of the XML.

    Args:
        leaf: The invocation.
        line: Its way.
        corners: Of the line.
        offsets: Metres that are left out at start and end.
        speed: m/s; by default what is known of the actor.
    """
    start = _start(leaf, line, corners)
    here = Waypoint(0.0, start.x, start.y, start.z)
    is_there = math.hypot(corners[0].x - start.x, corners[0].y - start.y) < 1e-6
    speed = _speed(leaf) if speed is None else speed
    off = off_the_line(
        tuple(line.points),
        tuple(corners) if is_there else (here, *corners),
        start,
        speed,
        (leaf.member.shape, leaf.limits),
        is_smooth=line.is_smooth,
        offsets=offsets,
    )
    if off > NEAR:
        leaf.ctx.report.approximate(
            leaf.construct,
            leaf.node.span,
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
    state, roads = leaf.state, leaf.ctx.roads
    if state.pose is not None:
        return state.pose
    if roads is None:
        return along
    if state.lane is not None and leaf.is_start:
        return roads.pose(state.lane)
    on = roads.locate(first.x, first.y, first.z)
    return along if on is None else along._replace(h=roads.pose(on).h)


def note_schedule(leaf: Leaf, corners: Sequence[Waypoint]) -> None:
    """Report how late an actor gets where the speed of a trajectory jumps: it has limits."""
    stretches = [math.hypot(b.x - a.x, b.y - a.y) / (b.time - a.time) for a, b in pairwise(corners)]
    speed, limits = leaf.state.speed, leaf.limits
    begin = [] if speed is None or not speed.is_known else [speed.low]
    off = 0.0
    for before, after in pairwise((*begin, *stretches)):
        rate = limits.acceleration if after > before else limits.deceleration
        off += (after - before) ** 2 / (2.0 * rate)
    if off > NEAR:
        leaf.ctx.report.approximate(
            leaf.construct,
            leaf.node.span,
            "the speed of the trajectory jumps; the line of the XML does so, the actor within its"
            " limits",
            Metres(off, "late"),
            JUMPING,
        )

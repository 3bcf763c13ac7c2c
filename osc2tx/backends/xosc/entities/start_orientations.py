"""Orientation of actors at the start (§8.9.9, §8.9.10)."""

from __future__ import annotations

import math

from osc2tx.backends.xosc.actions.leaf import Arguments
from osc2tx.backends.xosc.actions.registry import at_start
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.start_statements import Start
from osc2tx.backends.xosc.entities.stationary_actors import stands
from osc2tx.backends.xosc.facts.actors import ALIGNED, Linear, apart, course_of_shift, lost_across
from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.report import Inexpressible, Metres, Remedy
from osc2tx.xosc import elements as xml

AXES = {"length_to_width": 0.5 * math.pi, "width_to_length": -0.5 * math.pi}
"""Angle (rad) between the lines that `yaw_measure_by` names."""

at_start("yaw", "orientation")

STRAIGHT = 1e-6
"""Sine of an angle to a lane that counts as none."""

NEAR = 0.05
"""Metres beside its lane that count as in it."""


def turned(ctx: Context, start: Start, along: float) -> tuple[float, float | None, float | None]:
    """Return heading, pitch and roll of who starts where the road has a heading (rad)."""
    yaw, orientation = start.modifiers.get("yaw"), start.modifiers.get("orientation")
    given = yaw or orientation
    if given is None:
        return along, None, None
    if yaw is not None:
        angle, pitch, roll = yaw.number("angle"), None, None
        if angle is None:
            angle = yaw.number("angle_range")
        measured = yaw.member("measure_by", "relative_to_road")
        base = 0.5 * math.pi if measured == "relative_to_north" else along
        base += AXES.get(measured, 0.0)
    else:
        angle, pitch, roll = (given.number(name) for name in ("yaw", "pitch", "roll"))
        measured = given.member("measure_by", "relative_to_road")
        base = along if measured == "relative_to_road" else 0.0
    other = given.entity("relative_to")
    if other is not None and measured != "absolute":
        base = _heading_of(ctx, other, given) + AXES.get(measured, 0.0)
    return base + (angle or 0.0), pitch, roll


def _heading_of(ctx: Context, other: CastMember, source: Arguments) -> float:
    pose = ctx.start_poses.get(other.name)
    if pose is None:
        raise Inexpressible(f"the heading of {other.name} is not known", source.source.span)
    return pose.h


def orientation_in_lane(
    ctx: Context, start: Start, place: LanePosition | None
) -> xml.Orientation | None:
    """Return how an actor on a lane is turned; `None`: along the lane.

    Raises:
        Inexpressible: Where the lane leads is not known.
    """
    if "yaw" not in start.modifiers and "orientation" not in start.modifiers:
        return None
    if ctx.roads is None or place is None:
        raise Inexpressible("where the lane leads is only known during the run", start.span)
    heading, pitch, roll = turned(ctx, start, ctx.roads.pose(place).h)
    return xml.Orientation(type="absolute", h=round(heading, 9), p=pitch or None, r=roll or None)


def note_turn(ctx: Context, start: Start) -> None:
    """Report that who drives and is turned in its lane comes into its direction in a curve.

    Raises:
        Inexpressible: It looks so far away from the lane that it does not come into it at all.
    """
    roads, member, pose = ctx.roads, start.member, ctx.start_poses.get(start.id)
    lane = None if pose is None or roads is None else roads.locate(*pose[:3])
    if member.walks or pose is None or roads is None or lane is None:
        return
    angle = math.remainder(pose.h - roads.pose(lane).h, math.tau)
    speed = ctx.states[member.name].speed
    v = 0.0 if speed is None else speed.low
    if abs(math.sin(angle)) < STRAIGHT or (v == 0.0 and stands(ctx, member.name)):
        return
    given = start.modifiers.get("yaw") or start.modifiers.get("orientation")
    span = start.span if given is None else given.source.span
    if math.cos(angle) <= 0.0:
        along = Remedy(instead="a heading along its lane is exact")
        raise Inexpressible("it looks away from its lane, in which a tool may keep it", span, along)
    bound: Metres | str = "until it is in its lane, as far as the curve is longer"
    if v > 0.0 and abs(angle) <= ALIGNED:
        rate = v * math.sin(angle)
        course = course_of_shift(-lane.offset, "none", None, None, member.limits, rate)
        off = math.hypot(apart(course, Linear(0.0, 0.0, 0.0)), lost_across(course, v))
        if off <= NEAR:
            return
        bound = Metres(off, "beside its lane")
    reason = "it comes into the direction of its lane in a curve; a tool may turn it at once"
    ctx.report.approximate("orientation at the start", span, reason, bound)

"""From lane and road coordinates to poses."""

from __future__ import annotations

import math

from .geometry import wrap
from .model import Lane, Pose, Road


def lane_pose(lane: Lane, s: float, offset: float) -> Pose:
    """Pose on a lane at an offset (m, left in direction of travel)."""
    road, direction = lane.road, lane.direction
    t, slope = lane.centre.value_slope(s)
    t += offset * direction
    if not road.is_flat:
        level = None if lane.level_from is None else lane.level_from.value_slope(s)
        pose = surface_pose(road, s, t, slope, direction, level=level)
        return pose if lane.heights is None else pose._replace(z=pose.z + lane.height_at(s, t))
    x, y, h, k = road.reference.at(s)
    heading = h + math.atan2(slope, 1.0 - k * t) if slope else h
    if direction < 0:
        heading += math.pi
    return Pose(x - t * math.sin(h), y + t * math.cos(h), lane.height_at(s, t), wrap(heading))


def surface_pose(
    road: Road,
    s: float,
    t: float,
    slope: float,
    direction: int,
    *,
    tangent: bool = False,
    level: tuple[float, float] | None = None,
) -> Pose:
    """Pose with height, pitch and roll.

    Args:
        road: The road.
        s: Road coordinate (m).
        t: Road coordinate (m).
        slope: dt/ds of the followed line.
        direction: Of travel: 1 along s, -1 against it.
        tangent: Heading of the reference line, instead of that of the followed line.
        level: For a level lane, t (m) and dt/ds of the edge with its height.
    """
    x, y, h, k = road.reference.at(s)
    lateral, drift = t, slope
    if road.superelevation is not None:
        bank, rate = road.superelevation.value_slope(s)
        c = math.cos(bank)
        lateral, drift = t * c, slope * c - t * math.sin(bank) * rate
    z, climb, roll = _height(road, s, *(level or (t, slope)))
    if level is not None:
        roll = 0.0
    along = 1.0 if tangent else 1.0 - k * lateral
    heading = h if tangent else h + math.atan2(drift, along)
    pitch = -math.atan2(climb * direction, math.hypot(along, 0.0 if tangent else drift))
    if direction < 0:
        heading += math.pi
    return Pose(
        x - lateral * math.sin(h),
        y + lateral * math.cos(h),
        z,
        wrap(heading),
        pitch,
        roll * direction,
    )


def _height(road: Road, s: float, t: float, slope: float) -> tuple[float, float, float]:
    """Height (m), its change along a line with dt/ds `slope`, and roll (rad)."""
    z = climb = roll = 0.0
    if road.elevation is not None:
        z, climb = road.elevation.value_slope(s)
    if road.superelevation is not None:
        roll, rate = road.superelevation.value_slope(s)
        c, n = math.cos(roll), math.sin(roll)
        z += t * n
        climb += slope * n + t * c * rate
    if road.cross_section is not None:
        height, along, across = road.cross_section.at(s, t)
        z += height
        climb += along + across * slope
        roll += math.atan(across)
    return z, climb, roll

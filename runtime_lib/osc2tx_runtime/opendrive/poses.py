"""From lane and road coordinates to poses."""

from __future__ import annotations

import math

from .lane_advance import wrap
from .model import Lane, Pose, Road

__all__ = ["lane_pose", "surface_pose"]


def lane_pose(lane: Lane, s: float, offset: float) -> Pose:
    """Pose on a lane at an offset (m, left in direction of travel)."""
    road, direction = lane.road, lane.direction
    t, slope = lane.centre.value_slope(s)
    t += offset * direction
    if road.elevation is not None or road.superelevation is not None:
        pose = surface_pose(road, s, t, slope, direction)
        return pose if lane.heights is None else pose._replace(z=pose.z + lane.height_at(s, t))
    x, y, h, k = road.reference.at(s)
    heading = h + math.atan2(slope, 1.0 - k * t) if slope else h
    if direction < 0:
        heading += math.pi
    return Pose(x - t * math.sin(h), y + t * math.cos(h), lane.height_at(s, t), wrap(heading))


def surface_pose(
    road: Road, s: float, t: float, slope: float, direction: int, *, tangent: bool = False
) -> Pose:
    """Pose with height, pitch and roll. `slope` is dt/ds of the line that is followed."""
    x, y, h, k = road.reference.at(s)
    z = climb = roll = 0.0
    lateral, drift = t, slope
    if road.elevation is not None:
        z, climb = road.elevation.value_slope(s)
    if road.superelevation is not None:
        roll, rate = road.superelevation.value_slope(s)
        c, n = math.cos(roll), math.sin(roll)
        z += t * n
        climb += slope * n + t * c * rate
        lateral, drift = t * c, slope * c - t * n * rate
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

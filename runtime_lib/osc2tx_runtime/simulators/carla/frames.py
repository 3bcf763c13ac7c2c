"""Frames and units: right-handed (ISO 8855) in radians here, left-handed in degrees in CARLA.

Ours: x east, y north, z up; heading counter-clockwise, pitch nose down, roll right side down.
CARLA's: y to the south; yaw clockwise, pitch nose up, roll right side down.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.opendrive.geometry import wrap
from osc2tx_runtime.world.measuring.measurement import Measurement


def transform_of(pose: Pose, ahead: float = 0.0, up: float = 0.0) -> list[float]:
    """Return x, y, z, pitch, yaw, roll in CARLA.

    Args:
        pose: Of the reference point.
        ahead: Metres from the actor's origin in CARLA forwards to the reference point.
        up: Metres from the ground to that origin.
    """
    x, y = pose.x - ahead * math.cos(pose.h), pose.y - ahead * math.sin(pose.h)
    turn = (-math.degrees(pose.pitch), -math.degrees(pose.h), math.degrees(pose.roll))
    return [x, -y, pose.z + up, *turn]


def pose_from(transform: Sequence[float], ahead: float = 0.0, up: float = 0.0) -> Pose:
    """Return the pose of the reference point; see `transform_of`."""
    x, y, z, pitch, yaw, roll = transform
    h = wrap(-math.radians(yaw))
    place = (x + ahead * math.cos(h), -y + ahead * math.sin(h), z - up, h)
    return Pose(*place, -math.radians(pitch), math.radians(roll))


def vector_of(speed: float, heading: float) -> list[float]:
    """Return the velocity (m/s) in CARLA's axes of an actor that moves along its heading."""
    return [speed * math.cos(heading), -speed * math.sin(heading), 0.0]


def turning_of(start: Sequence[float], goal: Sequence[float], dt: float) -> list[float]:
    """Return the angular velocity (degrees/s, axes of CARLA's world) between two transforms.

    Args:
        start: x, y, z, pitch, yaw, roll in CARLA.
        goal: Likewise, `dt` seconds later.
        dt: s.
    """
    pitch, yaw, roll = (
        math.remainder(after - before, 360.0) / dt
        for before, after in zip(start[3:6], goal[3:6], strict=True)
    )
    heading = -math.radians(start[4] + 0.5 * yaw * dt)
    ahead, aside = math.cos(heading), math.sin(heading)
    # `v = w x r` holds by components: nose up and right side down are negative about y and x.
    return [-(roll * ahead + pitch * aside), roll * aside - pitch * ahead, yaw]


def measurement_from(state: Sequence[float], ahead: float = 0.0, up: float = 0.0) -> Measurement:
    """Return the motion of an actor at its reference point.

    Args:
        state: Transform, velocity (m/s), turning (degrees/s), acceleration (m/s^2): 15 numbers.
        ahead: As for `transform_of`.
        up: Likewise.
    """
    pose = pose_from(state[:6], ahead, up)
    vx, vy, vz = state[6], -state[7], state[8]
    # Rotations involve two axes: with y inverted, only the rotation about y keeps its sign.
    turning = (-math.radians(state[9]), math.radians(state[10]), -math.radians(state[11]))
    ahead_x, ahead_y = math.cos(pose.h), math.sin(pose.h)
    forwards = vx * ahead_x + vy * ahead_y
    left = -vx * ahead_y + vy * ahead_x + turning[2] * ahead
    return Measurement(pose, (forwards, left, vz), None, turning)

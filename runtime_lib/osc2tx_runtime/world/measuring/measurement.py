"""Measurements of an actor by a plant, and the motion derived from them.

A simulator reports the speed of an actor, and perhaps its accelerations and rates; missing ones are
derived from one step to the next and smoothed, as measured numbers are noisy.
"""

from __future__ import annotations

from typing import NamedTuple

from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world.geometry.curve import turn_between

from .measured import Measured
from .velocities import (
    Acceleration,
    OrientationAcceleration,
    OrientationRate,
    TranslationalAcceleration,
    TranslationalVelocity,
    Velocity,
)

_SMOOTHING = 0.2  # s: time constant

Vector = tuple[float, float, float]


class Measurement(NamedTuple):
    """Pose and motion of an actor at its reference point.

    Attributes:
        pose: Position of the reference point, heading, pitch and roll.
        velocity: m/s forwards, to the left and upwards, in its own axes.
        acceleration: m/s^2 in the same axes; None: from the change of the velocity.
        turning: rad/s about the same axes (roll, pitch, yaw); None: from the change of the pose.
    """

    pose: Pose
    velocity: Vector
    acceleration: Vector | None = None
    turning: Vector | None = None


class MeasuredMotion:
    """Velocity and acceleration of one actor in its own axes."""

    def __init__(self, first: Measurement) -> None:
        self._last = first
        self._turning = first.turning or (0.0, 0.0, 0.0)
        self._acceleration = first.acceleration or (0.0, 0.0, 0.0)
        self._faster: Vector = (0.0, 0.0, 0.0)

    def step(self, found: Measurement, dt: float) -> None:
        """Add the measurement of the next step."""
        before, turning = self._last, found.turning
        if turning is None:
            a, b = before.pose, found.pose
            turn = turn_between(a.h, b.h) / dt
            rates = ((b.roll - a.roll) / dt, (b.pitch - a.pitch) / dt, turn)
            turning = _smoothed(self._turning, rates, dt)
        gained = _per(self._turning, turning, dt)
        self._faster = _smoothed(self._faster, gained, dt)
        self._turning = turning
        if found.acceleration is not None:
            self._acceleration = found.acceleration
        else:
            changed, turned = _per(before.velocity, found.velocity, dt), _cross(turning, found)
            own = (changed[0] + turned[0], changed[1] + turned[1], changed[2] + turned[2])
            self._acceleration = _smoothed(self._acceleration, own, dt)
        self._last = found

    @property
    def forwards(self) -> float:
        """Acceleration (m/s^2) forwards."""
        return self._acceleration[0]

    @property
    def velocity(self) -> Velocity:
        """Velocity (m/s) and turning (rad/s)."""
        return Velocity(
            TranslationalVelocity(*map(Measured, self._last.velocity)),
            OrientationRate(*map(Measured, self._turning)),
        )

    @property
    def acceleration(self) -> Acceleration:
        """Acceleration (m/s^2) and change of turning (rad/s^2)."""
        return Acceleration(
            TranslationalAcceleration(*map(Measured, self._acceleration)),
            OrientationAcceleration(*map(Measured, self._faster)),
        )


def _cross(turning: Vector, found: Measurement) -> Vector:
    """Effect of turning on the acceleration in the moving axes."""
    (p, q, r), (x, y, z) = turning, found.velocity
    return q * z - r * y, r * x - p * z, p * y - q * x


def _per(before: Vector, after: Vector, dt: float) -> Vector:
    x, y, z = ((new - old) / dt for old, new in zip(before, after, strict=True))
    return x, y, z


def _smoothed(before: Vector, now: Vector, dt: float) -> Vector:
    share = dt / (_SMOOTHING + dt)
    x, y, z = (old + share * (new - old) for old, new in zip(before, now, strict=True))
    return x, y, z

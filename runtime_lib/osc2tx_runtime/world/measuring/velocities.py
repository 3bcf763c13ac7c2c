"""Velocities and accelerations of actors over ground, in their own axes (DSL 8.7.5, 8.14.2).

The axes follow ISO 8855: x forward, y to the left, z up; turns are counter-clockwise about them, so
nose down is a positive pitch rate.
"""

from __future__ import annotations

import math

from osc2tx_shared.classes import dataclass

from .measured import Measured


@dataclass(frozen=True, slots=True)
class TranslationalVelocity:
    """A velocity along the axes (m/s)."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    def norm(self) -> float:
        """Magnitude (m/s)."""
        return Measured(math.hypot(self.x, self.y, self.z))


@dataclass(frozen=True, slots=True)
class OrientationRate:
    """Turning about the axes (rad/s)."""

    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0


@dataclass(frozen=True, slots=True)
class Velocity:
    """Velocity and turning of an object."""

    translational: TranslationalVelocity = TranslationalVelocity()
    angular: OrientationRate = OrientationRate()


@dataclass(frozen=True, slots=True)
class TranslationalAcceleration:
    """An acceleration along the axes (m/s^2)."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    def norm(self) -> float:
        """Magnitude (m/s^2)."""
        return Measured(math.hypot(self.x, self.y, self.z))


@dataclass(frozen=True, slots=True)
class OrientationAcceleration:
    """Changes of the rates about the axes (rad/s^2)."""

    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0


@dataclass(frozen=True, slots=True)
class Acceleration:
    """Change of the motion of an object."""

    translational: TranslationalAcceleration = TranslationalAcceleration()
    angular: OrientationAcceleration = OrientationAcceleration()

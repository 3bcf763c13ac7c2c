"""Plain values of the domain model that scenarios pass around, SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

__all__ = ["CelestialLightSource", "OdrPoint", "Orientation", "Point", "Pose"]


@dataclass(frozen=True, slots=True)
class Point:
    """A point in world coordinates (m)."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    def norm(self) -> float:
        """Distance from the origin (m)."""
        return math.sqrt(self.x * self.x + self.y * self.y + self.z * self.z)


@dataclass(frozen=True, slots=True)
class Orientation:
    """An orientation (rad), applied in the order yaw, pitch, roll (ISO 8855)."""

    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0


@dataclass(frozen=True, slots=True)
class Pose:
    """A point (m) with an orientation (rad)."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0

    @property
    def position(self) -> Point:
        """Where it is."""
        return Point(self.x, self.y, self.z)

    @property
    def orientation(self) -> Orientation:
        """How it is turned."""
        return Orientation(self.roll, self.pitch, self.yaw)


@dataclass(frozen=True, slots=True)
class CelestialLightSource:
    """The sun or the moon.

    Attributes:
        name: `sun` or `moon`.
    """

    name: Literal["sun", "moon"]


@dataclass(frozen=True, slots=True)
class OdrPoint:
    """A point in road coordinates.

    Attributes:
        road_id: Road.
        lane_id: Lane; None: `t` counts from the reference line of the road.
        s: Road coordinate (m).
        t: Metres to the left in the direction of s, from the lane's centre or the reference line.
    """

    road_id: str
    lane_id: str | int | None
    s: float
    t: float = 0.0

"""Kinematic single-track model: a vehicle whose wheels do not slip, at its rear axle.

x' = v cos h, y' = v sin h, h' = v tan(steering) / wheelbase, v' = acceleration; over a step the
acceleration and the curvature are constant, so that the way is an arc of a circle exactly.
"""

from __future__ import annotations

import math

from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world.actor_dimensions import Limits, Shape
from osc2tx_runtime.world.geometry.curve import turn_between

from .driving import Control


class SingleTrack:
    """One vehicle.

    Attributes:
        pose: Of the middle of its rear axle, level.
        speed: m/s, never negative.
        yaw_rate: rad/s over the last step.
    """

    def __init__(self, pose: Pose, speed: float, shape: Shape) -> None:
        self.pose, self.speed, self.yaw_rate = pose, speed, 0.0
        self._shape = shape

    def step(self, control: Control, limits: Limits, grip: float, dt: float) -> None:
        """Advance by a time.

        Args:
            control: The controls of its driver.
            limits: The limits of the vehicle.
            grip: Acceleration (m/s^2) that the road transmits in all directions together.
            dt: Seconds.
        """
        bend = self._bend(control.steering, grip)
        across = min(abs(bend) * self.speed**2, grip)
        left = math.sqrt(grip**2 - across**2)
        most, least = min(limits.acceleration, left), -min(limits.deceleration, left)
        rate = min(max(control.acceleration, least), most)
        after = max(self.speed + rate * dt, 0.0)
        way = 0.5 * (self.speed + after) * dt
        if after == 0.0 and rate < 0.0:
            way = -0.5 * self.speed**2 / rate  # it stands before the step is over
        self._go(way, bend * way)
        self.speed, self.yaw_rate = after, bend * way / dt

    def _bend(self, steering: float, grip: float) -> float:
        """Curvature (1/m) of its way, as sharp as steering and road allow."""
        most = self._shape.steering
        bend = math.tan(min(max(steering, -most), most)) / self._shape.wheelbase
        limit = grip / self.speed**2 if self.speed > 0.0 else math.inf
        return min(max(bend, -limit), limit)

    def _go(self, way: float, turn: float) -> None:
        half = 0.5 * turn
        chord = way * math.sin(half) / half if abs(half) > 1e-9 else way
        h = self.pose.h + half
        self.pose = Pose(
            self.pose.x + chord * math.cos(h),
            self.pose.y + chord * math.sin(h),
            self.pose.z,
            turn_between(0.0, self.pose.h + turn),
        )

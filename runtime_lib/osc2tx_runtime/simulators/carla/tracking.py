"""Controllers: a driven actor follows its reference.

Vehicles have a PI controller of the speed with feed-forward of the acceleration, and steer by pure
pursuit: towards a point ahead on the path, along a circle from the rear axle through it (R. C.
Coulter, Implementation of the Pure Pursuit Path Tracking Algorithm, CMU-RI-TR-92-01).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from osc2tx_runtime.world.measuring.measurement import Measurement
from osc2tx_runtime.world.plant.scene import Setpoint
from osc2tx_shared.classes import dataclass

from .gains import Gains

LEAST_SHARE = 0.05  # of the full lock: least share of a steering curve
STANDING = 0.5  # m/s below which brakes hold a vehicle at standstill
HOLD = 0.6  # of the brake
NEAR = 0.5  # m: a nearer point does not define steering
CATCHING_UP = 1.0  # m/s added to the speed of a walker to return to its path


class Pedals(NamedTuple):
    """Throttle and brake, from 0 to 1, and whether the gear is reverse."""

    throttle: float
    brake: float
    reverse: bool


@dataclass
class SpeedControl:
    """Keeps a speed.

    Attributes:
        gains: Of the vehicle.
    """

    gains: Gains
    _sum: float = 0.0

    def reset(self) -> None:
        """Reset the integral: the vehicle was teleported, or its speed was set."""
        self._sum = 0.0

    def pedals(self, wanted: float, acceleration: float, speed: float, dt: float) -> Pedals:
        """Return the pedals for the next step.

        Args:
            wanted: Speed at its end (m/s).
            acceleration: Likewise (m/s^2).
            speed: Measured speed at its start (m/s).
            dt: Its length (s).
        """
        if wanted == 0.0 and abs(speed) < STANDING:
            self._sum = 0.0
            return Pedals(0.0, HOLD, False)
        back = wanted < 0.0 or (wanted == 0.0 and speed < 0.0)
        if speed < -STANDING if wanted > 0.0 else back and speed > STANDING:
            self._sum = 0.0  # it rolls in the other direction: the gear only changes at standstill
            return Pedals(0.0, HOLD, False)
        sign = -1.0 if back else 1.0
        error, rate = sign * (wanted - speed), sign * acceleration
        gains = self.gains
        forward = rate * (gains.throttle if rate > 0.0 else gains.brake)
        pedal = gains.proportional * error + gains.integral * (self._sum + error * dt) + forward
        if abs(pedal) < 1.0:
            self._sum += error * dt
        pedal = min(max(pedal, -1.0), 1.0)
        return Pedals(max(pedal, 0.0), max(-pedal, 0.0), back)


@dataclass
class Steering:
    """Steers a vehicle.

    Attributes:
        wheelbase: m.
        largest: Angle of the wheels at full lock (rad).
        gains: Of the vehicle.
        curve: Share of that angle that the simulator allows, by ascending speed (m/s).
    """

    wheelbase: float
    largest: float
    gains: Gains
    curve: Sequence[tuple[float, float]] = ()
    _last: float = 0.0

    def steer(self, setpoint: Setpoint, now: Measurement) -> float:
        """Return the steering from -1 (full lock to the left) to 1."""
        speed, at = now.velocity[0], now.pose
        look = max(self.gains.wheelbases * self.wheelbase, self.gains.look * abs(speed))
        back = setpoint.state.v < 0.0
        goal = setpoint.ahead(-look if back else look)
        dx, dy = goal.x - at.x, goal.y - at.y
        far = math.hypot(dx, dy)
        if far > NEAR:
            aside = -dx * math.sin(at.h) + dy * math.cos(at.h)  # to the left
            self._last = math.atan(2.0 * self.wheelbase * aside / far**2)
        return min(max(-self._last / (self.largest * self._share(abs(speed))), -1.0), 1.0)

    def _share(self, speed: float) -> float:
        """Return the share of the full lock at a speed (m/s)."""
        share = self.curve[-1][1] if self.curve else 1.0
        for (slow, more), (fast, less) in pairwise(self.curve):
            if speed < fast:
                share = more + (less - more) * max(speed - slow, 0.0) / (fast - slow)
                break
        return max(share, LEAST_SHARE)


def walking(setpoint: Setpoint, now: Measurement, dt: float) -> tuple[float, float, float]:
    """Return the direction of a walker, as a vector in ISO 8855 axes, and its speed (m/s)."""
    goal, at = setpoint.state, now.pose
    dx, dy = goal.x - at.x, goal.y - at.y
    far = math.hypot(dx, dy)
    speed = min(far / dt, abs(goal.v) + CATCHING_UP)
    if far < 1e-4:
        return math.cos(goal.h), math.sin(goal.h), 0.0
    return dx / far, dy / far, speed

"""Gains of the vehicle controllers, by category."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple


class Gains(NamedTuple):
    """Gains of a vehicle's controllers.

    Attributes:
        proportional: Pedal per m/s of error.
        integral: Pedal per metre of the integrated error.
        throttle: Throttle per m/s^2 of required acceleration.
        brake: Pedal per m/s^2 of braking.
        look: Look-ahead time (s) of the steering.
        wheelbases: Least look-ahead distance, in wheelbases.
    """

    proportional: float
    integral: float
    throttle: float
    brake: float
    look: float = 0.5
    wheelbases: float = 2.0


CAR = Gains(0.35, 0.25, 0.2, 0.125)

GAINS: Mapping[str, Gains] = {
    "car": CAR,
    "van": Gains(0.4, 0.25, 0.25, 0.125),
    "bus": Gains(0.5, 0.3, 0.33, 0.125),
    "heavy_truck": Gains(0.5, 0.3, 0.33, 0.125),
    "motorcycle": Gains(0.3, 0.2, 0.17, 0.125),
    "bicycle": Gains(0.6, 0.4, 0.5, 0.125, 0.5, 3.0),
}
"""Gains by vehicle category; the others take those of a car. Determined on a kinematic single-track
model; vehicles of a real server may need others."""

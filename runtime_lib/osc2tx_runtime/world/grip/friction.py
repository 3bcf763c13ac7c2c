"""Tyre-road friction by weather.

The accelerations of a vehicle stay within the friction circle: the sum of the squares of the
longitudinal and the lateral one is at most (mu g)^2.

The coefficients are chosen for this runtime, one round number for each road condition. Published
values vary with surface, tyre, speed and depth of the water: R. K. Noon, Engineering Analysis of
Vehicular Accidents (CRC Press, 1994) has 0.5 to 0.6 for wet asphalt and concrete, 0.20 to 0.25 for
snow, 0.10 to 0.15 for ice. W. Bartlett's reviews of braking tests on dry asphalt have 0.76 with
locked wheels and 0.82 with antilock brakes, each with a standard deviation of 0.07; the 0.9 here is
the upper end, so that all motions reported as impossible are impossible. On a dry road no motion is
reduced: excess is reported (`feasibility`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal

from osc2tx_runtime.opendrive import LanePosition, RoadMap, Route
from osc2tx_runtime.world.actor_dimensions import RATE_CAP, Limits
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.state import ActorState
from osc2tx_shared.classes import replace

GRAVITY = 9.80665
"""m/s^2"""

RoadCondition = Literal["dry", "wet", "snow", "ice"]

ADHESION: Mapping[RoadCondition, float] = {"wet": 0.6, "snow": 0.2, "ice": 0.1}
"""Coefficients of friction: wet road, snow, ice."""

DRY_ADHESION = 0.9
"""Coefficient of friction of a dry road; see above."""

_FREEZING = 273.15  # K

_WORDS: Mapping[RoadCondition, str] = {
    "dry": "",
    "wet": " on a wet road",
    "snow": " on snow",
    "ice": " on ice",
}


def road_condition(environment: Mapping[str, float]) -> RoadCondition:
    """Condition of the roads by weather: rain freezes below 0 degrees Celsius.

    Roads are wet or snow-covered exactly while it rains or snows.
    """
    if environment.get("snow_intensity", 0.0) > 0.0:
        return "snow"
    if environment.get("rain_intensity", 0.0) > 0.0:
        return "ice" if environment.get("temperature", _FREEZING) < _FREEZING else "wet"
    return "dry"


def adhesion_of(condition: RoadCondition) -> float:
    """Coefficient of friction of a road."""
    return ADHESION.get(condition, DRY_ADHESION)


def grip(condition: RoadCondition) -> float:
    """Largest acceleration (m/s^2) in any direction for commands.

    On a dry road explicit rates beyond `RATE_CAP` are rejected, and nothing is limited.
    """
    adhesion = ADHESION.get(condition)
    return RATE_CAP if adhesion is None else adhesion * GRAVITY


def held_by(limits: Limits, condition: RoadCondition) -> Limits:
    """The limits of a vehicle on a road in this condition."""
    most = grip(condition)
    if most >= max(limits.acceleration, limits.deceleration, limits.lateral):
        return limits
    return replace(
        limits,
        acceleration=min(limits.acceleration, most),
        deceleration=min(limits.deceleration, most),
        lateral=min(limits.lateral, most),
        road=_WORDS[condition],
    )


def along_limit(grip: float, across: float) -> float | None:
    """Longitudinal acceleration (m/s^2) that a lateral one leaves; None: the vehicle slides."""
    left = grip * grip - across * across
    return math.sqrt(left) if left >= 0.0 else None


_PROBE = 1.0  # m along the lane over which its curvature is taken


class Wheels:
    """Grip of one vehicle on the road.

    Attributes:
        road: Condition of the road.
        slipping: Whether it could not reach the commanded speed in the last step.
        sliding: Why it cannot follow its lane; None while it can.
    """

    def __init__(self, road: RoadCondition) -> None:
        self.road = road
        self.slipping = False
        self.sliding: str | None = None
        self._aside = 0.0  # m/s: lateral speed one step before

    @property
    def limited(self) -> bool:
        """Whether the road reduces the limits."""
        return self.road != "dry"

    def held(self, wanted: float, state: ActorState, curvature: float, dt: float) -> float:
        """Speed (m/s) at the next step: the commanded one, within the friction circle.

        Args:
            wanted: Commanded speed.
            state: Present state.
            curvature: Curvature of the path (1/m).
            dt: Length of the step (s).
        """
        across = state.v * state.v * curvature + (state.lateral_speed - self._aside) / dt
        self._aside = state.lateral_speed
        most = grip(self.road)
        left = along_limit(most, across)
        self.sliding = None
        if left is None:
            self.sliding = (
                f"it slides: lateral acceleration {abs(across):.2f} m/s^2 exceeds the grip limit of"
                f" {most:.2f} m/s^2"
            )
            left = 0.0
        speed = min(max(wanted, state.v - left * dt), state.v + left * dt)
        self.slipping = abs(speed - wanted) > 1e-9
        return speed


def curvature_ahead(road_map: RoadMap, place: LanePosition | None, route: Route | None) -> float:
    """Curvature (1/m) of the lane ahead; 0 off the lanes and at their end."""
    if place is None:
        return 0.0
    step = road_map.advance(place, _PROBE, route)
    if step.travelled < 0.5 * _PROBE:
        return 0.0
    turn = turn_between(road_map.pose(place).h, road_map.pose(step.position).h)
    return turn / step.travelled

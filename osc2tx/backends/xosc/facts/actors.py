"""Sizes, limits and speed courses of actors, from the runtime.

Of the compiler's stages only this folder imports the runtime: there must be one table of sizes, one
set of formulas for profiles and one reader of OpenDRIVE.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import floor, sqrt
from typing import NamedTuple, Protocol, cast

from osc2tx_runtime.enums import DynamicProfile
from osc2tx_runtime.world.actor_dimensions import (
    CATEGORIES,
    COMFORT,
    GENTLE,
    RGB,
    TOP_SPEED,
    TYRES,
    Limits,
    Shape,
    limits_of,
    shape_of,
)
from osc2tx_runtime.world.commands import AccelerationChange, SpeedChange
from osc2tx_runtime.world.geometry.profiles import (
    COSINE_PEAK,
    Cosine,
    Linear,
    Profile,
    Quintic,
    SCurve,
)
from osc2tx_runtime.world.grip.friction import ADHESION, held_by, road_condition
from osc2tx_runtime.world.lateral.execution import shift_profile
from osc2tx_runtime.world.longitudinal.acceleration import acceleration_profile, integral, simpson
from osc2tx_runtime.world.longitudinal.execution import speed_profile, within_limits
from osc2tx_runtime.world.motion.moving_body import ALIGNED
from osc2tx_runtime.world.motion.moving_body import CRUISE as SPEEDS_AT_START
from osc2tx_runtime.world.motion.towing import DRAWBAR
from osc2tx_runtime.world.plant.weather_effects import Surroundings

STEPS = 200
"""Of a numeric sum over a change."""

CRUISE = SPEEDS_AT_START["person"]
"""Speed (m/s) at which walkers set out."""


class Pace(NamedTuple):
    """How a change of a value goes.

    Attributes:
        profile: `none`, `constant`, `smooth` or `asap` (§8.8.2.18).
        peak: Of its rate; `None`: as the profile has it.
        duration: Seconds that it takes; likewise.
    """

    profile: str = "none"
    peak: float | None = None
    duration: float | None = None

    @property
    def told(self) -> tuple[DynamicProfile, float | None, float | None]:
        """The same in terms of the runtime."""
        return cast("DynamicProfile", self.profile), self.peak, self.duration


FASTEST = Pace("asap")


class Course(Protocol):
    """A speed that changes for some time."""

    @property
    def duration(self) -> float:
        """Seconds."""

    def value(self, t: float) -> float:
        """Return the speed (m/s) after some seconds, the last one from `duration` on."""


def automatic_light(weather: Mapping[str, float]) -> str:
    """Return the mode of lights that follow sun and fog."""
    surroundings = Surroundings(1.0)
    surroundings.set(weather)
    return surroundings.automatic_light


def course_of_speed(start: float, target: float, pace: Pace, limits: Limits) -> Profile:
    """Return the course of a change of the speed (m/s) as the embedded world drives it."""
    change = within_limits(SpeedChange(target, *pace.told), start, TYRES)
    return speed_profile(change, start, limits)


def course_of_acceleration(
    start: float, target: float, pace: Pace, limits: Limits
) -> Linear | Quintic:
    """Return the course of a change of the acceleration (m/s^2) as the embedded world drives it."""
    return acceleration_profile(AccelerationChange(target, *pace.told), start, limits)


def course_of_shift(distance: float, pace: Pace, limits: Limits, rate: float = 0.0) -> Profile:
    """Return the course of a change of the place across the road (m), from a lateral speed."""
    return shift_profile(0.0, distance, rate, pace.told, limits)


def steepest(course: Course) -> tuple[float, float]:
    """Return the greatest acceleration and deceleration (m/s^2) of a course of the speed."""
    step = course.duration / STEPS
    if step <= 0.0:
        return 0.0, 0.0
    if isinstance(course, Linear | Cosine | Quintic | SCurve):
        rates = [course.rate(index * step) for index in range(STEPS + 1)]
    else:
        speeds = [course.value(index * step) for index in range(STEPS + 1)]
        rates = [(after - before) / step for before, after in pairwise(speeds)]
    if course.value(0.5 * course.duration) < 0.0:  # backwards
        rates = [-rate for rate in rates]
    faster, slower = max(rates), -min(rates)
    return (
        round(faster, 6) if faster > 0.0 else 0.0,
        round(slower, 6) if slower > 0.0 else 0.0,
    )

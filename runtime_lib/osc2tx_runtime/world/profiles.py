"""Closed forms of the rate profiles (OpenSCENARIO DSL 8.8.2.18).

A profile shapes the first derivative (the rate) of a controlled quantity: speed, or the lateral
offset. All forms are evaluated at absolute times since their start, never integrated, so the end
value is exact and the step size has no influence.

| profile    | form here                                                     |
|------------|---------------------------------------------------------------|
| `constant` | constant rate                                                 |
| `smooth`   | quintic: rate and its derivative are zero at both ends        |
| `asap`     | speed: trapezoid of the acceleration with limited jerk;       |
|            | lateral: quintic at the limit of the lateral acceleration     |
| `none`     | as `asap`, but with comfortable limits                        |
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, Protocol

__all__ = [
    "PROFILES",
    "DynamicProfile",
    "Linear",
    "Profile",
    "Quintic",
    "SCurve",
    "quintic_duration",
]

DynamicProfile = Literal["none", "constant", "smooth", "asap"]
PROFILES: tuple[DynamicProfile, ...] = ("none", "constant", "smooth", "asap")

QUINTIC_PEAK = 1.875  # peak rate of the quintic, in units of change / duration
QUINTIC_CURVE = 5.7735  # peak of the derivative of the rate, in units of change / duration^2


class Profile(Protocol):
    """Course of a quantity over the time since the start of a change."""

    @property
    def duration(self) -> float:
        """Time (s) at which the end value is reached."""

    def value(self, t: float) -> float:
        """Quantity at time t (s); the end value from `duration` on."""

    def rate(self, t: float) -> float:
        """First derivative of the quantity at time t (s); zero from `duration` on."""


@dataclass(frozen=True, slots=True)
class Linear:
    """Change at a constant rate.

    Attributes:
        start: Value at time 0.
        end: Value at `duration`.
        duration: Length of the change (s); 0 is a jump.
    """

    start: float
    end: float
    duration: float

    def value(self, t: float) -> float:
        """Quantity at time t (s)."""
        if t >= self.duration:
            return self.end
        return self.start + (self.end - self.start) * max(t, 0.0) / self.duration

    def rate(self, t: float) -> float:
        """Rate at time t (s)."""
        if t < 0.0 or t >= self.duration:
            return 0.0
        return (self.end - self.start) / self.duration


@dataclass(frozen=True, slots=True)
class Quintic:
    """Smooth change with zero rate at its end.

    Attributes:
        start: Value at time 0.
        end: Value at `duration`.
        duration: Length of the change (s); 0 is a jump.
        start_rate: Rate at time 0, for a change that takes over from another one.
    """

    start: float
    end: float
    duration: float
    start_rate: float = 0.0

    def value(self, t: float) -> float:
        """Quantity at time t (s)."""
        if t >= self.duration:
            return self.end
        tau = max(t, 0.0) / self.duration
        change, moved = self.end - self.start, self.start_rate * self.duration
        cubic, quartic, quintic = _coefficients(change, moved)
        return self.start + tau * (moved + tau * tau * (cubic + tau * (quartic + tau * quintic)))

    def rate(self, t: float) -> float:
        """Rate at time t (s)."""
        if t < 0.0 or t >= self.duration:
            return 0.0
        tau = t / self.duration
        moved = self.start_rate * self.duration
        cubic, quartic, quintic = _coefficients(self.end - self.start, moved)
        slope = moved + tau * tau * (3.0 * cubic + tau * (4.0 * quartic + 5.0 * quintic * tau))
        return slope / self.duration


def _coefficients(change: float, moved: float) -> tuple[float, float, float]:
    """Factors of tau^3, tau^4, tau^5 for rate and curvature zero at the end."""
    return (
        10.0 * change - 6.0 * moved,
        -15.0 * change + 8.0 * moved,
        6.0 * change - 3.0 * moved,
    )


def quintic_duration(change: float, *, rate_peak: float | None, curve_peak: float) -> float:
    """Length (s) of a quintic change from the peak of its rate, else of the rate's derivative."""
    if rate_peak is not None:
        return QUINTIC_PEAK * abs(change) / rate_peak
    return math.sqrt(QUINTIC_CURVE * abs(change) / curve_peak)


@dataclass(frozen=True, slots=True)
class SCurve:
    """Fastest change within a limit of the rate and of its derivative.

    Attributes:
        start: Value at time 0.
        end: Value at `duration`.
        limit: Largest absolute rate, e.g. acceleration (m/s^2).
        jerk: Largest absolute derivative of the rate (m/s^3).
    """

    start: float
    end: float
    limit: float
    jerk: float

    @property
    def ramp(self) -> float:
        """Time (s) in which the rate rises to its peak."""
        change = abs(self.end - self.start)
        if change >= self.limit * self.limit / self.jerk:
            return self.limit / self.jerk
        return math.sqrt(change / self.jerk)

    @property
    def duration(self) -> float:
        """Length of the change (s)."""
        change = abs(self.end - self.start)
        if change == 0.0:
            return 0.0
        if change >= self.limit * self.limit / self.jerk:
            return change / self.limit + self.limit / self.jerk
        return 2.0 * self.ramp

    def value(self, t: float) -> float:
        """Quantity at time t (s)."""
        duration = self.duration
        if t >= duration:
            return self.end
        t, ramp = max(t, 0.0), self.ramp
        sign = 1.0 if self.end > self.start else -1.0
        if t < ramp:
            return self.start + sign * 0.5 * self.jerk * t * t
        if t > duration - ramp:
            return self.end - sign * 0.5 * self.jerk * (duration - t) ** 2
        peak = self.jerk * ramp
        return self.start + sign * peak * (t - 0.5 * ramp)

    def rate(self, t: float) -> float:
        """Rate at time t (s)."""
        duration = self.duration
        if t < 0.0 or t >= duration:
            return 0.0
        sign = 1.0 if self.end > self.start else -1.0
        return sign * self.jerk * min(t, self.ramp, duration - t)

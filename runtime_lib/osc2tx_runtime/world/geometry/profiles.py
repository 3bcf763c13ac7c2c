"""Rate profiles in closed form (DSL 8.8.2.18).

A profile shapes the first derivative (the rate) of a controlled quantity: speed, or the lateral
offset. All forms are evaluated at absolute times since their start, not integrated, so the end
value is exact and the step size has no influence.

| profile    | form here                                                     |
|------------|---------------------------------------------------------------|
| `constant` | constant rate                                                 |
| `smooth`   | half a cosine, the `sinusoidal` shape of OpenSCENARIO XML;    |
|            | lateral, on from a rate: quintic                              |
| `asap`     | speed: trapezoid of the acceleration with limited jerk;       |
|            | lateral: as `smooth`, at the limit of the acceleration        |
| `none`     | speed: as `asap`, but with comfortable limits; lateral: as    |
|            | `smooth`                                                      |
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import Protocol, get_args

from osc2tx_runtime.enums import DynamicProfile
from osc2tx_shared.classes import dataclass

PROFILES: tuple[DynamicProfile, ...] = get_args(DynamicProfile)

COSINE_PEAK = math.pi / 2.0  # peak rate of half a cosine, in units of change / duration
COSINE_CURVE = math.pi**2 / 2.0  # peak of the derivative, in units of change / duration^2
QUINTIC_PEAK = 1.875  # peak rate of the quintic, in units of change / duration


class Profile(Protocol):
    """A quantity over the time since the start of a change."""

    @property
    def duration(self) -> float:
        """Time (s) at which the end value is reached."""

    def value(self, t: float) -> float:
        """Quantity at time t (s); the end value after `duration`."""

    def rate(self, t: float) -> float:
        """First derivative of the quantity at time t (s); zero after `duration`."""


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
class Cosine:
    """Smooth change along half a cosine.

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
        part = 0.5 - 0.5 * math.cos(math.pi * max(t, 0.0) / self.duration)
        return self.start + (self.end - self.start) * part

    def rate(self, t: float) -> float:
        """Rate at time t (s)."""
        if t < 0.0 or t >= self.duration:
            return 0.0
        peak = COSINE_PEAK * (self.end - self.start) / self.duration
        return peak * math.sin(math.pi * t / self.duration)


def cosine_duration(change: float, rate_peak: float) -> float:
    """Length (s) of a cosine change from the peak of its rate."""
    return COSINE_PEAK * abs(change) / rate_peak


def fastest_cosine(change: float, curve_peak: float) -> float:
    """Length (s) of a cosine change from the peak of the derivative of its rate."""
    return math.sqrt(COSINE_CURVE * abs(change) / curve_peak)


@dataclass(frozen=True, slots=True)
class Quintic:
    """Smooth change with zero rate at its end.

    Attributes:
        start: Value at time 0.
        end: Value at `duration`.
        duration: Length of the change (s); 0 is a jump.
        start_rate: Rate at time 0, for a change that continues another.
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


@dataclass(frozen=True)  # its parts are computed once
class SCurve:
    """Fastest change within a limit of the rate and of its derivative.

    Attributes:
        start: Value at time 0.
        end: Value at `duration`.
        limit: Largest absolute rate, e.g. acceleration (m/s^2).
        jerk: Largest absolute derivative of the rate (m/s^3).
        start_rate: Rate at time 0, for a change that continues another; it may exceed the limit,
            and then returns to it.
    """

    start: float
    end: float
    limit: float
    jerk: float
    start_rate: float = 0.0

    @cached_property
    def _sign(self) -> float:
        """Direction of the remaining change after the present rate has decayed."""
        gone = self.start + self.start_rate * abs(self.start_rate) / (2.0 * self.jerk)
        return 1.0 if self.end >= gone else -1.0

    @cached_property
    def _parts(self) -> tuple[float, float, float]:
        """Times (s) at which the rate reaches its peak, leaves it, and reaches zero."""
        jerk, sign = self.jerk, self._sign
        rate = sign * self.start_rate
        double = 2.0 * jerk * sign * (self.end - self.start)  # of the peak's square, but for `rate`
        peak = min(self.limit, math.sqrt(max(0.5 * (double + rate * rate), 0.0)))
        if rate > peak:
            flat = (double - rate * rate) / (2.0 * jerk * peak) if peak > 0.0 else 0.0
            to_peak = (rate - peak) / jerk
        else:
            flat = (double + rate * rate - 2.0 * peak * peak) / (2.0 * jerk * peak) if peak else 0.0
            to_peak = (peak - rate) / jerk
        leaves = to_peak + max(flat, 0.0)
        return to_peak, leaves, leaves + peak / jerk

    @property
    def duration(self) -> float:
        """Length of the change (s)."""
        return self._parts[2]

    @property
    def kinks(self) -> tuple[float, float, float]:
        """Times (s) at which the derivative of the rate changes; between them it is constant."""
        return self._parts

    def value(self, t: float) -> float:
        """Quantity at time t (s)."""
        to_peak, leaves, duration = self._parts
        if t >= duration:
            return self.end
        t, sign = max(t, 0.0), self._sign
        if t > leaves:
            return self.end - sign * 0.5 * self.jerk * (duration - t) ** 2
        peak = self.jerk * (duration - leaves)
        slope = self._slope(peak)
        at_start = self.start + self.start_rate * min(t, to_peak)
        begun = at_start + sign * 0.5 * slope * min(t, to_peak) ** 2
        return begun + sign * peak * max(t - to_peak, 0.0)

    def rate(self, t: float) -> float:
        """Rate at time t (s)."""
        to_peak, leaves, duration = self._parts
        if t < 0.0 or t >= duration:
            return 0.0
        if t > leaves:
            return self._sign * self.jerk * (duration - t)
        peak = self.jerk * (duration - leaves)
        return self.start_rate + self._sign * self._slope(peak) * min(t, to_peak)

    def _slope(self, peak: float) -> float:
        """Derivative of the rate until its peak, in the direction of the change."""
        return -self.jerk if self._sign * self.start_rate > peak else self.jerk

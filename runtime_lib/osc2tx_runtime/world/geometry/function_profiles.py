"""Profiles given as functions of time, or with an initial rate.

See `profiles` for the closed forms without one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from osc2tx_runtime.enums import DynamicProfile
from osc2tx_runtime.world.actor_dimensions import COMFORT

from .profiles import Linear, Profile, Quintic

_SPAN = 1e-3  # s: half of the interval of a mean rate
_LONGEST = 3600.0  # s: no change takes longer
_HALVINGS = 60  # of that time; beyond the resolution of a float
_SAMPLES = 200  # of a profile, to find reversals
_ONE_WAY = 2.5  # change / rate: a smooth change that takes longer overshoots


class Computed:
    """A profile computed by a function: the quantity over the time since the start (s).

    Attributes:
        duration: Time of its end (s); infinite if it never ends.
    """

    def __init__(self, compute: Callable[[float], float], duration: float = math.inf) -> None:
        self._compute = compute
        self.duration = duration

    @property
    def start(self) -> float:
        """Quantity at the start."""
        return self._compute(0.0)

    @property
    def end(self) -> float:
        """Quantity at the end; at the start if it never ends."""
        return self._compute(0.0 if math.isinf(self.duration) else self.duration)

    def value(self, t: float) -> float:
        """Quantity at time t (s); after the end the last value."""
        return self._compute(min(max(t, 0.0), self.duration))

    def rate(self, t: float) -> float:
        """First derivative at time t (s), from two close values."""
        if t < 0.0 or t >= self.duration:
            return 0.0
        low, high = max(t - _SPAN, 0.0), min(t + _SPAN, self.duration)
        return (self._compute(high) - self._compute(low)) / (high - low)


class Mapped:
    """Another profile, scaled and shifted: `shift + factor * value`."""

    def __init__(self, course: Profile, factor: float, shift: float) -> None:
        self._course = course
        self._factor = factor
        self._shift = shift

    @property
    def duration(self) -> float:
        """When it ends (s)."""
        return self._course.duration

    def value(self, t: float) -> float:
        """Quantity at time t (s)."""
        return self._shift + self._factor * self._course.value(t)

    def rate(self, t: float) -> float:
        """First derivative at time t (s)."""
        return self._factor * self._course.rate(t)


class Peaks:
    """Largest rate of a smooth change, and largest derivative of the rate, by its length."""

    def __init__(self, change: float, rate: float) -> None:
        self._change = change
        self._rate = rate

    def rate(self, duration: float) -> float:
        """Largest rate, in absolute value."""
        course = Quintic(0.0, self._change, duration, self._rate)
        times = [tau * duration for tau in self._turning(duration)]
        return max(abs(self._rate), *(abs(course.rate(t)) for t in times), 0.0)

    def curve(self, duration: float) -> float:
        """Largest derivative of the rate, in absolute value."""
        c, q, k = _factors(self._change, self._rate * duration)

        def at(tau: float) -> float:
            return abs(tau * (6.0 * c + tau * (12.0 * q + 20.0 * k * tau)))

        turning = _roots(60.0 * k, 24.0 * q, 6.0 * c)
        return max(0.0, *(at(tau) for tau in turning), 0.0) / (duration * duration)

    def _turning(self, duration: float) -> Iterator[float]:
        c, q, k = _factors(self._change, self._rate * duration)
        yield from _roots(20.0 * k, 12.0 * q, 6.0 * c)

    def time_for(self, peak: float, of: Callable[[float], float]) -> float:
        """The length (s) for a peak; longer changes have smaller peaks."""
        short, long = 0.0, _LONGEST
        for _ in range(_HALVINGS):
            middle = 0.5 * (short + long)
            short, long = (middle, long) if of(middle) > peak else (short, middle)
        return long


def _factors(change: float, moved: float) -> tuple[float, float, float]:
    """Factors of tau^3, tau^4, tau^5; see `profiles`."""
    return (
        10.0 * change - 6.0 * moved,
        -15.0 * change + 8.0 * moved,
        6.0 * change - 3.0 * moved,
    )


def _roots(a: float, b: float, c: float) -> list[float]:
    """Where a x^2 + b x + c is zero between 0 and 1."""
    if a == 0.0:
        found = [-c / b] if b else []
    else:
        inside = b * b - 4.0 * a * c
        root = math.sqrt(inside) if inside >= 0.0 else math.nan
        found = [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)]
    return [x for x in found if 0.0 < x < 1.0]


def change_profile(
    start: float,
    end: float,
    rate: float,
    course: tuple[DynamicProfile, float | None, float | None],
    limits: tuple[float, float],
) -> Profile:
    """Closed form of a change of a position (m) or of another quantity with an initial rate.

    `constant` has its rate instantly; the others continue the present rate and end at rest.

    Args:
        start: Its start.
        end: Its end.
        rate: The rate at the start.
        course: Profile, peak of the rate, duration (s).
        limits: Largest rate for `constant`, largest derivative of the rate for the others.
    """
    profile, peak, duration = course
    change = abs(end - start)
    if profile == "constant":
        usual = change / (peak or limits[0]) if change else 0.0
        return Linear(start, end, usual if duration is None else duration)
    if change == 0.0 and rate == 0.0:
        return Linear(start, end, 0.0)
    peaks = Peaks(end - start, rate)
    share = 1.0 if profile == "asap" else COMFORT
    fastest = peaks.time_for(share * limits[1], peaks.curve)
    if rate * (end - start) > 0.0:
        fastest = min(fastest, _ONE_WAY * change / abs(rate))
    if profile == "asap" or (duration is None and peak is None):
        slowed = 0.0 if peak is None or peak <= abs(rate) else peaks.time_for(peak, peaks.rate)
        return Quintic(start, end, max(fastest, slowed), rate)
    if duration is None and peak is not None:
        duration = peaks.time_for(peak, peaks.rate)
    return Quintic(start, end, duration or 0.0, rate)


def turns_back(course: Profile) -> float | None:
    """Time (s) at which a profile reverses; None if it never does."""
    last = course.duration
    if math.isinf(last) or last == 0.0:
        return None
    values = [course.value(last * i / _SAMPLES) for i in range(_SAMPLES + 1)]
    way = math.copysign(1.0, values[-1] - values[0])
    for i in range(_SAMPLES):
        if (values[i + 1] - values[i]) * way < -1e-9:
            return last * i / _SAMPLES
    return None

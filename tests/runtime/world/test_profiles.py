"""Closed forms: end values, durations, peaks of the rate and of its derivative."""

from __future__ import annotations

import itertools
import math

import pytest

from osc2tx_runtime.world.actor_dimensions import Limits
from osc2tx_runtime.world.commands import SpeedChange
from osc2tx_runtime.world.geometry.profiles import (
    Cosine,
    Linear,
    Profile,
    Quintic,
    SCurve,
    cosine_duration,
    fastest_cosine,
)
from osc2tx_runtime.world.longitudinal.execution import excessive_rate, speed_profile

CAR = Limits(4.0, 8.0)


def samples(profile: Profile, count: int = 4000) -> list[float]:
    return [profile.duration * i / count for i in range(count + 1)]


def peaks(profile: Profile) -> tuple[float, float]:
    """Largest rate, and largest slope of the rate."""
    times = samples(profile)
    rates = [profile.rate(t) for t in times]
    step = times[1]
    slopes = [(b - a) / step for a, b in itertools.pairwise(rates)]
    return max(map(abs, rates)), max(map(abs, slopes))


@pytest.mark.parametrize(
    "profile",
    [
        Linear(3.0, 11.0, 2.5),
        Cosine(3.0, 11.0, 2.5),
        Quintic(3.0, 11.0, 2.5),
        SCurve(3.0, 11.0, 4.0, 10.0),
        SCurve(3.0, 11.0, 4.0, 10.0, 2.0),
        SCurve(3.0, 11.0, 4.0, 10.0, -3.0),
        SCurve(3.0, 11.0, 4.0, 10.0, 6.0),
    ],
    ids=lambda p: f"{type(p).__name__}-{getattr(p, 'start_rate', 0.0):g}",
)
def test_value_runs_from_start_to_end_and_is_the_integral_of_the_rate(profile: Profile) -> None:
    assert profile.value(0.0) == pytest.approx(3.0, abs=1e-12)
    assert profile.value(profile.duration) == 11.0
    assert profile.value(profile.duration + 5.0) == 11.0
    times = samples(profile)
    area = sum(
        0.5 * (profile.rate(a) + profile.rate(min(b, profile.duration - 1e-9))) * (b - a)
        for a, b in itertools.pairwise(times)
    )
    assert area == pytest.approx(8.0, abs=1e-3)


def test_cosine_has_the_peaks_of_the_table() -> None:
    rate, slope = peaks(Cosine(0.0, 8.0, 4.0))
    assert rate == pytest.approx(math.pi / 2 * 8.0 / 4.0, rel=1e-5)
    assert slope == pytest.approx(4.935 * 8.0 / 16.0, rel=1e-3)
    assert cosine_duration(8.0, 2.0) == pytest.approx(2.0 * math.pi)
    assert peaks(Cosine(0.0, 8.0, fastest_cosine(8.0, 2.0)))[1] == pytest.approx(2.0, rel=1e-3)


def test_quintic_has_the_peaks_of_the_table() -> None:
    rate, slope = peaks(Quintic(0.0, 3.5, 3.0))
    assert rate == pytest.approx(1.875 * 3.5 / 3.0, rel=1e-5)
    assert slope == pytest.approx(5.774 * 3.5 / 9.0, rel=1e-3)


def test_quintic_takes_over_a_rate() -> None:
    profile = Quintic(1.0, 0.0, 2.0, 0.8)
    assert profile.rate(0.0) == pytest.approx(0.8)
    assert profile.value(1e-6) == pytest.approx(1.0 + 0.8e-6, abs=1e-9)
    assert profile.rate(1.999999) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(("change", "peak"), [(8.0, 4.0), (1.0, 10.0**0.5)])
def test_s_curve_keeps_both_limits(change: float, peak: float) -> None:
    profile = SCurve(0.0, change, 4.0, 10.0)
    rate, slope = peaks(profile)
    assert rate == pytest.approx(peak, rel=1e-3)
    assert slope == pytest.approx(10.0, rel=1e-3)
    expected = change / 4.0 + 0.4 if change >= 1.6 else 2.0 * (change / 10.0) ** 0.5
    assert profile.duration == pytest.approx(expected)


@pytest.mark.parametrize(
    ("end", "start_rate", "peak", "duration"),
    [
        # 10 m/s, limits 4 m/s^2 and 10 m/s^3: v = 10 + the integral of these trapezoids
        (20.0, 2.0, 4.0, 0.2 + (10.0 - 0.6 - 0.8) / 4.0 + 0.4),
        (20.0, -2.0, 4.0, 0.6 + (10.0 - 0.6 - 0.8) / 4.0 + 0.4),
        (20.0, 6.0, 6.0, 0.2 + (10.0 - 1.0 - 0.8) / 4.0 + 0.4),
        (10.2, 2.0, 2.0, 0.2),  # what it takes to bring the acceleration to zero
        (10.0, 2.0, 2.0, 0.2 + 0.2 * 2.0**0.5),  # and back again what it gains meanwhile
    ],
)
def test_s_curve_takes_over_a_rate(
    end: float, start_rate: float, peak: float, duration: float
) -> None:
    profile = SCurve(10.0, end, 4.0, 10.0, start_rate)
    _, slope = peaks(profile)
    assert profile.rate(0.0) == start_rate
    assert profile.rate(profile.duration - 1e-9) == pytest.approx(0.0, abs=1e-6)
    assert slope == pytest.approx(10.0, rel=1e-3)
    assert max(abs(profile.rate(t)) for t in samples(profile)) == pytest.approx(
        max(peak, abs(start_rate)), rel=1e-3
    )
    assert profile.duration == pytest.approx(duration)


@pytest.mark.parametrize(
    ("command", "start", "duration"),
    [
        (SpeedChange(20.0, "constant", 2.0), 10.0, 5.0),
        (SpeedChange(20.0, "constant", None, 4.0), 10.0, 4.0),
        (SpeedChange(20.0, "constant"), 10.0, 5.0),  # comfortable: half of 4 m/s^2
        (SpeedChange(20.0, "smooth", 3.0), 10.0, math.pi / 2 * 10 / 3),
        (SpeedChange(20.0, "smooth", None, 8.0), 10.0, 8.0),
        (SpeedChange(20.0, "asap"), 10.0, 2.9),
        (SpeedChange(0.0, "asap"), 10.0, 2.05),
        (SpeedChange(20.0, "none"), 10.0, 5.2),
        (SpeedChange(20.0, "none", None, 3.0), 10.0, 3.0),
        (SpeedChange(10.0, "smooth"), 10.0, 0.0),
    ],
)
def test_duration_of_a_speed_change(command: SpeedChange, start: float, duration: float) -> None:
    assert speed_profile(command, start, CAR).duration == pytest.approx(duration)


def test_rates_beyond_friction_are_refused() -> None:
    too_much = excessive_rate(SpeedChange(20.0, "constant", 15.0), 10.0)
    too_short = excessive_rate(SpeedChange(20.0, "smooth", None, 0.5), 10.0)
    assert too_much == "rate_peak 15 m/s^2 is not between 0 and 12 m/s^2"
    assert too_short == "a change from 10.0 to 20.0 m/s in 0.5 s requires more than 12 m/s^2"
    assert excessive_rate(SpeedChange(20.0, "constant", 6.0), 10.0) is None

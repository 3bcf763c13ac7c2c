"""When a time has come, and what rounding does to it."""

from __future__ import annotations

import math
from fractions import Fraction
from operator import eq, ge, gt, le, lt, ne

import pytest
from hypothesis import given
from hypothesis import strategies as st

from osc2tx_runtime.clock import whole_steps
from osc2tx_runtime.world.measuring.measured import Measured

DTS = ("0.01", "0.02", "0.025", "0.05", "0.1", "0.03", "0.0625")


@given(st.decimals(0, 10_000, places=3), st.sampled_from(DTS))
def test_a_time_has_come_at_the_first_step_at_or_after_it(seconds: object, dt: str) -> None:
    """By exact fractions of what is written, whatever binary numbers make of it."""
    expected = math.ceil(Fraction(str(seconds)) / Fraction(dt))
    assert whole_steps(float(str(seconds)), float(dt)) == expected


@given(st.integers(0, 200_000), st.sampled_from(DTS))
def test_times_of_steps_are_those_steps(step: int, dt: str) -> None:
    assert whole_steps(step * float(dt), float(dt)) == step


SUMMED = sum([0.1] * 200)  # 20.000000000000018


@pytest.mark.parametrize("value", [SUMMED, 40 - SUMMED, 20.0])
def test_rounding_decides_no_comparison(value: float) -> None:
    measured = Measured(value)
    for left, right in ((measured, 20.0), (20.0, measured), (measured, 20), (20, measured)):
        assert ge(left, right) and le(left, right) and eq(left, right)
        assert not gt(left, right) and not lt(left, right) and not ne(left, right)


@pytest.mark.parametrize("value", [20.0 + 1e-6, 1e9])
def test_what_differs_differs(value: float) -> None:
    assert Measured(value) > 20.0 and Measured(value) != 20.0 and not Measured(value) <= 20.0
    assert Measured(-value) < -20.0 and not Measured(-value) >= -20.0


def test_infinite_and_unknown_values_compare_as_numbers_do() -> None:
    assert Measured(math.inf) > 5.0 and Measured(math.inf) == math.inf
    assert not Measured(math.inf) <= 5.0 and Measured(-math.inf) < 5.0
    nan = Measured(math.nan)
    assert not nan >= 0.0 and not nan <= 0.0 and nan != nan
    assert Measured(1.0) != "1.0"


def test_what_is_calculated_from_measures_is_one() -> None:
    here, there = Measured(SUMMED), Measured(10.0)
    for value in (
        here - there,
        30 - here,
        abs(there - here),
        -(there - here),
        here / 2,
        here * 0.5,
    ):
        assert value == 10.0 and value >= 10.0 and not value > 10.0
    assert 2 * here + 1 == 41.0 and (here + 0.5) % 20 == 0.5
    assert float.__repr__(here) == repr(here)

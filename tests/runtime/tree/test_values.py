"""Values of scenarios: domains, constraints between values, slices of coverage items."""

import math
import random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from osc2tx_runtime import (
    Behaviour,
    RunSettings,
    Scenario,
    ScenarioError,
    Wait,
    any_of,
    at_least,
    at_most,
    within,
)
from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.language.tree.coverage import CoverageItem
from osc2tx_runtime.language.values.written_units import Unit


class Relations(Scenario):
    """Two drawn values, one of them the smaller."""

    name = "relations"
    source = "relations.osc"

    def declare(self) -> None:
        self.low = self.parameter("low", within(0.0, 10.0))
        self.high = self.parameter("high", within(0.0, 10.0))
        self.keep(self.low < self.high)

    def behavior(self) -> Behaviour:
        return Wait(lambda: True)


class Open(Scenario):
    """Values that have to be given."""

    name = "open"
    source = "open.osc"

    def declare(self) -> None:
        self.gap = self.required("gap", float, at_least(3.0))
        self.lanes = self.required("lanes", int, at_most(4))
        self.color = self.parameter("color", "red", any_of("red", "blue"))

    def behavior(self) -> Behaviour:
        return Wait(lambda: True)


@given(st.integers(0, 500))
def test_constraints_hold_for_every_seed(seed: int) -> None:
    scenario = Relations(RunSettings(seed=seed))
    assert 0.0 <= scenario.low < scenario.high <= 10.0
    again = Relations(RunSettings(seed=seed))
    assert (scenario.low, scenario.high) == (again.low, again.high)


def test_a_setting_stays_while_the_rest_is_drawn_again() -> None:
    for seed in range(20):
        scenario = Relations(RunSettings(seed=seed, set={"low": 9.0}))
        assert scenario.low == 9.0 < scenario.high


def test_what_no_draw_fits_is_an_error() -> None:
    with pytest.raises(ScenarioError, match=r"does not hold in 1000 draws"):
        Relations(RunSettings(set={"low": 10.0}))
    with pytest.raises(ScenarioError, match=r"does not hold \(low=5, high=4\)"):
        Relations(RunSettings(set={"low": 5.0, "high": 4.0}))


@pytest.mark.parametrize(
    ("chosen", "message"),
    [
        ({}, "leaves gap open; the scenario allows at least 3"),
        ({"gap": 2.0}, "--set gap=2: the scenario allows at least 3"),
        ({"gap": "wide"}, "--set gap=wide: write a number"),
        ({"gap": 3.0}, "leaves lanes open; the scenario allows at most 4"),
        ({"gap": 3.0, "lanes": 2.5}, "--set lanes=2.5: write a whole number"),
        ({"gap": 3.0, "lanes": 2.0, "color": "green"}, "--set color=green: .* {red, blue}"),
    ],
)
def test_settings_are_checked(chosen: dict[str, Any], message: str) -> None:
    with pytest.raises(SettingsError, match=message):
        Open(RunSettings(set=chosen))


def test_given_values_count_as_settings_do() -> None:
    scenario = Open(gap=4.0, lanes=3)
    assert (scenario.gap, scenario.lanes, scenario.color) == (4.0, 3, "red")
    with pytest.raises(ScenarioError, match="gap=1: the scenario allows at least 3"):
        Open(gap=1.0, lanes=3)


def test_given_ranges_are_cut_to_what_is_allowed() -> None:
    values = [Open(RunSettings(seed=s), gap=within(1.0, 5.0), lanes=3).gap for s in range(20)]
    assert all(3.0 <= value <= 5.0 for value in values)
    with pytest.raises(ScenarioError, match=r"gap: 1 to 2 .* is requested"):
        Open(gap=within(1.0, 2.0), lanes=3)
    with pytest.raises(ScenarioError, match=r"gap: at least 4 .* not a finite range"):
        Open(gap=at_least(4.0), lanes=3)


def test_ranges_hold_values_and_ranges() -> None:
    assert 2.0 in within(3.0, 1.0)
    assert within(1.5, 2.0) in within(1.0, 3.0)
    assert within(1.5, 4.0) not in within(1.0, 3.0)
    assert within(1, 3).draw(random.Random(1)) in (1, 2, 3)


@given(st.floats(0.0, 100.0), st.floats(0.1, 30.0))
def test_slices_of_a_range_hold_their_values(value: float, every: float) -> None:
    item = CoverageItem(name="x", kind="cover", within=(0.0, 100.0), every=every)
    found = item.bucket_of(value)
    assert found is not None
    low, high = found
    assert low - 1e-6 <= value <= high + 1e-6
    assert 0.0 <= low < high <= 100.0
    assert high - low <= every * (1 + 1e-9)


@pytest.mark.parametrize(
    ("value", "expected"),
    [(-1.0, None), (0.0, (0, 10)), (10.0, (10, 30)), (30.0, (10, 30)), (31.0, None)],
)
def test_buckets_are_half_open_but_the_last(
    value: float, expected: tuple[float, float] | None
) -> None:
    item = CoverageItem(name="x", kind="cover", buckets=(0, 10, 30))
    assert item.bucket_of(value) == expected


def test_slices_without_a_range_begin_at_zero() -> None:
    item = CoverageItem(name="x", kind="cover", every=5.0)
    assert item.bucket_of(-0.5) == (-5.0, 0.0)
    assert item.bucket_of(12.0) == (10.0, 15.0)
    assert math.isinf(at_least(1.0).high)


def test_units_with_an_offset() -> None:
    assert Unit("celsius", 1.0, 273.15).of(293.15) == pytest.approx(20.0)

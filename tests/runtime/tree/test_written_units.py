"""Values with units: against the text of the library, in messages, in the header of a trace."""

from __future__ import annotations

import json
from typing import Any

import pytest

from osc2tx.stdlib import TYPES, library_file
from osc2tx.syntax import ast
from osc2tx_runtime import Behaviour, RunSettings, Scenario, Unit, Wait, run_scenario, within
from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.language.values.written_units import (
    UNITS_OF,
    read_value,
    shown_value,
    unit_named,
)
from osc2tx_runtime.units import kph, m

DECLARED = [
    each for each in library_file(TYPES, "2.2").statements if isinstance(each, ast.UnitDeclaration)
]
KPH = unit_named("kph")


class Speeds(Scenario):
    """Parameters with units of the library, one of its own, and one without."""

    name = "speeds"
    source = "speeds.osc"

    def declare(self) -> None:
        self.v = self.parameter("v", 30 * kph, unit="kph")
        self.slow = self.parameter("slow", within(10 * kph, 20 * kph), unit="kph")
        self.gap = self.parameter("gap", 3 * m, unit=Unit("cubit", 0.5))
        self.count = self.parameter("count", 2)
        self.keep(self.gap < 100 * m)

    def behavior(self) -> Behaviour:
        return Wait(lambda: True)


def test_the_table_is_the_library() -> None:
    declared: dict[str, set[str]] = {}
    for each in DECLARED:
        declared.setdefault(str(each.physical_type), set()).add(str(each.name))
    assert {type_: set(names.split()) for type_, names in UNITS_OF.items()} == declared


@pytest.mark.parametrize("each", DECLARED, ids=lambda each: str(each.name))
def test_values_are_what_the_library_says(each: ast.UnitDeclaration) -> None:
    """One of each unit is factor + offset of its declaration."""
    text = each.span.source.text[each.span.start : each.span.end]
    words = {
        k.strip(): v for k, _, v in (p.partition(":") for p in text[:-1].split("(")[1].split(","))
    }
    one = float(words.get("factor", 1.0)) + float(words.get("offset", 0.0))
    unit = unit_named(str(each.name))
    assert read_value("x", f"1{each.name}", unit) == pytest.approx(one, rel=1e-12)
    assert shown_value(one, unit) == f"1 {each.name}"


@pytest.mark.parametrize(
    ("text", "si"),
    [("60kph", 60 / 3.6), ("60 kph", 60 / 3.6), ("1e1mps", 10.0), ("-.5mph", -0.22352), ("2", 2.0)],
)
def test_speeds_are_set_in_any_unit_of_speed(text: str, si: float) -> None:
    value: Any = float(text) if text == "2" else text
    assert Speeds(RunSettings(set={"v": value})).v == pytest.approx(si, rel=1e-12)


def test_decimals_of_a_bound_are_the_bound() -> None:
    for written, bound in ((5.5555555556, 20 * kph), (2.7777777777, 10 * kph)):
        assert Speeds(RunSettings(set={"slow": written})).slow == bound != written


def test_a_unit_of_the_scenario() -> None:
    assert Speeds(RunSettings(set={"gap": "4cubit"})).gap == 2.0


@pytest.mark.parametrize(
    ("chosen", "message"),
    [
        ({"v": "60m"}, "--set v=60m: m is a unit of length; write a number with its unit"),
        ({"v": "60kmh"}, "--set v=60kmh: there is no unit kmh; did you mean kmph"),
        ({"v": "fast"}, "--set v=fast: write a number with its unit, as in 1kph"),
        ({"v": "1e999kph"}, "larger than any number"),
        ({"slow": "30kph"}, "--set slow=30 kph: the scenario allows 10 kph to 20 kph"),
        ({"slow": 10.0}, "--set slow=36 kph: the scenario allows 10 kph to 20 kph"),
        ({"gap": "4kph"}, "kph is a unit of speed; .* as in 1cubit"),
        ({"gap": "200cubit"}, r"does not hold in 1000 draws \(the last values: gap=200 cubit\)"),
        ({"count": "3m"}, "--set count=3m: m is a unit of length; write a number without unit"),
    ],
)
def test_wrong_values_say_what_to_write(chosen: dict[str, Any], message: str) -> None:
    with pytest.raises(Exception, match=message) as caught:
        Speeds(RunSettings(set=chosen))
    assert isinstance(caught.value, SettingsError) or "hold" in message


def test_an_unknown_unit_of_a_module_is_an_error_of_it() -> None:
    with pytest.raises(ValueError, match="no unit furlong"):
        unit_named("furlong")


def test_the_trace_knows_the_units() -> None:
    header = json.loads(run_scenario(Speeds, RunSettings()).trace_lines[0])
    assert header["parameters"]["v"] == pytest.approx(30 / 3.6)
    assert header["units"]["v"]["name"] == "kph"
    assert header["units"]["gap"] == {"name": "cubit", "factor": 0.5, "offset": 0.0}
    assert "count" not in header["units"]

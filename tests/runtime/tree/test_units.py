"""Every unit of the standard library is there, with its factor."""

from __future__ import annotations

import math
from types import ModuleType

import pytest

from osc2tx.backends.py_trees.runtime_api import PHYSICAL_TYPES
from osc2tx_runtime import units

# Type by type, with the factors as the standard prints them (about nine digits).
PRINTED = """
nanometer nm 0.000000001; micrometer 0.000001; millimeter mm 0.001; centimeter cm 0.01
meter m 1; kilometer km 1000; inch 0.0254; feet 0.3048; mile mi 1609.344
millisecond ms 0.001; second sec s 1; minute min 60; hour h 3600
meter_per_second mps 1; kilometer_per_hour kmph kph 0.277777778
mile_per_hour mph miph 0.447038889; mmph millimeter_per_hour 0.000000278
meter_per_sec_sqr mpsps mpss 1; kilometer_per_hour_per_sec kmphps 0.277777778
mile_per_hour_per_sec miphps 0.447038889; meter_per_sec_cubed mpspsps 1
mile_per_sec_cubed mipspsps 1609.344; degree deg 0.01745329252; radian rad 1
degree_per_sec degps 0.01745329252; radian_per_sec radps 1
degree_per_sec_sqr degpsps 0.01745329252; radian_per_sec_sqr radpsps 1
gram 0.001; kilogram kg 1; ton 1000; pound lb 0.45359237; K kelvin 1
newton_per_meter_sqr Pa pascal 1; hPa 100; atm 101325; cd candela 1; lm lumen 1; lx lux 1
ampere A 1; mole mol 1
"""
ENTRIES = [entry.split() for line in PRINTED.strip().splitlines() for entry in line.split(";")]


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda entry: entry[0])
def test_factor(entry: list[str]) -> None:
    *names, printed = entry
    for name in names:
        # The standard rounds; its `mph` uses 1609.34 and `mmph` three digits.
        assert getattr(units, name) == pytest.approx(
            float(printed), rel=2e-3 if "mmph" in names else 3e-6
        )


def test_all_units_are_there() -> None:
    names = {name for *names, _ in ENTRIES for name in names} | {"celsius", "C", "fahrenheit", "F"}
    public = {n for n, v in vars(units).items() if not n.startswith("_")} - {"annotations", "math"}
    types = {name for name in public if getattr(units, name) is float}
    assert types == {*PHYSICAL_TYPES.values()}
    assert public - types - {"TypeAlias"} == names
    assert not any(isinstance(getattr(units, name), ModuleType) for name in names)


def test_offsets() -> None:
    assert units.celsius(20) == 293.15
    assert units.fahrenheit(32) == pytest.approx(273.15)
    assert units.deg == math.pi / 180

"""Values with units, as written in settings and messages: `60kph`, `60 kph`."""

from __future__ import annotations

import math
import re
from functools import cache
from typing import Any, TypeAlias

from osc2tx_runtime import units
from osc2tx_runtime.errors import SettingsError
from osc2tx_shared.classes import dataclass

UNITS_OF: dict[str, str] = {
    "length": "m km mi mm cm nm feet inch mile meter kilometer millimeter centimeter"
    " micrometer nanometer",
    "time": "s ms min h sec second millisecond minute hour",
    "speed": "kph mps mph kmph miph mmph kilometer_per_hour meter_per_second mile_per_hour"
    " millimeter_per_hour",
    "acceleration": "mpss mpsps kmphps miphps meter_per_sec_sqr kilometer_per_hour_per_sec"
    " mile_per_hour_per_sec",
    "jerk": "mpspsps mipspsps meter_per_sec_cubed mile_per_sec_cubed",
    "angle": "deg rad degree radian",
    "angular_rate": "degps radps degree_per_sec radian_per_sec",
    "angular_acceleration": "degpsps radpsps degree_per_sec_sqr radian_per_sec_sqr",
    "mass": "kg lb ton kilogram gram pound",
    "temperature": "C K F celsius kelvin fahrenheit",
    "pressure": "Pa hPa atm pascal newton_per_meter_sqr",
    "luminous_intensity": "cd candela",
    "luminous_flux": "lm lumen",
    "illuminance": "lx lux",
    "electrical_current": "A ampere",
    "amount_of_substance": "mol mole",
}
"""Physical types of the library to their units, the usual ones first."""

_TYPES = {name: type_ for type_, names in UNITS_OF.items() for name in names.split()}
_WRITTEN = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([^\W\d]\w*)", re.ASCII)
_DIGITS = 9  # of a shown value: 16.666666666666668 m/s are 60 kph
_OFFERED = 6  # units in a message


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit: `si = value * factor + offset`."""

    name: str
    factor: float
    offset: float = 0.0

    def of(self, si: float) -> float:
        """Return a value in SI in this unit."""
        return (si - self.offset) / self.factor

    @property
    def type(self) -> str:
        """The physical type of the library; empty for a unit that a scenario declares."""
        return _TYPES.get(self.name, "")


AnyUnit: TypeAlias = Unit | str
"""A unit, or the name of a unit of the library."""


def unit_named(unit: AnyUnit) -> Unit:
    """Return a unit of the library by its name.

    Raises:
        ValueError: There is no unit of this name.
    """
    return unit if isinstance(unit, Unit) else _unit_of_library(unit)


@cache  # values are declared anew for each draw
def _unit_of_library(name: str) -> Unit:
    if name not in _TYPES:
        raise ValueError(f"the library has no unit {name}")
    meaning: Any = getattr(units, name)
    if callable(meaning):
        return Unit(name, meaning(1.0) - meaning(0.0), meaning(0.0))
    return Unit(name, meaning)


def read_value(name: str, text: str, unit: Unit | None) -> float:
    """Return the value (SI) of a text like `60kph`.

    Args:
        name: Of the parameter.
        text: The text; plain numbers are not handled here.
        unit: The unit of the parameter; None if it has none.

    Raises:
        SettingsError: It is not a number with a unit, or the unit has another dimension.
    """
    wrong = f"--set {name}={text}"
    found = _WRITTEN.fullmatch(text.strip())
    if found is None:
        raise SettingsError(f"{wrong}: {_how(unit)}")
    value, word = float(found[1]), found[2]
    if not math.isfinite(value):
        raise SettingsError(f"{wrong}: the value is larger than any number")
    if unit is not None and word == unit.name:
        return value * unit.factor + unit.offset
    if word not in _TYPES:
        from difflib import get_close_matches  # only needed where something is wrong

        near = get_close_matches(word, _TYPES if unit is None else _units_like(unit), n=2)
        hint = f"; did you mean {' or '.join(near)}?" if near else f"; {_how(unit)}"
        raise SettingsError(f"{wrong}: there is no unit {word}{hint}")
    if unit is None or _TYPES[word] != unit.type:
        what = _TYPES[word].replace("_", " ")
        raise SettingsError(f"{wrong}: {word} is a unit of {what}; {_how(unit)}")
    meant = unit_named(word)
    return value * meant.factor + meant.offset


def shown_value(value: Any, unit: Unit | None) -> str:
    """Return a value in the notation of the scenario: `60 kph`, `true`, `red`."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return value
    if unit is None:
        return f"{value:g}"
    return f"{unit.of(value):.{_DIGITS}g} {unit.name}"


def _how(unit: Unit | None) -> str:
    if unit is None:
        return "write a number without unit"
    names = ", ".join(_units_like(unit)[:_OFFERED])
    return f"write a number with its unit, as in 1{unit.name} (units: {names}), or one in SI units"


def _units_like(unit: Unit) -> list[str]:
    return UNITS_OF.get(unit.type, unit.name).split()

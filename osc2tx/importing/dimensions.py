"""Dimensions of values, units for them, and values as texts of the language."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

from osc2tx_shared.classes import dataclass


class Dimension(NamedTuple):
    """Exponents of metre, second and radian, and of kilometres per hour that are only counted."""

    m: int
    s: int
    rad: int
    kph: int = 0

    def __mul__(self, other: Dimension) -> Dimension:  # type: ignore[override]
        return Dimension(*(a + b for a, b in zip(self, other, strict=True)))

    def __truediv__(self, other: Dimension) -> Dimension:
        return Dimension(*(a - b for a, b in zip(self, other, strict=True)))


NUMBER, LENGTH, TIME = Dimension(0, 0, 0), Dimension(1, 0, 0), Dimension(0, 1, 0)
SPEED, ACCELERATION = Dimension(1, -1, 0), Dimension(1, -2, 0)
JERK, ANGLE = Dimension(1, -3, 0), Dimension(0, 0, 1)
HOURLY = Dimension(0, 0, 0, 1)
"""Of a number in kilometres per hour; divided by 3.6 it is a speed."""

UNITS: Mapping[Dimension, tuple[tuple[str, float], ...]] = {
    LENGTH: (("m", 1.0),),
    TIME: (("s", 1.0),),
    SPEED: (("mps", 1.0), ("kph", 1.0 / 3.6)),
    ACCELERATION: (("mpss", 1.0),),
    JERK: (("mpspsps", 1.0),),
    ANGLE: (("deg", 0.017453292519943295), ("rad", 1.0)),
    HOURLY: (("kph", 1.0),),
}
"""Units of the language that people write, with their values; the first is the usual one."""

TYPES = {
    LENGTH: "length",
    TIME: "time",
    SPEED: "speed",
    ACCELERATION: "acceleration",
    JERK: "jerk",
    ANGLE: "angle",
    HOURLY: "speed",
    NUMBER: "float",
}
OF_SCHEMA = {
    "m": LENGTH,
    "s": TIME,
    "m/s": SPEED,
    "m/s²": ACCELERATION,
    "m/s^2": ACCELERATION,
    "m/s³": JERK,
    "rad": ANGLE,
}
SUM, PRODUCT, ATOM = 1, 2, 3
DIGITS = 8


@dataclass(frozen=True, slots=True)
class Quantity:
    """A value of the document.

    Attributes:
        text: The expression of the language, with units.
        value: Its nominal value, in SI units.
        is_open: Whether parameters give it.
        binding: How tightly its outermost operator binds.
    """

    text: str
    value: float
    is_open: bool = False
    binding: int = ATOM

    def within(self, binding: int) -> str:
        """Return its text as an operand of an operator."""
        is_loose = self.binding < binding or (binding > SUM and self.text.startswith("-"))
        return f"({self.text})" if is_loose else self.text


@lru_cache(maxsize=4096)
def literal(value: float, dimension: Dimension) -> str:
    """Return a number with the unit in which it is shortest."""
    if abs(value) < 1e-12:
        value = 0.0
    units = UNITS.get(dimension, (("", 1.0),))
    shown = [(short(value / factor), unit) for unit, factor in units]
    fits = [
        (len(text.rstrip("0").lstrip("-")), index)
        for index, (text, unit) in enumerate(shown)
        if abs(float(text) * units[index][1] - value) <= 1e-9 * max(abs(value), 1e-3)
    ]
    index = min(fits, default=(0, 0))[1]
    text, unit = shown[index]
    return f"{text}{unit}" if unit else text if "." in text else f"{text}.0"


def total(dimension: Dimension, *parts: tuple[int, Quantity]) -> Quantity:
    """Return the sum of quantities with signs; the numbers in it are added up."""
    number = round(sum(sign * each.value for sign, each in parts if not each.is_open), 9)
    opened = [(sign, each) for sign, each in parts if each.is_open]
    value = sum(sign * each.value for sign, each in parts)
    if not opened:
        return Quantity(literal(number, dimension), value)
    known = Quantity(literal(abs(number), dimension), abs(number))
    summands = [((1 if number > 0.0 else -1), known)] if number else []
    comes_first = not parts[0][1].is_open or opened[0][0] < 0
    ordered = [*summands, *opened] if comes_first else [*opened, *summands]
    text = "".join(
        f" {'+' if sign > 0 else '-'} {each.within(SUM if sign > 0 else PRODUCT)}"
        for sign, each in ordered
    )
    text = text.removeprefix(" + ") if text.startswith(" + ") else f"-{text.removeprefix(' - ')}"
    return Quantity(text, value, True, SUM)


def short(value: float) -> str:
    """Return a number without needless digits."""
    text = f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text

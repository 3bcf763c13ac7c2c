"""Conversions of JSON values read from a trace."""

from __future__ import annotations

import math
from collections.abc import Iterable

Json = dict[str, object]
"""A JSON object."""

_LARGEST = 1e12
"""Upper limit: sums of larger numbers would leave the exact whole numbers of a browser."""

_DEEPEST = 100
"""Greatest depth of nested lists and objects; traces of osc2tx have three levels."""


def number(value: object) -> float | None:
    """The value as a float that a page can draw, None for other values."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        result = float(value)
    except OverflowError:
        return None
    return result if abs(result) <= _LARGEST else None


def is_flat(value: object) -> bool:
    """Whether the nesting of lists and objects is within the limit."""
    level = [value]
    for _ in range(_DEEPEST):
        level = [inner for each in level for inner in _within(each)]
        if not level:
            return True
    return False


def _within(value: object) -> Iterable[object]:
    if isinstance(value, dict):
        return value.values()
    return value if isinstance(value, list) else ()


def short(value: float, digits: int) -> float | int:
    """Round for the page; whole numbers become integers because they are shorter in JSON."""
    rounded = round(value, digits)
    return int(rounded) if rounded == int(rounded) else rounded


def text(value: object) -> str:
    """The value as text; None is empty."""
    return "" if value is None else str(value)


def plain(value: object) -> object:
    """A copy for strict JSON: numbers that are not finite become text."""
    if isinstance(value, dict):
        return {text(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)
    if value is None or isinstance(value, str | bool | int):
        return value
    return str(value)

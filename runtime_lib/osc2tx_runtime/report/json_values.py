"""Conversions of JSON values read from a trace."""

from __future__ import annotations

import math

__all__ = ["Json", "number", "plain", "short", "text"]

Json = dict[str, object]
"""A JSON object."""


def number(value: object) -> float | None:
    """The value as a finite float, None if it is anything else."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        result = float(value)
    except OverflowError:
        return None
    return result if math.isfinite(result) else None


def short(value: float, digits: int) -> float | int:
    """Round for the page; whole numbers become integers because they are shorter in JSON."""
    rounded = round(value, digits)
    return int(rounded) if rounded == int(rounded) else rounded


def text(value: object) -> str:
    """The value as text; None is empty."""
    return "" if value is None else str(value)


def plain(value: object) -> object:
    """A copy that strict JSON can hold: numbers that are not finite become text."""
    if isinstance(value, dict):
        return {text(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)
    if value is None or isinstance(value, str | bool | int):
        return value
    return str(value)

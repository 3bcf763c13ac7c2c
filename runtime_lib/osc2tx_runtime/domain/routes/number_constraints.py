"""Constraints of a number on the map: a value, or a range."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from osc2tx_runtime.language.tree.parameters import Range

__all__ = ["Wish", "fulfils", "said"]

Wish: TypeAlias = "float | Range[Any]"


def fulfils(
    wish: Wish | None,
    value: float,
    tolerance: float = 0.0,
    *,
    at_least: bool = False,
    at_most: bool = False,
) -> bool:
    """Whether a number of the map is as asked for.

    Args:
        wish: What is asked for; None: nothing.
        value: The number.
        tolerance: How far beside a plain number it may be.
        at_least: A plain number is a lower bound,
        at_most: or an upper one.
    """
    if wish is None:
        return True
    low, high = _bounds(wish, at_least=at_least, at_most=at_most)
    return low - tolerance <= value <= high + tolerance


def said(text: str, wish: Wish | None, *, at_least: bool = False, at_most: bool = False) -> str:
    """The wish in words, for `{}` of a text; empty without one."""
    if wish is None:
        return ""
    low, high = _bounds(wish, at_least=at_least, at_most=at_most)
    if low == high:
        return text.format(f"{low:g}")
    if high == math.inf:
        return text.format(f"at least {low:g}")
    return text.format(f"at most {high:g}" if low == -math.inf else f"{low:g} to {high:g}")


def _bounds(wish: Wish, *, at_least: bool, at_most: bool) -> tuple[float, float]:
    if isinstance(wish, int | float):
        return -math.inf if at_most else wish, math.inf if at_least else wish
    return wish.low, wish.high

"""Numbers as text, as XML Schema has them: ASCII digits, no `1_0`, no `nan`."""

from __future__ import annotations

import math

_LONGEST_INT = 18  # digits: what no id and no seed is longer than


def to_float(text: str) -> float:
    """Return a finite number.

    Raises:
        ValueError: The text is no number, or one in a form of Python alone.
    """
    value = float(_plain(text))
    if not math.isfinite(value):
        raise ValueError(f"{text} is not finite")
    return value


def to_int(text: str) -> int:
    """Return a whole number.

    Raises:
        ValueError: As of `to_float`; or it has too many digits.
    """
    if len(text) > 2 * _LONGEST_INT or len(text.strip().lstrip("+-")) > _LONGEST_INT:
        raise ValueError("too many digits")
    return int(_plain(text))


def _plain(text: str) -> str:
    if "_" in text or not text.isascii():
        raise ValueError(f"{text!r} is no number")
    return text

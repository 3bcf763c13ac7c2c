"""Numbers as text, in the forms of XML Schema: ASCII digits, no `1_0`, no `nan`."""

from __future__ import annotations

import math

_LONGEST_INT = 18  # digits: upper limit of ids and seeds


def to_float(text: str) -> float:
    """Return a finite number.

    Raises:
        ValueError: The text is not a number, or has a form that only Python accepts.
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
        raise ValueError(f"{text!r} is not a number")
    return text

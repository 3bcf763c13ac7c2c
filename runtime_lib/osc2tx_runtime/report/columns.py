"""Packs columns of numbers for the page; `core.js` unpacks them."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["pack"]

Packed = list[int | list[int] | None]


def pack(values: Sequence[float | None], digits: int) -> Packed:
    """Return a column as second differences, in units of the last digit.

    What moves steadily has differences of zero, so most of a column is runs of equal numbers. A
    run of more than two is written as `[number, count]`. Unknown values stay None.
    """
    scale = 10**digits
    packed: Packed = []
    before, slope = 0, 0
    for value in values:
        if value is None:
            packed.append(None)
            continue
        whole = round(value * scale)
        packed.append(whole - before - slope)
        before, slope = whole, whole - before
    return _shortened(packed)


def _shortened(packed: Packed) -> Packed:
    result: Packed = []
    start = 0
    for index in range(1, len(packed) + 1):
        if index < len(packed) and packed[index] == packed[start]:
            continue
        number, count = packed[start], index - start
        if isinstance(number, int) and count > 2:
            result.append([number, count])
        else:
            result += [number] * count
        start = index
    return result

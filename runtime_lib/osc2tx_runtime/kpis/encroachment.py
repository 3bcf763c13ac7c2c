"""Post-encroachment time: between who leaves a place and who comes to it next."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from .measure import Scene

__all__ = ["MinEncroachment"]

Rows = NDArray[np.float64]

_TIME, _X, _Y, _COS, _SIN, _LENGTH, _WIDTH = range(7)


class MinEncroachment:
    """Least post-encroachment time (s): between two actors at one place, one after the other.

    To a step: boxes at one step count as there until the next one. 0 if two touch; no value for a
    pair whose ways have no common place.
    """

    name = "min_pet"
    worst = "min"

    def __init__(self) -> None:
        self._ways: dict[str, list[tuple[float, ...]]] = {}

    def observe(self, scene: Scene) -> None:
        """Note where everybody is; who stands still is there once, for as long."""
        for actor in scene.actors:
            box = actor.box
            half = box.half_length, box.half_width
            place = (scene.time, box.x, box.y, box.cos, box.sin, *half)
            self._ways.setdefault(actor.id, []).append(place)

    def results(self) -> Mapping[str, float | None]:
        """Return the least of all, then that of each pair."""
        ways = {name: np.array(way) for name, way in self._ways.items()}
        least = {
            f"{self.name}({one},{other})": _least(ways[one], ways[other])
            for one, other in combinations(ways, 2)
        }
        known = [value for value in least.values() if value is not None]
        pairs = {name: value for name, value in sorted(least.items()) if value is not None}
        return {self.name: min(known, default=None), **pairs}


def _least(one: Rows, other: Rows) -> float | None:
    """Return the least time between two boxes at one place."""
    reach = np.hypot(one[0, _LENGTH], one[0, _WIDTH]) + np.hypot(
        other[0, _LENGTH], other[0, _WIDTH]
    )
    if not _near(one, other, reach):
        return None
    apart = (one[:, None, _X] - other[None, :, _X]) ** 2
    apart += (one[:, None, _Y] - other[None, :, _Y]) ** 2
    first, second = np.nonzero(apart <= reach * reach)
    if not len(first):
        return None
    times = np.abs(one[first, _TIME] - other[second, _TIME])
    overlap = _overlap(one[first], other[second])
    return float(times[overlap].min()) if overlap.any() else None


def _near(one: Rows, other: Rows, reach: float) -> bool:
    """Whether the rectangles around two ways come as near as that."""
    places = [_X, _Y]
    low, high = one[:, places].min(axis=0), one[:, places].max(axis=0)
    return bool(
        np.all(other[:, places].min(axis=0) <= high + reach)
        and np.all(other[:, places].max(axis=0) >= low - reach)
    )


def _overlap(one: Rows, other: Rows) -> NDArray[np.bool_]:
    """Whether boxes of two lists have a common point, by the four separating axes."""
    x, y = other[:, _X] - one[:, _X], other[:, _Y] - one[:, _Y]
    along = np.abs(one[:, _COS] * other[:, _COS] + one[:, _SIN] * other[:, _SIN])
    cross = np.abs(one[:, _COS] * other[:, _SIN] - one[:, _SIN] * other[:, _COS])
    found: NDArray[np.bool_] = np.ones(len(x), dtype=np.bool_)
    for me, you in ((one, other), (other, one)):
        forward = np.abs(x * me[:, _COS] + y * me[:, _SIN])
        sideways = np.abs(y * me[:, _COS] - x * me[:, _SIN])
        found &= forward <= me[:, _LENGTH] + you[:, _LENGTH] * along + you[:, _WIDTH] * cross
        found &= sideways <= me[:, _WIDTH] + you[:, _LENGTH] * cross + you[:, _WIDTH] * along
    return found

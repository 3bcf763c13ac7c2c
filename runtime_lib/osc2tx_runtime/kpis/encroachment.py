"""The post-encroachment time: actors at the same position, one after the other."""

from __future__ import annotations

from array import array
from collections.abc import Iterator, Mapping
from itertools import combinations, product

import numpy as np
from numpy.typing import NDArray

from .measure import Scene

Rows = NDArray[np.float64]
_Indexes = NDArray[np.int64]

_FIRST, _LAST, _X, _Y, _COS, _SIN, _LENGTH, _WIDTH = range(8)
_MOST = 1_000_000  # pairs of positions that are compared at once


class MinEncroachment:
    """Least post-encroachment time (s) between two actors at the same position.

    Its resolution is a step: a box remains at its position until the next step. 0 if two touch; no
    value for a pair whose paths do not cross.
    """

    name = "min_pet"
    worst = "min"

    def __init__(self) -> None:
        self._ways: dict[str, array[float]] = {}

    def observe(self, scene: Scene) -> None:
        """Note the positions of all actors.

        An actor at standstill is noted once, with its duration.
        """
        for actor in scene.actors:
            box = actor.box
            way = self._ways.setdefault(actor.id, array("d"))
            place = array("d", (box.x, box.y, box.cos, box.sin, box.half_length, box.half_width))
            if way[-len(place) :] == place:
                way[_LAST - _WIDTH - 1] = scene.time
            else:
                way.extend((scene.time, scene.time, *place))

    def results(self) -> Mapping[str, float | None]:
        """Return the least value of all, then that of each pair."""
        ways = {name: np.array(way).reshape(-1, _WIDTH + 1) for name, way in self._ways.items()}
        least = {
            f"{self.name}({one},{other})": _least(ways[one], ways[other])
            for one, other in combinations(ways, 2)
        }
        known = [value for value in least.values() if value is not None]
        pairs = {name: value for name, value in sorted(least.items()) if value is not None}
        return {self.name: min(known, default=None), **pairs}


def _least(one: Rows, other: Rows) -> float | None:
    """Return the least time between two boxes at the same position."""
    reach = np.hypot(one[0, _LENGTH], one[0, _WIDTH]) + np.hypot(
        other[0, _LENGTH], other[0, _WIDTH]
    )
    least: float | None = None
    for first, second in _neighbours(one[:, [_X, _Y]], other[:, [_X, _Y]], reach):
        here, there = one[first], other[second]
        gaps = np.maximum(here[:, _FIRST] - there[:, _LAST], there[:, _FIRST] - here[:, _LAST])
        is_near = np.hypot(here[:, _X] - there[:, _X], here[:, _Y] - there[:, _Y]) <= reach
        nearer = is_near if least is None else is_near & (gaps < least)
        here, there, gaps = here[nearer], there[nearer], gaps[nearer]
        overlap = _overlap(here, there)
        if overlap.any():
            least = max(float(gaps[overlap].min()), 0.0)
    return least


def _neighbours(one: Rows, other: Rows, reach: float) -> Iterator[tuple[_Indexes, _Indexes]]:
    """Yield pairs of positions of two paths, including all pairs within `reach` (m).

    The positions of one path are looked up in a grid of those of the other.
    """
    cells = _cells(other, reach, (0, 0))
    order = np.argsort(cells, kind="stable")
    cells = cells[order]
    for shift in product((-1, 0, 1), (-1, 0, 1)):
        wanted = _cells(one, reach, shift)
        begins = np.searchsorted(cells, wanted, side="left")
        counts = np.searchsorted(cells, wanted, side="right") - begins
        sums = np.cumsum(counts)
        at = 0
        while at < len(one):
            done = sums[at - 1] if at else 0
            end = max(int(np.searchsorted(sums, done + _MOST, side="right")), at + 1)
            number = counts[at:end]
            first = np.repeat(np.arange(at, end), number)
            within = np.arange(len(first)) - np.repeat(sums[at:end] - number - done, number)
            if len(first):
                yield first, order[np.repeat(begins[at:end], number) + within]
            at = end


def _cells(places: Rows, edge: float, shift: tuple[int, int]) -> _Indexes:
    """Return a number for the grid cell of each position; distant cells may share one."""
    column, row = (np.floor(places / edge).astype(np.int64) + shift).T
    cells: _Indexes = (column << 32) ^ (row & 0xFFFFFFFF)
    return cells


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

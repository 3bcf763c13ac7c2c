"""Draws from small sets of values, which independent draws hardly ever hit.

The values are shares of their ranges, and the set is restricted by demands. A walk first climbs,
one demand after the other, to a point of the set: by exchanges of shares, then by moving them. Then
it moves in the set, along one share or one straight line at a time, until the result is independent
of the start (slice sampling with shrinking intervals, whose steps preserve the uniform distribution
over the set).
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from typing import Protocol, TypeVar

EXCHANGES = 5_000  # tried pairs
CLIMB = 10_000  # tries after which demands count as contradictory
SHORT_CLIMB = 1_000  # tries of a climb that finds contradictory demands
SWEEPS = 30  # moves of each share in the set
NARROW = 1e-12  # an interval without other points

AnyT = TypeVar("AnyT")


class Draws(Protocol):
    """The interface of draws: `random.Random`, or a fixed share."""

    def uniform(self, a: float, b: float, /) -> float:
        """Return a number between two others."""

    def randint(self, a: int, b: int, /) -> int:
        """Return a whole number from one to another, both included."""

    def choice(self, seq: Sequence[AnyT], /) -> AnyT:
        """Return an element."""


class _Share:
    """Draws at a fixed fraction of each range."""

    __slots__ = ("share",)

    def __init__(self, share: float) -> None:
        self.share = share

    def uniform(self, a: float, b: float, /) -> float:
        return a + (b - a) * self.share

    def randint(self, a: int, b: int, /) -> int:
        return a + int((b - a + 1) * self.share)

    def choice(self, seq: Sequence[AnyT], /) -> AnyT:
        return seq[int(len(seq) * self.share)]


class Walk:
    """A walk over the shares of all values that are drawn.

    Args:
        generator: Generator of the walk.
        height: Draws all values and returns the number of demands that hold, in their order; None:
            all.
    """

    def __init__(self, generator: random.Random, height: Callable[[], int | None]) -> None:
        self._generator = generator
        self._height = height
        self._shares: dict[str, float] = {}
        self._tries = 0

    def draws_for(self, name: str) -> Draws:
        """Return the random number of a value."""
        if name not in self._shares:
            self._shares[name] = self._generator.random()
        return _Share(self._shares[name])

    def arrive(self) -> bool:
        """Move to a point of the set, drawn uniformly.

        Returns:
            Whether one was found; the values are those of the point.
        """
        height = self._exchange(self._height())
        while height is not None:
            height = self._climb(height)
            if height is not None and self._tries > CLIMB:
                return False
        for _ in range(SWEEPS):
            for name in list(self._shares):
                self._slide({name: 1.0}, None)
            self._slide({name: self._generator.gauss(0.0, 1.0) for name in self._shares}, None)
        return self._height() is None

    def can_rise(self, height: int) -> bool:
        """Whether a short climb from here satisfies more constraints than a given number."""
        here, self._tries = dict(self._shares), 0
        reached: int | None = height
        while reached == height and self._tries < SHORT_CLIMB:
            reached = self._climb(height)
        self._shares = here
        return reached != height

    def _exchange(self, height: int | None) -> int | None:
        """Exchange shares, never down; return the height after it.

        Ordered values (`a < b`, `b < c`, …) are one arrangement of any shares: with equal ranges,
        the result is drawn uniformly from all ordered values.
        """
        names = list(self._shares)
        for _ in range(EXCHANGES if len(names) > 1 else 0):
            if height is None:
                return None
            one, other = self._generator.sample(names, 2)
            self._exchange_two(one, other)
            after = self._height()
            if after is None or after >= height:
                height = after
            else:
                self._exchange_two(one, other)
        return height

    def _exchange_two(self, one: str, other: str) -> None:
        self._shares[one], self._shares[other] = self._shares[other], self._shares[one]

    def _climb(self, height: int) -> int | None:
        """Move each share once, never down; return the height after it."""
        reached: int | None = height
        for name in self._generator.sample(list(self._shares), len(self._shares)):
            reached = self._slide({name: 1.0}, reached)
            if reached is None:
                break
        return reached

    def _slide(self, direction: dict[str, float], least: int | None) -> int | None:
        """Move along a line to a random point that is high enough on it.

        Args:
            direction: Change of the shares.
            least: Number of demands that have to hold there; None: all.

        Returns:
            The height there.
        """
        here = {name: self._shares[name] for name in direction}
        low, high = _ends(here, direction)
        while high - low > NARROW:
            way = self._generator.uniform(low, high)
            for name, share in here.items():
                self._shares[name] = min(max(share + way * direction[name], 0.0), 1.0 - 1e-16)
            height = self._height()
            self._tries += 1
            if height is None or (least is not None and height >= least):
                return height
            low, high = (way, high) if way < 0.0 else (low, way)
        self._shares.update(here)
        return least


def _ends(here: dict[str, float], direction: dict[str, float]) -> tuple[float, float]:
    """Return the range of a line until a share is zero, or one."""
    lows, highs = [], []
    for name, share in here.items():
        rate = direction[name]
        if rate != 0.0:
            ends = sorted((-share / rate, (1.0 - share) / rate))
            lows.append(ends[0])
            highs.append(ends[1])
    return max(lows, default=0.0), min(highs, default=0.0)

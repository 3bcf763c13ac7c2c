"""Samplers with a few levels of each parameter: all combinations, or all pairs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from typing import Any

from osc2tx.campaigns.errors import CampaignError
from osc2tx.campaigns.pairs import pairwise_rows
from osc2tx.campaigns.sampling import Wanted, row_seed
from osc2tx_runtime.campaigns import Row
from osc2tx_runtime.campaigns.points import Column

__all__ = ["GridSampler", "PairwiseSampler", "levels_of"]


def levels_of(column: Column, most: int) -> list[float]:
    """Return places between the first (0) and the last value (1): ends included, at equal steps.

    Choices have all their values, whole numbers all where those are few enough.
    """
    if column.kind == "choice" or 0 < column.count <= most:
        return [(index + 0.5) / column.count for index in range(column.count)]
    return [index / (most - 1) for index in range(most)]


class _Design:
    is_checked = True

    def __init__(self, columns: Sequence[Column], wanted: Wanted) -> None:
        if wanted.levels < 2:
            raise CampaignError(f"--levels {wanted.levels}: a range has two ends, so two at least")
        self._columns, self._wanted = columns, wanted
        self._levels = [levels_of(column, wanted.levels) for column in columns]

    @property
    def identity(self) -> Mapping[str, Any]:
        """The columns and the number of levels."""
        names = [column.name for column in self._columns]
        return {"columns": names, "levels": self._wanted.levels}

    def _row(self, number: int, shares: Sequence[float]) -> Row:
        names = (column.name for column in self._columns)
        seed = row_seed(self._wanted.seed, number)
        return Row(number, seed, dict(zip(names, shares, strict=True)))


class GridSampler(_Design):
    """All combinations; the last parameter changes first."""

    def rows(self) -> Iterator[Row]:
        """Yield all rows."""
        return (self._row(number, shares) for number, shares in enumerate(product(*self._levels)))


class PairwiseSampler(_Design):
    """Few rows in which each two levels of two parameters meet, where constraints let them."""

    def __init__(
        self, columns: Sequence[Column], wanted: Wanted, is_allowed: Callable[[Row], bool]
    ) -> None:
        super().__init__(columns, wanted)
        self._is_allowed = is_allowed

    def rows(self) -> Iterator[Row]:
        """Yield all rows."""
        if len(self._levels) < 2:
            yield from (self._row(number, (each,)) for number, each in enumerate(self._levels[0]))
            return
        for number, shares in enumerate(pairwise_rows(self._levels, self._keeps)):
            yield self._row(number, shares)

    def _keeps(self, shares: Sequence[float]) -> bool:
        return self._is_allowed(self._row(0, shares))

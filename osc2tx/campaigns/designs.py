"""Samplers with a few levels of each parameter: all combinations, or all pairs."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations, islice, product
from math import prod
from typing import Any, TypeAlias

from osc2tx.campaigns.sampling import Wanted, row_seed
from osc2tx_runtime.campaigns import Row
from osc2tx_runtime.campaigns.points import Column

from .store import CampaignError

TRIES = 300

Pair: TypeAlias = tuple[tuple[int, int], tuple[int, int]]
"""Two parameters, each with the index of a level."""


def pairwise_rows(
    levels: Sequence[Sequence[float]], keeps: Callable[[Sequence[float]], bool]
) -> Iterator[list[float]]:
    """Yield rows, the same ones for the same arguments.

    Args:
        levels: Of two parameters at least.
        keeps: Whether constraints allow a row.
    """
    counts = [len(each) for each in levels]
    missing: dict[Pair, None] = {
        ((i, a), (j, b)): None
        for i, j in combinations(range(len(counts)), 2)
        for a, b in product(range(counts[i]), range(counts[j]))
    }
    while missing:
        pair = next(iter(missing))
        for row in _completions(pair, counts, missing):
            shares = [level[index] for level, index in zip(levels, row, strict=True)]
            if keeps(shares):
                for met in combinations(enumerate(row), 2):
                    missing.pop(met, None)
                yield shares
                break
        else:
            del missing[pair]  # constraints exclude the combination


def _completions(
    pair: Pair, counts: Sequence[int], missing: dict[Pair, None]
) -> Iterator[list[int]]:
    """Yield rows with a pair, the best one first."""
    fixed = dict(pair)
    yield _greedy(dict(fixed), counts, missing)
    free = [index for index in range(len(counts)) if index not in fixed]
    if prod(counts[index] for index in free) <= TRIES:
        others: Iterator[tuple[int, ...]] = product(*(range(counts[index]) for index in free))
    else:
        generator = random.Random(str(pair))
        others = islice(_drawn([counts[index] for index in free], generator), TRIES)
    for chosen in others:
        row = {**fixed, **dict(zip(free, chosen, strict=True))}
        yield [row[index] for index in range(len(counts))]


def _drawn(counts: Sequence[int], generator: random.Random) -> Iterator[tuple[int, ...]]:
    while True:
        yield tuple(generator.randrange(count) for count in counts)


def _greedy(row: dict[int, int], counts: Sequence[int], missing: dict[Pair, None]) -> list[int]:
    """Complete a row with the levels that meet most of the missing pairs, the first of equals."""
    for index, count in enumerate(counts):
        if index in row:
            continue

        def met(level: int, index: int = index) -> int:
            pairs = (sorted((item, (index, level))) for item in row.items())
            return sum((one, other) in missing for one, other in pairs)

        row[index] = max(range(count), key=met)
    return [row[index] for index in range(len(counts))]


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
            raise CampaignError(
                f"--levels {wanted.levels}: a range has two ends, so use at least two"
            )
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
    """Few rows that contain each allowed pair of levels of two parameters."""

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


KINDS = {"lhs": "LatinHypercube", "sobol": "Sobol", "halton": "Halton"}
BLOCK = 1024  # a power of two: a Sobol sequence is balanced after each block


class SequenceSampler:
    """Points of a sequence, scrambled by the seed."""

    is_checked = True

    def __init__(self, name: str, columns: Sequence[Column], wanted: Wanted) -> None:
        self._name, self._columns, self._wanted = name, columns, wanted
        self._qmc = _qmc(name)

    @property
    def identity(self) -> Mapping[str, Any]:
        """The columns, the version of scipy, and of a Latin hypercube the number of rows."""
        import scipy

        rows = {"rows": self._wanted.samples} if self._name == "lhs" else {}
        names = [column.name for column in self._columns]
        return {"columns": names, "scipy": scipy.__version__, **rows}

    def rows(self) -> Iterator[Row]:
        """Yield rows without end."""
        names, seed = [column.name for column in self._columns], self._wanted.seed
        for number, shares in enumerate(self._points(len(names))):
            yield Row(number, row_seed(seed, number), dict(zip(names, shares, strict=True)))

    def _points(self, dimensions: int) -> Iterator[list[float]]:
        seed = self._wanted.seed
        kind = getattr(self._qmc, KINDS[self._name])
        engine = kind(dimensions, scramble=True, rng=seed)
        block = self._wanted.samples if self._name == "lhs" else BLOCK
        while True:
            yield from engine.random(block).tolist()


def _qmc(name: str) -> Any:
    try:
        from scipy.stats import qmc
    except ImportError:
        raise CampaignError(
            f"--sampler {name} needs scipy: pip install 'osc2tx[campaign]'"
        ) from None
    return qmc

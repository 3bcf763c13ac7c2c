"""Rows in which all pairs of levels meet that constraints let meet.

One row after the other: the first pair that is missing is set, then the other parameters, each to
the level that meets most of what is missing. If constraints do not allow that row, other levels of
the others are tried; a pair is only given up after all of them, or after `TRIES`.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from itertools import combinations, islice, product
from math import prod
from typing import TypeAlias

__all__ = ["pairwise_rows"]

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
            del missing[pair]  # constraints do not let them meet


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
    """Complete a row with the levels that meet most of what is missing, the first of equals."""
    for index, count in enumerate(counts):
        if index in row:
            continue

        def met(level: int, index: int = index) -> int:
            pairs = (sorted((item, (index, level))) for item in row.items())
            return sum((one, other) in missing for one, other in pairs)

        row[index] = max(range(count), key=met)
    return [row[index] for index in range(len(counts))]

"""Points that fill a space evenly, the same ones each time."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count, islice
from typing import TypeVar

RowT = TypeVar("RowT")


def hypercube(dimensions: int, number: int) -> list[tuple[float, ...]]:
    """Return points of a Latin hypercube, from 0 to 1 in each dimension."""
    columns = []
    for base in islice(_primes(), dimensions):
        keys = [(_radical_inverse(i, base), i) for i in range(number)]
        order = {i: rank for rank, (_, i) in enumerate(sorted(keys))}
        columns.append([order[i] / (number - 1) for i in range(number)])
    return list(zip(*columns, strict=True))


def _primes() -> Iterator[int]:
    """Yield the prime numbers."""
    found: list[int] = []
    for number in count(2):
        if all(number % prime for prime in found):
            found.append(number)
            yield number


def _radical_inverse(number: int, base: int) -> float:
    """Return the fraction whose digits are those of a number backwards."""
    inverse, digit = 0.0, 1.0 / base
    while number:
        number, rest = divmod(number, base)
        inverse += rest * digit
        digit /= base
    return inverse


def thinned(rows: list[RowT], wanted: int) -> list[RowT]:
    """Return at most so many rows, evenly chosen."""
    if len(rows) <= wanted:
        return rows
    return [rows[index * (len(rows) - 1) // (wanted - 1)] for index in range(wanted)]

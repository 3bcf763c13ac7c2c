"""Piecewise cubic polynomials over road s: widths, offsets, elevation, superelevation."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence

Row = tuple[float, float, float, float]
"""Coefficients a, b, c, d of a + b u + c u^2 + d u^3 with u = s - start."""


class Piecewise:
    """Cubic pieces; each is valid from its start to that of the next.

    Before the first start the first piece is extrapolated, after the last start the last one, so
    files with small gaps at the ends remain continuous.
    """

    __slots__ = ("rows", "starts")

    def __init__(self, starts: Sequence[float], rows: Sequence[Row]) -> None:
        self.starts = list(starts)
        self.rows = list(rows)

    @classmethod
    def from_records(cls, records: Iterable[tuple[float, Row]]) -> Piecewise | None:
        """Sorts (start, row) records.

        Of several with the same start the last in the file counts.
        """
        table = dict(sorted(records, key=lambda record: record[0]))
        return cls(list(table), list(table.values())) if table else None

    def index(self, s: float) -> int:
        """Number of the piece at `s`."""
        return max(bisect_right(self.starts, s) - 1, 0)

    def value(self, s: float) -> float:
        """Value at road coordinate `s` (m)."""
        i = bisect_right(self.starts, s) - 1 if len(self.starts) > 1 else 0
        if i < 0:
            i = 0
        a, b, c, d = self.rows[i]
        u = s - self.starts[i]
        return a + u * (b + u * (c + u * d))

    def value_slope(self, s: float) -> tuple[float, float]:
        """Value and first derivative at `s`."""
        i = bisect_right(self.starts, s) - 1 if len(self.starts) > 1 else 0
        if i < 0:
            i = 0
        a, b, c, d = self.rows[i]
        u = s - self.starts[i]
        return a + u * (b + u * (c + u * d)), b + u * (2.0 * c + u * 3.0 * d)

    def extremes(self, begin: float, end: float) -> tuple[float, float]:
        """Least and greatest value between two road coordinates (m)."""
        least, greatest = math.inf, -math.inf
        last = len(self.starts) - 1
        for i in range(self.index(begin), self.index(end) + 1):
            a, b, c, d = self.rows[i]
            start = self.starts[i]
            low = begin - start if i == 0 else max(begin - start, 0.0)
            high = end - start if i == last else min(end, self.starts[i + 1]) - start
            values = [a + u * (b + u * (c + u * d)) for u in (low, high)]
            if c or d:
                values += [
                    a + u * (b + u * (c + u * d))
                    for u in _roots(b, 2.0 * c, 3.0 * d)
                    if low < u < high
                ]
            least, greatest = min(least, *values), max(greatest, *values)
        return least, greatest

    def constant(self) -> float | None:
        """The value if it is constant and stated once, else None."""
        a, b, c, d = self.rows[0]
        return None if len(self.rows) > 1 or b or c or d else a

    def is_zero(self) -> bool:
        """True if every coefficient is zero."""
        return not any(any(row) for row in self.rows)

    def shifted_row(self, s: float) -> Row:
        """The piece at `s`, re-expanded around `s`."""
        i = self.index(s)
        a, b, c, d = self.rows[i]
        u = s - self.starts[i]
        return (
            a + u * (b + u * (c + u * d)),
            b + u * (2.0 * c + u * 3.0 * d),
            c + 3.0 * d * u,
            d,
        )


def _roots(a: float, b: float, c: float) -> tuple[float, ...]:
    """The roots of a + b u + c u^2, without cancellation."""
    below = b * b - 4.0 * a * c
    if below < 0.0:
        return ()
    q = -0.5 * (b + math.copysign(math.sqrt(below), b))
    return tuple(up / down for up, down in ((q, c), (a, q)) if down)


ZERO = Piecewise([0.0], [(0.0, 0.0, 0.0, 0.0)])


def between(starts: list[float], begin: float, end: float) -> list[float]:
    """The sorted positions strictly between two others."""
    return starts[bisect_right(starts, begin) : bisect_left(starts, end)]


def combine(terms: Sequence[tuple[float, Piecewise]], begin: float, end: float) -> Piecewise:
    """Weighted sum of piecewise polynomials on [begin, end], as one table.

    One table per lane line makes a query one bisection instead of one per inner lane.
    """
    starts = [begin]
    for _, term in terms:
        if len(term.starts) > 1:
            starts.extend(between(term.starts, begin, end))
    if len(starts) > 1:
        starts = sorted(dict.fromkeys(starts))
    rows: list[Row] = []
    for start in starts:
        a = b = c = d = 0.0
        for weight, term in terms:
            ta, tb, tc, td = term.shifted_row(start)
            a += weight * ta
            b += weight * tb
            c += weight * tc
            d += weight * td
        rows.append((a, b, c, d))
    return Piecewise(starts, rows)

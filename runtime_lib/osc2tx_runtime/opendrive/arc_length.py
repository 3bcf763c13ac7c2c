"""Arc length along a lane centre line as a table: the length at a position, and its inverse.

Distances in the DSL run along the lane centre line on the xy plane (OpenSCENARIO DSL 8.3.4), not
along road s: on a tight curve both differ by up to a third. Each lane therefore gets a table of its
arc length F over s. A parallel line at offset o (m, in direction of +t) has the length F(s) - o
psi(s), psi being the turn of the reference line. This is exact for constant width, additive and
cheap to invert, so many small steps end at the same position as one long step.
"""

from __future__ import annotations

import math
from bisect import bisect_right

from .polynomials import Row

SLOWEST_RATE = 1e-3
"""Least lane metres per metre of s: a lane inside the centre of curvature must not run
backwards."""


class LaneLine:
    """Arc length table of one lane of one section.

    Args:
        begin: Start of the section (m of s).
        end: Its end.

    Attributes:
        length: Arc length of the centre line (m).
        turn: Angle (rad) that the reference line turns through.
        nodes: Start positions (s) of the pieces of the table.
        rows: Cubic polynomials of the arc length, by piece.
        psi: Cubic polynomials of the angle, likewise.
        offset_min: Least offset (m, +t) of a parallel line that runs forwards.
        offset_max: Greatest such offset.
    """

    __slots__ = (
        "begin",
        "end",
        "length",
        "nodes",
        "offset_max",
        "offset_min",
        "psi",
        "rows",
        "turn",
    )

    def __init__(self, begin: float, end: float) -> None:
        self.begin, self.end = begin, end
        self.length = self.turn = 0.0
        self.nodes: list[float] = []
        self.rows: list[Row] = []
        self.psi: list[Row] = []
        self.offset_min, self.offset_max = -math.inf, math.inf

    def clamp(self, offset: float) -> float:
        """Offset (m, +t), limited so that the parallel line runs forwards."""
        return min(max(offset, self.offset_min), self.offset_max)

    def length_at(self, s: float, offset: float = 0.0) -> float:
        """Arc length from the start of the section to `s` (m), at an offset in +t (m)."""
        i = bisect_right(self.nodes, s) - 1 if len(self.nodes) > 1 else 0
        if i < 0:
            i = 0
        a, b, c, d = self.rows[i]
        u = s - self.nodes[i]
        length = a + u * (b + u * (c + u * d))
        if offset:
            a, b, c, d = self.psi[i]
            length -= offset * (a + u * (b + u * (c + u * d)))
        return length

    def s_at(self, length: float, offset: float = 0.0) -> float:
        """Inverse of `length_at`, limited to the section."""
        return self.s_in(self.row_of(length, offset), length, offset)

    def row_of(self, length: float, offset: float) -> int:
        """Number of the piece of an arc length (m), at an offset in +t (m)."""
        low, high = 0, len(self.nodes)
        while high - low > 1:
            middle = (low + high) // 2
            if self.rows[middle][0] - offset * self.psi[middle][0] <= length:
                low = middle
            else:
                high = middle
        return low

    def s_in(self, low: int, length: float, offset: float) -> float:
        """The s of an arc length (m) in a piece, at an offset in +t (m)."""
        begin = self.nodes[low]
        end = self.nodes[low + 1] if low + 1 < len(self.nodes) else self.end
        a, b, c, d = self.rows[low]
        if offset:
            pa, pb, pc, pd = self.psi[low]
            a, b, c, d = a - offset * pa, b - offset * pb, c - offset * pc, d - offset * pd
        u, limit = 0.0, end - begin
        if c == 0.0 and d == 0.0 and b > SLOWEST_RATE:  # straight lines and arcs of constant width
            return begin + min(max((length - a) / b, 0.0), limit)
        for _ in range(20):
            gap = length - (a + u * (b + u * (c + u * d)))
            rate = b + u * (2.0 * c + u * 3.0 * d)
            step = gap / rate if rate > SLOWEST_RATE else gap
            following = min(max(u + step, 0.0), limit)
            if abs(following - u) <= 1e-11:
                u = following
                break
            u = following
        return begin + u

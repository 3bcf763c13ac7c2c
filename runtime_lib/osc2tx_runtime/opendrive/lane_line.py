"""Arc length along lane centre lines, and its inverse.

Distances in the DSL run along the lane centre line on the xy plane (OpenSCENARIO DSL 8.3.4), not
along road s: on a tight curve both differ by up to a third. Each lane therefore gets a table of
its arc length F over s. A parallel line at offset o (m, in direction of +t) has the length
F(s) - o psi(s), psi being the heading the reference line has turned through: that is exact where
the lane keeps its width, additive and cheap to invert, so moving in many small steps ends where
one long step ends.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from itertools import pairwise

from .geometry import GAUSS, Segment, hermite
from .model import Lane
from .polynomials import Row

__all__ = ["LaneLine", "lane_line"]

_STEP = 2.0  # m between nodes where curvature or width change
_FLOOR = 1e-3  # a lane inside the centre of curvature must not run backwards


class LaneLine:
    """Arc length table of one lane of one section.

    Attributes:
        length: Arc length of the centre line (m).
        turn: Angle (rad) that the reference line turns through.
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

    def __init__(self, lane: Lane) -> None:
        section = lane.section
        if not section.ready:
            section.prepare()
        self.begin, self.end = section.begin, section.end
        self.nodes: list[float] = []
        self.rows: list[Row] = []
        self.psi: list[Row] = []
        self.offset_min, self.offset_max = -math.inf, math.inf
        total = [0.0, 0.0]
        if self.end > self.begin:
            breaks = self._breaks(lane)
            for begin, end in pairwise(breaks):
                self._piece(lane, begin, end, total)
        else:
            self.nodes, self.rows, self.psi = [self.begin], [(0, 0, 0, 0)], [(0, 0, 0, 0)]
        self.length, self.turn = total

    def _breaks(self, lane: Lane) -> list[float]:
        starts = [*lane.road.reference.starts, *lane.centre.starts]
        if lane.road.superelevation is not None:
            starts.extend(lane.road.superelevation.starts)
        inner = (s for s in starts if self.begin < s < self.end)
        return sorted(dict.fromkeys((self.begin, *inner, self.end)))

    def _piece(self, lane: Lane, begin: float, end: float, total: list[float]) -> None:
        """Adds nodes for one piece of smooth geometry and width."""
        start, segment = lane.road.reference.segment_at(0.5 * (begin + end))
        curvature = segment.constant_curvature()
        _, b, c, d = lane.centre.rows[lane.centre.index(0.5 * (begin + end))]
        even = c == 0.0 and d == 0.0 and (b == 0.0 or curvature == 0.0)
        even = even and curvature is not None and lane.road.superelevation is None
        count = 1 if even else max(1, math.ceil((end - begin) / _STEP))
        step = (end - begin) / count
        # One-sided values: at a joint the neighbouring piece may have another curvature.
        inset = 1e-9 * step
        before = self._rate(lane, segment, start, begin + inset)
        for i in range(count):
            node = begin + i * step
            after = self._rate(lane, segment, start, node + step - inset)
            self._interval(lane, segment, start, (node, step), (before, after), total)
            before = after

    def _interval(
        self,
        lane: Lane,
        segment: Segment,
        start: float,
        span: tuple[float, float],
        rates: tuple[tuple[float, float], tuple[float, float]],
        total: list[float],
    ) -> None:
        node, step = span
        length = turn = 0.0
        for position, weight in GAUSS:
            rate, curvature = self._rate(lane, segment, start, node + position * step)
            length += weight * rate
            turn += weight * curvature
        (g0, k0), (g1, k1) = rates
        length, turn = length * step, turn * step
        self.nodes.append(node)
        self.rows.append(_from(total[0], hermite(step, (0.0, length), (g0, g1))))
        self.psi.append(_from(total[1], hermite(step, (0.0, turn), (k0, k1))))
        total[0] += length
        total[1] += turn
        for rate, curvature in rates:
            if curvature > 0.0:
                self.offset_max = min(self.offset_max, 0.9 * rate / curvature)
            elif curvature < 0.0:
                self.offset_min = max(self.offset_min, 0.9 * rate / curvature)

    @staticmethod
    def _rate(lane: Lane, segment: Segment, start: float, s: float) -> tuple[float, float]:
        """Lane metres per metre of s, and the curvature of the reference line."""
        curvature = segment.at(s - start)[3]
        t, slope = lane.centre.value_slope(s)
        roll = lane.road.superelevation
        if roll is not None:
            angle, rate = roll.value_slope(s)
            slope = slope * math.cos(angle) - t * math.sin(angle) * rate
            t *= math.cos(angle)
        along = max(1.0 - curvature * t, _FLOOR)
        return math.hypot(along, slope) if slope else along, curvature

    def clamp(self, offset: float) -> float:
        """Offset (m, +t) limited to where the parallel line still runs forwards."""
        return min(max(offset, self.offset_min), self.offset_max)

    def length_at(self, s: float, offset: float = 0.0) -> float:
        """Arc length from the begin of the section to `s` (m), at an offset in +t (m)."""
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
        low, high = 0, len(self.nodes)
        while high - low > 1:
            middle = (low + high) // 2
            if self.rows[middle][0] - offset * self.psi[middle][0] <= length:
                low = middle
            else:
                high = middle
        begin = self.nodes[low]
        end = self.nodes[low + 1] if low + 1 < len(self.nodes) else self.end
        a, b, c, d = self.rows[low]
        if offset:
            pa, pb, pc, pd = self.psi[low]
            a, b, c, d = a - offset * pa, b - offset * pb, c - offset * pc, d - offset * pd
        u, limit = 0.0, end - begin
        if c == 0.0 and d == 0.0 and b > _FLOOR:  # straight lines and arcs of constant width
            return begin + min(max((length - a) / b, 0.0), limit)
        for _ in range(20):
            gap = length - (a + u * (b + u * (c + u * d)))
            rate = b + u * (2.0 * c + u * 3.0 * d)
            step = gap / rate if rate > _FLOOR else gap
            following = min(max(u + step, 0.0), limit)
            if abs(following - u) <= 1e-11:
                u = following
                break
            u = following
        return begin + u


def _from(base: float, row: Row) -> Row:
    return base + row[0], row[1], row[2], row[3]


def lane_line(lane: Lane) -> LaneLine:
    """The table of a lane, built on first use."""
    line = lane.line
    if line is None:
        line = lane.line = LaneLine(lane)
    return line

"""Fills the arc length tables of lanes from the geometry of their roads; see `arc_length`."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from itertools import pairwise

from .arc_length import SLOWEST_RATE, LaneLine
from .geometry import GAUSS, Segment, hermite
from .model import Lane
from .polynomials import Row, between

_STEP = 2.0  # m between nodes where curvature or width change
_MOST = 10_000  # nodes of one piece: its steps are longer from 20 km on


def lane_line(lane: Lane) -> LaneLine:
    """The table of a lane, built on first use."""
    line = lane.line
    if line is None:
        line = lane.line = _build(lane)
    return line


def lane_length(lane: Lane) -> float:
    """Arc length of a lane (m), without a table for constant width along lines and arcs."""
    if lane.line is None and lane.road.superelevation is None:
        t = _even_centre(lane)
        turn = None if t is None else _turn(lane, t)
        if t is not None and turn is not None:
            return lane.section.end - lane.section.begin - t * turn
    return lane_line(lane).length


def _even_centre(lane: Lane) -> float | None:
    """The t of the centre if it is constant."""
    t = lane.road.lane_offset.constant()
    side = lane.section.left if lane.id > 0 else lane.section.right
    sign = 1.0 if lane.id > 0 else -1.0
    for each in side:
        width = None if each.width is None else each.width.constant()
        if t is None or width is None:
            return None
        if each is lane:
            return t + 0.5 * sign * width
        t += sign * width
    return None


def _turn(lane: Lane, t: float) -> float | None:
    """Turn of the road along a lane (rad).

    None if its curvature is not piecewise constant, and inside the centre of an arc, where the
    length of the lane has no simple form.
    """
    reference, begin, end = lane.road.reference, lane.section.begin, lane.section.end
    starts = reference.starts
    first = max(bisect_right(starts, begin) - 1, 0)
    ends = [*starts[first + 1 : bisect_left(starts, end, first + 1)], end]
    total = 0.0
    for i, (low, high) in enumerate(pairwise([begin, *ends]), start=first):
        span = high - low
        if span > 0.0:
            curvature = reference.segments[i].constant_curvature()
            if curvature is None or 1.0 - curvature * t < SLOWEST_RATE:
                return None
            total += curvature * span
    return total


def _build(lane: Lane) -> LaneLine:
    section = lane.section
    if not section.ready:
        section.prepare()
    line = LaneLine(section.begin, section.end)
    if line.end > line.begin:
        for begin, end in pairwise(_breaks(lane, line)):
            _add_piece(line, lane, begin, end)
    else:
        line.nodes, line.rows, line.psi = [line.begin], [(0, 0, 0, 0)], [(0, 0, 0, 0)]
    return line


def _breaks(lane: Lane, line: LaneLine) -> list[float]:
    found = {line.begin, line.end}
    for each in (lane.road.reference, lane.centre, lane.road.superelevation):
        if each is not None:
            found.update(between(each.starts, line.begin, line.end))
    return sorted(found)


def _add_piece(line: LaneLine, lane: Lane, begin: float, end: float) -> None:
    """Adds nodes for one piece of smooth geometry and width."""
    start, segment = lane.road.reference.segment_at(0.5 * (begin + end))
    curvature = segment.constant_curvature()
    _, b, c, d = lane.centre.rows[lane.centre.index(0.5 * (begin + end))]
    even = c == 0.0 and d == 0.0 and (b == 0.0 or curvature == 0.0)
    even = even and curvature is not None and lane.road.superelevation is None
    count = 1 if even else min(max(1, math.ceil((end - begin) / _STEP)), _MOST)
    step = (end - begin) / count
    # One-sided values: at a joint the neighbouring piece may have another curvature.
    inset = 1e-9 * step
    before = _rate(lane, segment, start, begin + inset)
    for i in range(count):
        node = begin + i * step
        after = _rate(lane, segment, start, node + step - inset)
        inner = [_rate(lane, segment, start, node + position * step) for position, _ in GAUSS]
        _add_interval(line, (node, step), inner, (before, after))
        before = after


def _add_interval(
    line: LaneLine,
    span: tuple[float, float],
    inner: list[tuple[float, float]],
    rates: tuple[tuple[float, float], tuple[float, float]],
) -> None:
    """Adds one node, with rate and curvature at the points of the quadrature."""
    node, step = span
    length = turn = 0.0
    for (_, weight), (rate, curvature) in zip(GAUSS, inner, strict=True):
        length += weight * rate
        turn += weight * curvature
    (g0, k0), (g1, k1) = rates
    length, turn = length * step, turn * step
    line.nodes.append(node)
    line.rows.append(_from(line.length, hermite(step, (0.0, length), (g0, g1))))
    line.psi.append(_from(line.turn, hermite(step, (0.0, turn), (k0, k1))))
    line.length += length
    line.turn += turn
    for rate, curvature in rates:
        if curvature > 0.0:
            line.offset_max = min(line.offset_max, 0.9 * rate / curvature)
        elif curvature < 0.0:
            line.offset_min = max(line.offset_min, 0.9 * rate / curvature)


def _rate(lane: Lane, segment: Segment, start: float, s: float) -> tuple[float, float]:
    """Lane metres per metre of s, and the curvature of the reference line."""
    curvature = segment.at(s - start)[3]
    t, slope = lane.centre.value_slope(s)
    roll = lane.road.superelevation
    if roll is not None:
        angle, rate = roll.value_slope(s)
        slope = slope * math.cos(angle) - t * math.sin(angle) * rate
        t *= math.cos(angle)
    along = max(1.0 - curvature * t, SLOWEST_RATE)
    return math.hypot(along, slope) if slope else along, curvature


def _from(base: float, row: Row) -> Row:
    return base + row[0], row[1], row[2], row[3]

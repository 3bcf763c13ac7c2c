"""Collision detection of moving bounding boxes, swept over a step."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from .state import ActorState

__all__ = ["Box", "Standing", "box_of", "contact_interval", "overlapping", "swept_contacts"]

_NEAR = 1e-4  # m to which contacts of turning boxes are found


class Box(NamedTuple):
    """An upright box on the ground.

    Attributes:
        x: World x of the centre (m).
        y: World y of the centre (m).
        low: World z of the bottom (m).
        high: World z of the top (m).
        cos: Cosine of the heading.
        sin: Sine of the heading.
        half_length: Metres.
        half_width: Metres.
        reach_x: How far it reaches from the centre along the x axis of the world (m).
        reach_y: The same along the y axis (m).
    """

    x: float
    y: float
    low: float
    high: float
    cos: float
    sin: float
    half_length: float
    half_width: float
    reach_x: float
    reach_y: float


def box_of(state: ActorState) -> Box:
    """Bounding box of an actor."""
    x, y, z, h = state[:4]
    shape = state.shape
    c, n = math.cos(h), math.sin(h)
    half, width = 0.5 * shape.length, 0.5 * shape.width
    ahead = half - shape.rear
    return Box(
        x + ahead * c,
        y + ahead * n,
        z,
        z + shape.height,
        c,
        n,
        half,
        width,
        half * abs(c) + width * abs(n),
        half * abs(n) + width * abs(c),
    )


def contact_interval(
    a: Box, b: Box, dx: float, dy: float, slack: float = 0.0
) -> tuple[float, float] | None:
    """Times between which b, moving by (dx, dy) per unit of time against a, touches a.

    Exact for boxes that do not turn. None if they never touch, or come as near as `slack` (m);
    heights are not looked at.
    """
    px, py = b.x - a.x, b.y - a.y
    cross = abs(a.cos * b.sin - a.sin * b.cos)
    along = abs(a.cos * b.cos + a.sin * b.sin)
    # The four separating axes: both axes of both boxes, each with the sum of the half extents.
    reach_a = b.half_length * along + b.half_width * cross
    broad_a = b.half_length * cross + b.half_width * along
    reach_b = a.half_length * along + a.half_width * cross
    broad_b = a.half_length * cross + a.half_width * along
    entry, leave = -math.inf, math.inf
    for ux, uy, reach in (
        (a.cos, a.sin, a.half_length + reach_a + slack),
        (-a.sin, a.cos, a.half_width + broad_a + slack),
        (b.cos, b.sin, b.half_length + reach_b + slack),
        (-b.sin, b.cos, b.half_width + broad_b + slack),
    ):
        p = px * ux + py * uy
        q = dx * ux + dy * uy
        if abs(q) < 1e-12:
            if abs(p) > reach:
                return None
            continue
        first, last = (-reach - p) / q, (reach - p) / q
        if first > last:
            first, last = last, first
        entry, leave = max(entry, first), min(leave, last)
        if entry > leave:
            return None
    return entry, leave


def overlapping(a: Box, b: Box) -> bool:
    """True if two boxes have a common point."""
    if a.low > b.high or b.low > a.high:
        return False
    found = contact_interval(a, b, 0.0, 0.0)
    return found is not None


def _touch(a: Box, a_end: Box, b: Box, b_end: Box) -> bool:
    """True if two boxes touch at any time of a step."""
    if min(a.low, a_end.low) > max(b.high, b_end.high):
        return False
    if min(b.low, b_end.low) > max(a.high, a_end.high):
        return False
    turns = _turn(a, a_end), _turn(b, b_end)
    if not any(turns):
        return _meet(a, a_end, b, b_end, 0.0)
    return _meet_turning((a, a_end, turns[0]), (b, b_end, turns[1]), 0.0, 1.0)


def _meet(a: Box, a_end: Box, b: Box, b_end: Box, slack: float) -> bool:
    """True if two boxes that do not turn come nearer than `slack` (m) on their way."""
    moving = contact_interval(
        a, b, b_end.x - b.x - a_end.x + a.x, b_end.y - b.y - a_end.y + a.y, slack
    )
    return moving is not None and moving[0] <= 1.0 and moving[1] >= 0.0


_Sweep = tuple[Box, Box, float]
"""A box at begin and end of a step, and how much it turns (rad)."""


def _meet_turning(one: _Sweep, other: _Sweep, begin: float, end: float) -> bool:
    """True if two boxes touch within a part of a step.

    Within the part they are taken as they stand in the middle of it. Their corners are then off by
    at most half of the turn times their distance from the centre: who stays farther apart does not
    touch, else the halves of the part are looked at, until that is less than `_NEAR`.
    """
    middle = 0.5 * (begin + end)
    a, a_end = _part(one, begin, end)
    b, b_end = _part(other, begin, end)
    slack = (end - begin) * (_swing(one) + _swing(other))
    if not _meet(a, a_end, b, b_end, slack):
        return False
    if slack < _NEAR:
        return _meet(a, a_end, b, b_end, 0.0)
    return _meet_turning(one, other, begin, middle) or _meet_turning(one, other, middle, end)


def _swing(sweep: _Sweep) -> float:
    """Metres by which the corners of a box turn in half a step."""
    box, _, turn = sweep
    return 0.5 * abs(turn) * math.hypot(box.half_length, box.half_width)


def _part(sweep: _Sweep, begin: float, end: float) -> tuple[Box, Box]:
    """A box at both ends of a part of a step, turned as in the middle of it."""
    box, goal, turn = sweep
    heading = math.atan2(box.sin, box.cos) + 0.5 * (begin + end) * turn
    turned = box._replace(cos=math.cos(heading), sin=math.sin(heading))
    return _moved(turned, goal, begin), _moved(turned, goal, end)


def _moved(box: Box, goal: Box, share: float) -> Box:
    """A box on its way, without turning."""
    x, y = box.x + share * (goal.x - box.x), box.y + share * (goal.y - box.y)
    return box._replace(x=x, y=y)


def _turn(begin: Box, end: Box) -> float:
    """How much a box turns in a step (rad)."""
    if begin.cos == end.cos and begin.sin == end.sin:
        return 0.0
    sin = begin.cos * end.sin - begin.sin * end.cos
    return math.atan2(sin, begin.cos * end.cos + begin.sin * end.sin)


class Standing:
    """Boxes that stand, found by place.

    Args:
        boxes: All boxes.
        who: Indices of those that stand.
    """

    def __init__(self, boxes: Sequence[Box], who: Iterable[int]) -> None:
        self._spans = sorted(_span(boxes[i], boxes[i], i) for i in who)
        self._lefts = [span[0] for span in self._spans]
        self._widest = _NEAR + max((right - left for left, right, *_ in self._spans), default=0.0)

    def beside(self, left: float, right: float) -> list[_Span]:
        """Return what those cover that reach between two places on the x axis (m)."""
        first = bisect_left(self._lefts, left - self._widest)
        last = bisect_right(self._lefts, right)
        return [span for span in self._spans[first:last] if span[1] >= left]


def swept_contacts(
    begin: Sequence[Box],
    end: Sequence[Box],
    who: Iterable[int] | None = None,
    standing: Standing | None = None,
) -> list[tuple[int, int]]:
    """Pairs of boxes (indices, lower first) that touch during a step, sorted.

    Args:
        begin: Boxes at the begin of the step.
        end: Boxes at its end, in the same order.
        who: Indices of those that are looked at; by default all.
        standing: Those that they are looked at with, beside each other.
    """
    # Sorted by their left ends, so that only those are compared that overlap in x; most of them,
    # in the lane beside, do not overlap in y.
    chosen = range(len(begin)) if who is None else who
    spans = sorted([_span(begin[i], end[i], i) for i in chosen])
    active: list[_Span] = []
    found: list[tuple[int, int]] = []
    for span in spans:
        left, right, low, high, i = span
        active = [other for other in active if other[1] >= left]
        others = active if standing is None else active + standing.beside(left, right)
        for _, _, other_low, other_high, j in others:
            if (
                other_low <= high
                and low <= other_high
                and _touch(begin[j], end[j], begin[i], end[i])
            ):
                found.append((i, j) if i < j else (j, i))
        active.append(span)
    found.sort()
    return found


_Span = tuple[float, float, float, float, int]
"""What a box covers on the way through a step: in x from and to, in y from and to; its index."""


def _span(b: Box, e: Box, index: int) -> _Span:
    x = b.reach_x if b.reach_x > e.reach_x else e.reach_x
    y = b.reach_y if b.reach_y > e.reach_y else e.reach_y
    # In between one that turns reaches farther, but not beyond its corners.
    if b.cos != e.cos or b.sin != e.sin:
        turn = abs(_turn(b, e))
        bulge = math.hypot(b.half_length, b.half_width) * (1.0 - math.cos(min(0.5 * turn, 1.6)))
        x, y = x + bulge, y + bulge
    left, right = (b.x, e.x) if b.x < e.x else (e.x, b.x)
    low, high = (b.y, e.y) if b.y < e.y else (e.y, b.y)
    return left - x, right + x, low - y, high + y, index

"""Collision detection of moving bounding boxes, swept over a step."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from osc2tx_runtime.world.state import ActorState

_NEAR = 1e-4  # m: precision of contacts of turning boxes


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
        reach_x: Extent from the centre along the x axis of the world (m).
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

    Exact for boxes that do not turn. None if they never touch, or come within `slack` (m); heights
    are ignored.
    """
    px, py = b.x - a.x, b.y - a.y
    entry, leave = -math.inf, math.inf
    for ux, uy, both in _axes(a, b):
        reach = both + slack
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


def apart(a: Box, b: Box) -> tuple[float, float, float]:
    """Distance (m) of two boxes along the best separating axis, and that axis.

    Not positive if they have a common point.
    """
    px, py = b.x - a.x, b.y - a.y
    return max([(abs(px * ux + py * uy) - reach, ux, uy) for ux, uy, reach in _axes(a, b)])


def overlap_along(a: Box, b: Box) -> float:
    """Overlap (m) of two boxes along the first one."""
    ux, uy, both = _axes(a, b)[0]
    return both - abs((b.x - a.x) * ux + (b.y - a.y) * uy)


def _axes(a: Box, b: Box) -> tuple[tuple[float, float, float], ...]:
    """The four separating axes: both axes of both boxes, each with the sum of the half extents."""
    cross = abs(a.cos * b.sin - a.sin * b.cos)
    along = abs(a.cos * b.cos + a.sin * b.sin)
    reach_a = b.half_length * along + b.half_width * cross
    broad_a = b.half_length * cross + b.half_width * along
    reach_b = a.half_length * along + a.half_width * cross
    broad_b = a.half_length * cross + a.half_width * along
    return (
        (a.cos, a.sin, a.half_length + reach_a),
        (-a.sin, a.cos, a.half_width + broad_a),
        (b.cos, b.sin, b.half_length + reach_b),
        (-b.sin, b.cos, b.half_width + broad_b),
    )


def overlapped(box: Box, others: Mapping[str, Box]) -> list[str]:
    """The ids of the boxes that have a common point with one, in their order."""
    near = [
        (actor, other)
        for actor, other in others.items()
        if abs(other.x - box.x) <= box.reach_x + other.reach_x
        and abs(other.y - box.y) <= box.reach_y + other.reach_y
        and box.low <= other.high
        and other.low <= box.high
    ]
    return [actor for actor, other in near if contact_interval(box, other, 0.0, 0.0) is not None]


class Swept(NamedTuple):
    """The motion of a box in a step.

    Attributes:
        begin: The box at the start of the step.
        end: The box at its end.
        left: Least x that it covers (m).
        right: Greatest x.
        low: Least y.
        high: Greatest y.
    """

    begin: Box
    end: Box
    left: float
    right: float
    low: float
    high: float


def touch(one: Swept, other: Swept) -> bool:
    """True if two boxes touch at any time of a step."""
    if one.left > other.right or other.left > one.right:
        return False
    if one.low > other.high or other.low > one.high:
        return False
    a, a_end, b, b_end = one.begin, one.end, other.begin, other.end
    if min(a.low, a_end.low) > max(b.high, b_end.high):
        return False
    if min(b.low, b_end.low) > max(a.high, a_end.high):
        return False
    turns = _turn(a, a_end), _turn(b, b_end)
    if not any(turns):
        return _meet(a, a_end, b, b_end, 0.0)
    if contact_interval(a, b, 0.0, 0.0) is not None:
        return True
    return _touch_while_turning((a, a_end, turns[0]), (b, b_end, turns[1]), 0.0, 1.0)


def _meet(a: Box, a_end: Box, b: Box, b_end: Box, slack: float) -> bool:
    """True if two boxes that do not turn come nearer than `slack` (m) in their motion."""
    moving = contact_interval(
        a, b, b_end.x - b.x - a_end.x + a.x, b_end.y - b.y - a_end.y + a.y, slack
    )
    return moving is not None and moving[0] <= 1.0 and moving[1] >= 0.0


_Sweep = tuple[Box, Box, float]
"""A box at start and end of a step, and its turn (rad)."""


def _touch_while_turning(one: _Sweep, other: _Sweep, begin: float, end: float) -> bool:
    """True if two boxes touch within a part of a step.

    The boxes are evaluated with the heading at the middle of the part. Their corners then deviate
    by at most half of the turn times their distance from the centre: boxes farther apart do not
    touch; otherwise the halves of the part are tested, until the deviation is below `_NEAR`.
    """
    middle = 0.5 * (begin + end)
    a, a_end = _part(one, begin, end)
    b, b_end = _part(other, begin, end)
    slack = (end - begin) * (_swing(one) + _swing(other))
    if not _meet(a, a_end, b, b_end, slack):
        return False
    if slack < _NEAR:
        return _meet(a, a_end, b, b_end, 0.0)
    return _touch_while_turning(one, other, begin, middle) or _touch_while_turning(
        one, other, middle, end
    )


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
    """A box in motion without turning."""
    x, y = box.x + share * (goal.x - box.x), box.y + share * (goal.y - box.y)
    return box._replace(x=x, y=y)


def _turn(begin: Box, end: Box) -> float:
    """Turn of a box in a step (rad)."""
    if begin.cos == end.cos and begin.sin == end.sin:
        return 0.0
    sin = begin.cos * end.sin - begin.sin * end.cos
    return math.atan2(sin, begin.cos * end.cos + begin.sin * end.sin)


def swept(b: Box, e: Box) -> Swept:
    """The area covered by a box during a step."""
    x = b.reach_x if b.reach_x > e.reach_x else e.reach_x
    y = b.reach_y if b.reach_y > e.reach_y else e.reach_y
    # In between, a turning box extends farther, but not beyond its corners.
    if b.cos != e.cos or b.sin != e.sin:
        turn = abs(_turn(b, e))
        bulge = math.hypot(b.half_length, b.half_width) * (1.0 - math.cos(min(0.5 * turn, 1.6)))
        x, y = x + bulge, y + bulge
    left, right = (b.x, e.x) if b.x < e.x else (e.x, b.x)
    low, high = (b.y, e.y) if b.y < e.y else (e.y, b.y)
    return Swept(b, e, left - x, right + x, low - y, high + y)

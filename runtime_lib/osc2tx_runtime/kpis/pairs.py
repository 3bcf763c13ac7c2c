"""Measures of two actors at one step: gap, time to collision, time gap.

Boxes are upright and seen from above. Circles around the boxes exclude most pairs: only pairs that
may be nearer than all before are computed exactly.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx_runtime.world.measuring.collision import Box, contact_interval

from .measure import Moving, Scene, pairs_of

_STILL = 1e-9  # m/s


class _Least:
    """The least value of all pairs and steps, and of each pair."""

    name = ""
    worst = "min"

    def __init__(self) -> None:
        self._least: dict[tuple[str, str], float] = {}

    def results(self) -> Mapping[str, float | None]:
        """Return the least value of all, then that of each pair: `min_gap(ego,other)`."""
        found: dict[str, float | None] = {self.name: min(self._least.values(), default=None)}
        for (one, other), value in sorted(self._least.items()):
            found[f"{self.name}({one},{other})"] = value
        return found

    def _note(self, one: Moving, other: Moving, value: float) -> None:
        pair = one.id, other.id
        if value < self._least.get(pair, math.inf):
            self._least[pair] = value

    def _so_far(self, one: Moving, other: Moving) -> float:
        return self._least.get((one.id, other.id), math.inf)


class MinGap(_Least):
    """Least distance between the bounding boxes of two actors (m); 0 if they touch."""

    name = "min_gap"

    def observe(self, scene: Scene) -> None:
        """Evaluate the pairs that may be nearer than before."""
        for one, other in pairs_of(scene.actors):
            apart = math.hypot(other.box.x - one.box.x, other.box.y - one.box.y)
            if apart - one.reach - other.reach < self._so_far(one, other):
                self._note(one, other, box_distance(one.box, other.box))


class MinTimeToCollision(_Least):
    """Least time to collision (s): until two boxes touch if both continue straight at their speed.

    No value for a pair that was never on a collision course; 0 for a pair that touches.
    """

    name = "min_ttc"

    def observe(self, scene: Scene) -> None:
        """Evaluate the pairs whose circles meet sooner than the least time so far."""
        for one, other in pairs_of(scene.actors):
            dx, dy = other.vx - one.vx, other.vy - one.vy
            if _meeting(one, other, dx, dy) < self._so_far(one, other):
                contact = contact_interval(one.box, other.box, dx, dy)
                if contact is not None and contact[1] >= 0.0:
                    self._note(one, other, max(contact[0], 0.0))


def _meeting(one: Moving, other: Moving, dx: float, dy: float) -> float:
    """Return the time (s) until the circles around two boxes touch; infinity if never."""
    x, y = other.box.x - one.box.x, other.box.y - one.box.y
    reach = one.reach + other.reach
    gap = x * x + y * y - reach * reach
    if gap <= 0.0:
        return 0.0
    square, product = dx * dx + dy * dy, x * dx + y * dy
    if product >= 0.0 or square < _STILL:
        return math.inf
    root = product * product - square * gap
    return math.inf if root < 0.0 else (-product - math.sqrt(root)) / square


class MinTimeGap(_Least):
    """Least time gap (s): to the rear of the lead vehicle, at the speed of the follower.

    The lead vehicle counts if its box is in the straight strip ahead, as wide as the follower. The
    follower is named first.
    """

    name = "min_time_gap"

    def observe(self, scene: Scene) -> None:
        """Evaluate both orders of each pair."""
        for one, other in pairs_of(scene.actors):
            self._follow(one, other)
            self._follow(other, one)

    def _follow(self, me: Moving, ahead: Moving) -> None:
        speed = me.state.v
        if speed <= _STILL:
            return
        box, target = me.box, ahead.box
        x, y = target.x - box.x, target.y - box.y
        along, across = x * box.cos + y * box.sin, y * box.cos - x * box.sin
        if along <= 0.0:
            return
        cos = abs(box.cos * target.cos + box.sin * target.sin)
        sin = abs(box.cos * target.sin - box.sin * target.cos)
        width = box.half_width + target.half_length * sin + target.half_width * cos
        if abs(across) >= width:
            return
        rear = along - target.half_length * cos - target.half_width * sin
        self._note(me, ahead, max(rear - box.half_length, 0.0) / speed)


def box_distance(a: Box, b: Box) -> float:
    """Return the distance of two boxes, seen from above (m)."""
    if contact_interval(a, b, 0.0, 0.0) is not None:
        return 0.0
    # The nearest points of two boxes apart: one of them is always a corner.
    corners = (_beyond(a, x, y) for x, y in _corners(b))
    others = (_beyond(b, x, y) for x, y in _corners(a))
    return min(*corners, *others)


def _corners(box: Box) -> list[tuple[float, float]]:
    lx, ly = box.half_length * box.cos, box.half_length * box.sin
    wx, wy = -box.half_width * box.sin, box.half_width * box.cos
    return [
        (box.x + i * lx + j * wx, box.y + i * ly + j * wy) for i in (-1.0, 1.0) for j in (-1.0, 1.0)
    ]


def _beyond(box: Box, x: float, y: float) -> float:
    """Return the distance of a point from a box."""
    x, y = x - box.x, y - box.y
    along = abs(x * box.cos + y * box.sin) - box.half_length
    across = abs(y * box.cos - x * box.sin) - box.half_width
    return math.hypot(max(along, 0.0), max(across, 0.0))

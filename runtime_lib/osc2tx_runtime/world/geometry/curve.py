"""Curves through points: straight or cubic Hermite pieces, by arc length.

A curve runs over a parameter: metres from point to point for paths, seconds for trajectories.
Pieces are straight, or cubic (Hermite) with the tangents of the parabola through three points, so
that direction and (over time) speed have no jumps. Arc lengths are tabulated by Gauss quadrature.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

_PARTS = 8  # intervals of the arc length table per cubic piece
_GAUSS = (
    (0.1127016653792583, 0.2777777777777778),
    (0.5, 0.4444444444444444),
    (0.8872983346207417, 0.2777777777777778),
)
_COARSE = 0.02  # of the distance to a point: step of the search for its foot
_REMEMBERED = 64  # parameters cached by arc length: a search repeats some
_STILL = 1e-9  # metres per unit of the parameter

Vector = tuple[float, float, float]


class Knot(NamedTuple):
    """A point of a curve.

    Attributes:
        at: Parameter.
        x: World x (m).
        y: World y (m).
        z: World z (m).
        yaw: Required heading (rad); None: the heading of the curve.
    """

    at: float
    x: float
    y: float
    z: float
    yaw: float | None = None


class Curve:
    """A curve through at least two knots with ascending parameters.

    Attributes:
        begin: Parameter of the first knot.
        end: Parameter of the last knot.
        length: Arc length on the ground (m).
        knots: Parameters of the knots.
    """

    def __init__(self, knots: Sequence[Knot], smooth: bool) -> None:
        self._knots = tuple(_exact(knot) for knot in knots)
        self._starts = [knot.at for knot in self._knots]
        self.knots = tuple(self._starts)
        self.begin, self.end = self._starts[0], self._starts[-1]
        self._smooth = smooth and len(knots) > 2
        self._slopes = _slopes(self._knots) if self._smooth else []
        self._on_ground = self._pieces_on_ground()
        self._parameters: dict[float, float] = {}
        self._table = self._lengths()
        self.length = self._table[-1][1]
        self._nodes = [node for node, _ in self._table]
        self._sums = [total for _, total in self._table]

    # --- by parameter -------------------------------------------------------------------------

    def point(self, at: float) -> Vector:
        """Position at a parameter; beyond the ends on a straight line."""
        inside = min(max(at, self.begin), self.end)
        i, w, step = self._piece(inside)
        a, b = self._knots[i], self._knots[i + 1]
        if self._smooth:
            place = _hermite(a, b, self._slopes[i], self._slopes[i + 1], step, w)
        else:
            place = _mix(a, b, w)
        if at == inside:
            return place
        dx, dy, dz = self.rate(inside)
        over = at - inside
        return place[0] + over * dx, place[1] + over * dy, place[2] + over * dz

    def rate(self, at: float) -> Vector:
        """Derivative by the parameter: for trajectories the velocity (m/s)."""
        i, w, step = self._piece(min(max(at, self.begin), self.end))
        a, b = self._knots[i], self._knots[i + 1]
        if not self._smooth:
            return (b.x - a.x) / step, (b.y - a.y) / step, (b.z - a.z) / step
        return _hermite_rate(a, b, self._slopes[i], self._slopes[i + 1], step, w)

    def heading(self, at: float) -> float | None:
        """Direction of motion (rad); None at standstill."""
        dx, dy, _ = self.rate(at)
        return math.atan2(dy, dx) if math.hypot(dx, dy) > _STILL else None

    def yaw(self, at: float) -> float | None:
        """Heading that the points require (rad); None if open."""
        i, w, _ = self._piece(min(max(at, self.begin), self.end))
        a, b = self._knots[i].yaw, self._knots[i + 1].yaw
        if a is None or b is None:
            return a if w == 0.0 else b if w == 1.0 else None
        return a + w * turn_between(a, b)

    def _piece(self, at: float) -> tuple[int, float, float]:
        """Piece, share of it (0 to 1) and its length."""
        i = min(max(bisect_right(self._starts, at) - 1, 0), len(self._starts) - 2)
        step = self._starts[i + 1] - self._starts[i]
        return i, (at - self._starts[i]) / step, step

    # --- by arc length ------------------------------------------------------------------------

    def length_at(self, at: float) -> float:
        """Arc length (m) from the start to a parameter; beyond the ends on a straight line."""
        inside = min(max(at, self.begin), self.end)
        i = min(max(bisect_right(self._nodes, inside) - 1, 0), len(self._nodes) - 2)
        along = self._sums[i] + self._arc(self._nodes[i], inside)
        if at == inside:
            return along
        dx, dy, _ = self.rate(inside)
        return along + (at - inside) * math.hypot(dx, dy)

    def at_length(self, along: float) -> float:
        """Parameter at an arc length (m); beyond the ends extrapolated if the curve moves there."""
        found = self._parameters.get(along)
        if found is None:
            if len(self._parameters) >= _REMEMBERED:
                self._parameters.clear()
            found = self._parameters[along] = self._found_at_length(along)
        return found

    def _found_at_length(self, along: float) -> float:
        inside = min(max(along, 0.0), self.length)
        i = min(max(bisect_right(self._sums, inside) - 1, 0), len(self._sums) - 2)
        low, high = self._nodes[i], self._nodes[i + 1]
        rest, part = inside - self._sums[i], self._sums[i + 1] - self._sums[i]
        at = low + (high - low) * rest / part if part > 0.0 else low
        for _ in range(4):
            speed = self._speed(at)
            if speed <= _STILL:
                break
            before, at = at, min(max(at + (rest - self._arc(low, at)) / speed, low), high)
            if at == before:
                break
        if along != inside:
            speed = self._speed(at)
            at += (along - inside) / speed if speed > _STILL else 0.0
        return at

    def nearest(self, x: float, y: float, along: float, reach: float) -> float:
        """Arc length of the foot of a point, searched from `along` while the distance decreases.

        Args:
            x: World x (m).
            y: World y (m).
            along: Start of the search (m).
            reach: Distance (m) to search beyond a worse position.
        """
        best, best_distance = along, self.distance_to(x, y, along)
        step, ahead = 0.25 * reach, along
        while True:
            step = max(0.25 * reach, _COARSE * best_distance)  # a path may be a thousand km away
            if ahead >= min(best + 4.0 * step, self.length):
                break
            ahead = min(ahead + step, self.length)
            distance = self.distance_to(x, y, ahead)
            if distance < best_distance:
                best, best_distance = ahead, distance
        for _ in range(8):
            at = self.at_length(best)
            px, py, _ = self.point(at)
            heading = self.heading(at)
            if heading is None:
                break
            ahead = (x - px) * math.cos(heading) + (y - py) * math.sin(heading)
            following = max(best + min(max(ahead, -step), step), along)
            if abs(following - best) < 1e-9:
                break
            distance = self.distance_to(x, y, following)
            if distance >= best_distance:  # at a corner
                break
            best, best_distance = following, distance
        return best

    def distance_to(self, x: float, y: float, along: float) -> float:
        """Metres from a point to the position at an arc length."""
        px, py, _ = self.point(self.at_length(along))
        return math.hypot(x - px, y - py)

    def _arc(self, low: float, high: float) -> float:
        """Arc length between two parameters of one interval of the table."""
        span = high - low
        if not self._smooth:
            return span * self._speed(low)
        (a, p), (b, q), (c, r) = _GAUSS
        speed = self._speed
        return span * (
            p * speed(low + a * span) + q * speed(low + b * span) + r * speed(low + c * span)
        )

    def _speed(self, at: float) -> float:
        """Length of `rate` on the ground, written in plain numbers because it is called often."""
        inside = self.begin if at < self.begin else self.end if at > self.end else at
        i = bisect_right(self._starts, inside) - 1
        piece = self._on_ground[i]
        if len(piece) == 1:
            return piece[0]
        start, step, x, y, mx, my, nx, ny = piece
        w = (inside - start) / step
        w2 = w * w
        q = 6.0 * (w - w2) / step
        r, s = 3.0 * w2 - 4.0 * w + 1.0, 3.0 * w2 - 2.0 * w
        return math.hypot(q * x + r * mx + s * nx, q * y + r * my + s * ny)

    def _pieces_on_ground(self) -> list[tuple[float, ...]]:
        """What `_speed` needs of each piece, and of the last one again for the last knot.

        Its speed for a straight piece; for a cubic one begin and length in the parameter, the
        way from knot to knot, and the tangents there.
        """
        pieces: list[tuple[float, ...]] = []
        for i, (a, b) in enumerate(pairwise(self._knots)):
            step, x, y = b.at - a.at, b.x - a.x, b.y - a.y
            if self._smooth:
                m, n = self._slopes[i], self._slopes[i + 1]
                pieces.append((a.at, step, x, y, m[0], m[1], n[0], n[1]))
            else:
                pieces.append((math.hypot(x / step, y / step),))
        return [*pieces, pieces[-1]]

    def _lengths(self) -> list[tuple[float, float]]:
        total, table = 0.0, [(self.begin, 0.0)]
        parts = _PARTS if self._smooth else 1
        for low, high in zip(self._starts, self._starts[1:], strict=False):
            for j in range(parts):
                left = low + (high - low) * j / parts
                right = low + (high - low) * (j + 1) / parts
                total += self._arc(left, right)
                table.append((right, total))
        return table


def _exact(knot: Knot) -> Knot:
    """The same in plain numbers, if a scenario has measured them."""
    at, x, y, z = map(float, knot[:4])
    return Knot(at, x, y, z, None if knot.yaw is None else float(knot.yaw))


def turn_between(here: float, there: float) -> float:
    """Smallest angle (rad) from one heading to another."""
    return (there - here + math.pi) % math.tau - math.pi


def _mix(a: Knot, b: Knot, w: float) -> Vector:
    return a.x + w * (b.x - a.x), a.y + w * (b.y - a.y), a.z + w * (b.z - a.z)


def _slopes(knots: tuple[Knot, ...]) -> list[Vector]:
    """Tangents at the knots: of the parabola through a knot and its two nearest neighbours."""
    slopes = []
    for i, knot in enumerate(knots):
        first = min(max(i - 1, 0), len(knots) - 3)
        a, b, c = knots[first : first + 3]
        slopes.append(
            (
                _parabola((a.at, a.x), (b.at, b.x), (c.at, c.x), knot.at),
                _parabola((a.at, a.y), (b.at, b.y), (c.at, c.y), knot.at),
                _parabola((a.at, a.z), (b.at, b.z), (c.at, c.z), knot.at),
            )
        )
    return slopes


def _parabola(
    a: tuple[float, float], b: tuple[float, float], c: tuple[float, float], at: float
) -> float:
    """Slope at `at` of the parabola through three points."""
    first = (b[1] - a[1]) / (b[0] - a[0])
    second = (c[1] - b[1]) / (c[0] - b[0])
    bend = (second - first) / (c[0] - a[0])
    return first + bend * (2.0 * at - a[0] - b[0])


def _hermite(a: Knot, b: Knot, m: Vector, n: Vector, step: float, w: float) -> Vector:
    w2, w3 = w * w, w * w * w
    p, q = 2.0 * w3 - 3.0 * w2 + 1.0, 3.0 * w2 - 2.0 * w3
    r, s = (w3 - 2.0 * w2 + w) * step, (w3 - w2) * step
    return (
        p * a.x + q * b.x + r * m[0] + s * n[0],
        p * a.y + q * b.y + r * m[1] + s * n[1],
        p * a.z + q * b.z + r * m[2] + s * n[2],
    )


def _hermite_rate(a: Knot, b: Knot, m: Vector, n: Vector, step: float, w: float) -> Vector:
    w2 = w * w
    q = 6.0 * (w - w2) / step
    r, s = 3.0 * w2 - 4.0 * w + 1.0, 3.0 * w2 - 2.0 * w
    return (
        q * (b.x - a.x) + r * m[0] + s * n[0],
        q * (b.y - a.y) + r * m[1] + s * n[1],
        q * (b.z - a.z) + r * m[2] + s * n[2],
    )

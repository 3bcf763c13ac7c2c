"""Reference line geometry (OpenDRIVE chapter "Geometry"): line, arc, spiral, polynomials.

A segment maps the distance from its own start (m) to (x, y, heading, curvature). Scalar queries
use `math` only: for single points that is faster than numpy.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from itertools import pairwise
from typing import Protocol


def wrap(angle: float) -> float:
    """An angle in (-pi, pi]."""
    return math.pi - (math.pi - angle) % math.tau


Point = tuple[float, float, float, float]
"""x (m), y (m), heading (rad, not wrapped), curvature (1/m)."""

_N1 = math.sqrt(3.0 / 7.0 - 2.0 / 7.0 * math.sqrt(6.0 / 5.0))
_N2 = math.sqrt(3.0 / 7.0 + 2.0 / 7.0 * math.sqrt(6.0 / 5.0))
_W1 = (18.0 + math.sqrt(30.0)) / 72.0
_W2 = (18.0 - math.sqrt(30.0)) / 72.0
GAUSS: tuple[tuple[float, float], ...] = (
    (0.5 - 0.5 * _N2, _W2),
    (0.5 - 0.5 * _N1, _W1),
    (0.5 + 0.5 * _N1, _W1),
    (0.5 + 0.5 * _N2, _W2),
)
"""Nodes and weights of the 4-point Gauss-Legendre rule on [0, 1]."""

_PANEL_ANGLE = 0.2  # rad per panel: the error of the rule stays below 1e-12 of its length


class Segment(Protocol):
    """One piece of a reference line."""

    length: float

    @property
    def stretch(self) -> float:
        """Greatest curve length per metre of s (m)."""
        ...

    def at(self, u: float) -> Point:
        """Point at distance `u` (m) from the start of the piece."""
        ...

    def constant_curvature(self) -> float | None:
        """The curvature if it is constant, else None."""
        ...


class Line:
    """Straight piece."""

    __slots__ = ("c", "h", "length", "s", "x", "y")
    stretch = 1.0

    def __init__(self, x: float, y: float, h: float, length: float) -> None:
        self.x, self.y, self.h, self.length = x, y, h, length
        self.c, self.s = math.cos(h), math.sin(h)

    def at(self, u: float) -> Point:
        """Point at distance `u` (m)."""
        return self.x + u * self.c, self.y + u * self.s, self.h, 0.0

    def constant_curvature(self) -> float | None:
        """Zero."""
        return 0.0


class Arc:
    """Circular piece; the chord form has no cancellation for tiny curvatures."""

    __slots__ = ("h", "k", "length", "x", "y")
    stretch = 1.0

    def __init__(self, x: float, y: float, h: float, length: float, curvature: float) -> None:
        self.x, self.y, self.h, self.length, self.k = x, y, h, length, curvature

    def at(self, u: float) -> Point:
        """Point at distance `u` (m)."""
        half = 0.5 * self.k * u
        chord = u * math.sin(half) / half if abs(half) > 1e-9 else u
        mid = self.h + half
        return (
            self.x + chord * math.cos(mid),
            self.y + chord * math.sin(mid),
            mid + half,
            self.k,
        )

    def constant_curvature(self) -> float | None:
        """The curvature of the arc (1/m)."""
        return self.k


class Spiral:
    """Clothoid; integrated by Gauss-Legendre from the start of the panel that holds the point."""

    __slots__ = ("h", "k", "length", "panels", "rate", "starts")
    stretch = 1.0

    def __init__(
        self, x: float, y: float, h: float, length: float, k_start: float, k_end: float
    ) -> None:
        self.h, self.length, self.k = h, length, k_start
        self.rate = (k_end - k_start) / length
        angle = max(abs(k_start), abs(k_end)) * length
        count = min(max(1, math.ceil(angle / _PANEL_ANGLE)), 10_000)
        self.starts = [length * i / count for i in range(count)]
        self.panels = [(x, y)]
        for begin, end in pairwise(self.starts):
            dx, dy = self._integrate(begin, end - begin)
            x, y = x + dx, y + dy
            self.panels.append((x, y))

    def _integrate(self, begin: float, span: float) -> tuple[float, float]:
        h, k, half_rate = self.h, self.k, 0.5 * self.rate
        dx = dy = 0.0
        for node, weight in GAUSS:
            u = begin + node * span
            angle = h + u * (k + u * half_rate)
            dx += weight * math.cos(angle)
            dy += weight * math.sin(angle)
        return dx * span, dy * span

    def at(self, u: float) -> Point:
        """Point at distance `u` (m)."""
        i = bisect_right(self.starts, u) - 1
        if i < 0:
            i = 0
        x, y = self.panels[i]
        begin = self.starts[i]
        dx, dy = self._integrate(begin, u - begin)
        heading = self.h + u * (self.k + 0.5 * u * self.rate)
        return x + dx, y + dy, heading, self.k + u * self.rate

    def constant_curvature(self) -> float | None:
        """None: the curvature changes."""
        return None


def make_spiral(
    x: float, y: float, h: float, length: float, k_start: float, k_end: float
) -> Segment:
    """A clothoid, or the line or arc it degenerates to."""
    if abs(k_end - k_start) * length < 1e-12 or length <= 0.0:
        mean = 0.5 * (k_start + k_end)
        return Arc(x, y, h, length, mean) if mean else Line(x, y, h, length)
    return Spiral(x, y, h, length, k_start, k_end)


class ParamPoly:
    """Cubic u(p), v(p) in the local frame, walked by arc length through a table.

    With `scaled` the table is scaled to the declared length (paramPoly3: reaches the end point
    exactly even if the declared length is rounded); without, it gives plain arc length (poly3).
    """

    __slots__ = ("c", "h", "inverse", "length", "s", "starts", "stretch", "u", "v", "x", "y")

    def __init__(
        self,
        x: float,
        y: float,
        h: float,
        length: float,
        u: tuple[float, float, float, float],
        v: tuple[float, float, float, float],
        p_end: float,
        scaled: bool,
    ) -> None:
        self.x, self.y, self.h, self.length = x, y, h, length
        self.c, self.s = math.cos(h), math.sin(h)
        self.u, self.v = u, v
        count = max(8, min(math.ceil(length), 4096))
        step = p_end / count
        nodes = [step * i for i in range(count + 1)]
        arcs = [0.0]
        for begin in nodes[:-1]:
            span = sum(w * self._speed(begin + n * step) for n, w in GAUSS) * step
            arcs.append(arcs[-1] + max(span, 1e-12))
        scale = length / arcs[-1] if scaled else 1.0
        self.stretch = max(1.0, 1.0 / scale)
        self.starts = [arc * scale for arc in arcs]
        self.inverse = [self._inverse(step, i, nodes, scale) for i in range(count)]

    def _inverse(
        self, step: float, i: int, nodes: list[float], scale: float
    ) -> tuple[float, float, float, float]:
        """P over the distance in an interval of the table.

        Slopes are limited so that p is monotonous.
        """
        span = self.starts[i + 1] - self.starts[i]
        steepest = 3.0 * step / span
        first, last = (
            min(1.0 / (scale * max(self._speed(p), 1e-9)), steepest) for p in nodes[i : i + 2]
        )
        return hermite(span, (nodes[i], nodes[i + 1]), (first, last))

    def _speed(self, p: float) -> float:
        _, bu, cu, du = self.u
        _, bv, cv, dv = self.v
        return math.hypot(bu + p * (2 * cu + 3 * p * du), bv + p * (2 * cv + 3 * p * dv))

    def at(self, u: float) -> Point:
        """Point at distance `u` (m)."""
        i = min(max(bisect_right(self.starts, u) - 1, 0), len(self.inverse) - 1)
        w = u - self.starts[i]
        a, b, c, d = self.inverse[i]
        p = a + w * (b + w * (c + w * d))
        au, bu, cu, du = self.u
        av, bv, cv, dv = self.v
        local_u = au + p * (bu + p * (cu + p * du))
        local_v = av + p * (bv + p * (cv + p * dv))
        u1, u2 = bu + p * (2 * cu + 3 * p * du), 2 * cu + 6 * p * du
        v1, v2 = bv + p * (2 * cv + 3 * p * dv), 2 * cv + 6 * p * dv
        speed = max(math.hypot(u1, v1), 1e-12)
        return (
            self.x + local_u * self.c - local_v * self.s,
            self.y + local_u * self.s + local_v * self.c,
            self.h + math.atan2(v1, u1),
            (u1 * v2 - v1 * u2) / speed**3,
        )

    def constant_curvature(self) -> float | None:
        """None: the curvature changes."""
        return None


def hermite(
    span: float, values: tuple[float, float], slopes: tuple[float, float]
) -> tuple[float, float, float, float]:
    """Cubic through two values with two slopes on [0, span]."""
    mean = (values[1] - values[0]) / span
    c = (3.0 * mean - 2.0 * slopes[0] - slopes[1]) / span
    d = (slopes[0] + slopes[1] - 2.0 * mean) / (span * span)
    return values[0], slopes[0], c, d


class ReferenceLine:
    """The plan view of a road: segments in order of s."""

    __slots__ = ("segments", "starts")

    def __init__(self, starts: Sequence[float], segments: Sequence[Segment]) -> None:
        self.starts = list(starts)
        self.segments = list(segments)

    def at(self, s: float) -> Point:
        """Point at road coordinate `s` (m)."""
        # With equal starts the last one counts, so zero-length pieces are skipped.
        i = bisect_right(self.starts, s) - 1 if len(self.starts) > 1 else 0
        if i < 0:
            i = 0
        return self.segments[i].at(s - self.starts[i])

    def segment_at(self, s: float) -> tuple[float, Segment]:
        """Start (m) and piece at `s`."""
        i = max(bisect_right(self.starts, s) - 1, 0)
        return self.starts[i], self.segments[i]

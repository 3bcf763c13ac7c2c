"""From (x, y) to roads and lanes: a grid of samples for the first guess, then Newton steps."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .lane_advance import lane_heading, wrap
from .model import Lane, LanePosition, Road

__all__ = [
    "Projection",
    "RoadIndex",
    "height",
    "lane_at",
    "place_score",
    "position_of",
    "project",
]

_SAMPLE = 4.0  # m between samples along a road
_ACROSS = 8.0  # m between points of the cross-section of a sample
_CELL = 16.0  # m, edge of a grid cell
_REACH = 4.5  # m: a point registers in every cell within this reach
_HALF_ROAD = 500.0  # m: an absurd width must not fill the memory
_WIDE = 2.0  # m beyond the outermost lanes


@dataclass(frozen=True, slots=True)
class Projection:
    """Foot point on a road: s, t, and how far (m) the point lies beyond the road's ends."""

    road: Road
    s: float
    t: float
    beyond: float


def project(road: Road, x: float, y: float, s: float) -> Projection:
    """Newton iteration for the foot point next to `s`."""
    reference, length = road.reference, road.length
    along = across = 0.0
    for _ in range(12):
        rx, ry, h, k = reference.at(s)
        dx, dy = x - rx, y - ry
        c, n = math.cos(h), math.sin(h)
        along, across = dx * c + dy * n, dy * c - dx * n
        if -1e-10 < along < 1e-10:
            break
        # Beyond the centre of curvature the exact step would run away from the foot point.
        step = along / max(1.0 - k * across, 0.2)
        following = min(max(s + min(max(step, -20.0), 20.0), 0.0), length)
        if following == s:
            break
        s = following
    beyond = abs(along) if s <= 0.0 or s >= length else 0.0
    roll = road.superelevation
    return Projection(road, s, across / math.cos(roll.value(s)) if roll else across, beyond)


def lane_at(
    road: Road, s: float, t: float, types: frozenset[str] | None
) -> tuple[float, Lane] | None:
    """Lane of the given types that contains t or is nearest to it, with the distance (m)."""
    section = road.section_at(s)
    best: tuple[float, float, Lane] | None = None
    middle = road.lane_offset.value(s)
    sides = (section.left, section.right) if t > middle else (section.right, section.left)
    for lanes in sides:
        inner = middle
        for lane in lanes:
            outer = lane.outer.value(s)
            low, high = (outer, inner) if outer < inner else (inner, outer)
            inner = outer
            if (types is not None and lane.type not in types) or high - low < 0.05:
                continue
            if low <= t <= high:
                return 0.0, lane
            gap = low - t if t < low else t - high
            if best is None or gap < best[0]:
                best = (gap, 0.0, lane)
    return None if best is None else (best[0], best[2])


class RoadIndex:
    """Grid over all roads, and the searches that use it."""

    def __init__(self, roads: Mapping[str, Road]) -> None:
        self._roads = list(roads.values())
        self.outline = np.zeros((0, 2))
        self._cells = self._build()

    def _build(self) -> dict[tuple[int, int], list[tuple[Road, float]]]:
        points: list[tuple[float, float]] = []
        owners: list[tuple[int, int]] = []
        positions: list[list[float]] = []
        edges: list[tuple[float, float]] = []
        for number, road in enumerate(self._roads):
            positions.append(_sample(road, number, points, owners, edges))
        self.outline = np.array(edges)
        return _fill(np.array(points), np.array(owners), positions, self._roads)

    def candidates(self, x: float, y: float, reach: float) -> list[tuple[Road, float]]:
        """Roads near a point, each with an s to start from; empty if none within `reach` (m)."""
        cx, cy = math.floor(x / _CELL), math.floor(y / _CELL)
        found = self._cells.get((cx, cy))
        if found is not None:
            return found
        for ring in range(1, math.ceil(reach / _CELL) + 1):
            hits = self._ring(cx, cy, ring)
            if hits:  # a corner of this ring may be farther away than the next ring
                return hits + self._ring(cx, cy, ring + 1)
        return []

    def _ring(self, cx: int, cy: int, ring: int) -> list[tuple[Road, float]]:
        hits: list[tuple[Road, float]] = []
        for i in range(-ring, ring + 1):
            inner = abs(i) < ring
            for j in (-ring, ring) if inner else range(-ring, ring + 1):
                hits.extend(self._cells.get((cx + i, cy + j), ()))
        return hits

    def best(
        self,
        point: tuple[float, float],
        types: frozenset[str] | None,
        reach: float,
        z: float | None = None,
        heading: float | None = None,
    ) -> tuple[Projection, Lane] | None:
        """Lane that fits a point best: containing it, then by height, heading and centre."""
        x, y = point
        best: tuple[Projection, Lane] | None = None
        best_score: tuple[float, float, tuple[int, int, str]] | None = None
        for road, start in self.candidates(x, y, reach):
            foot = project(road, x, y, start)
            hit = lane_at(road, foot.s, foot.t, types)
            if hit is None:
                continue
            distance = math.hypot(hit[0], foot.beyond)
            if distance > reach:
                continue
            score = place_score(foot, hit[1], distance, z, heading)
            if best_score is None or score < best_score:
                best, best_score = (foot, hit[1]), score
        return best


def place_score(
    foot: Projection, lane: Lane, distance: float, z: float | None, heading: float | None
) -> tuple[float, float, tuple[int, int, str]]:
    """Order of places that fit a point: distance, height and heading, then nearness to the centre.

    Half a metre of height is free (slopes, vehicle origins); a lane the other way costs 4 m.
    """
    cost = distance
    if z is not None:
        cost += max(abs(z - height(foot.road, foot.s, foot.t)) - 0.5, 0.0)
    if heading is not None:
        cost += 2.0 * (1.0 - math.cos(wrap(heading - lane_heading(lane, foot.s))))
    aside = abs(foot.t - lane.centre.value(foot.s))
    return round(cost, 3), round(aside, 6), foot.road.order


def height(road: Road, s: float, t: float) -> float:
    """Height (m) of the road surface."""
    z = road.elevation.value(s) if road.elevation is not None else 0.0
    if road.superelevation is not None:
        z += t * math.sin(road.superelevation.value(s))
    return z


def position_of(foot: Projection, lane: Lane) -> LanePosition:
    """A foot point as a lane position."""
    offset = (foot.t - lane.centre.value(foot.s)) * lane.direction
    return LanePosition(foot.road.id, lane.id, foot.s, offset)


def _sample(
    road: Road,
    number: int,
    points: list[tuple[float, float]],
    owners: list[tuple[int, int]],
    edges: list[tuple[float, float]],
) -> list[float]:
    """Adds cross-section points of a road, returns the s of its samples."""
    count = max(1, math.ceil(road.length / _SAMPLE))
    positions = [road.length * i / count for i in range(count + 1)]
    for i, s in enumerate(positions):
        section = road.section_at(s)
        low = high = road.lane_offset.value(s)
        if section.left:
            high = max(high, section.left[-1].outer.value(s))
        if section.right:
            low = min(low, section.right[-1].outer.value(s))
        low, high = max(low, -_HALF_ROAD), min(high, _HALF_ROAD)
        x, y, h, _ = road.reference.at(s)
        c, n = math.cos(h), math.sin(h)
        edges.append((x - low * n, y + low * c))
        edges.append((x - high * n, y + high * c))
        low, high = low - _WIDE, high + _WIDE
        steps = max(1, math.ceil((high - low) / _ACROSS))
        for j in range(steps + 1):
            t = low + (high - low) * j / steps
            points.append((x - t * n, y + t * c))
            owners.append((number, i))
    return positions


def _fill(
    points: np.ndarray[tuple[int, int], np.dtype[np.float64]],
    owners: np.ndarray[tuple[int, int], np.dtype[np.int64]],
    positions: list[list[float]],
    roads: list[Road],
) -> dict[tuple[int, int], list[tuple[Road, float]]]:
    """Grid cells; in a cell each run of consecutive samples of a road is one entry."""
    corners = [(dx, dy) for dx in (-_REACH, _REACH) for dy in (-_REACH, _REACH)]
    cells = np.concatenate([np.floor((points + corner) / _CELL) for corner in corners])
    rows = np.concatenate([cells.astype(np.int64), np.tile(owners, (len(corners), 1))], axis=1)
    rows = rows[np.lexsort((rows[:, 3], rows[:, 2], rows[:, 1], rows[:, 0]))]
    same = np.all(rows[1:, :3] == rows[:-1, :3], axis=1)
    breaks = ~(same & (rows[1:, 3] - rows[:-1, 3] <= 1))
    firsts = np.concatenate([[0], np.flatnonzero(breaks) + 1])
    lasts = np.concatenate([firsts[1:] - 1, [len(rows) - 1]])
    table: dict[tuple[int, int], list[tuple[Road, float]]] = {}
    for first, last in zip(rows[firsts].tolist(), rows[lasts].tolist(), strict=True):
        along = positions[first[2]]
        middle = 0.5 * (along[first[3]] + along[last[3]])
        table.setdefault((first[0], first[1]), []).append((roads[first[2]], middle))
    return table

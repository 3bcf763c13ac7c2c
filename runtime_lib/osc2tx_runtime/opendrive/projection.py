"""From (x, y) to roads and lanes: candidates of the road index, then Newton steps."""

from __future__ import annotations

import math

from osc2tx_shared.classes import dataclass

from .geometry import wrap
from .lane_advance import lane_heading
from .model import Lane, LanePosition, Road
from .road_index import RoadIndex


@dataclass(frozen=True, slots=True)
class Projection:
    """Foot point on a road: s, t, and the distance (m) of the point beyond the ends of the road."""

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
        # Beyond the centre of curvature the exact step would diverge from the foot point.
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


def best_place(
    index: RoadIndex,
    point: tuple[float, float],
    types: frozenset[str] | None,
    reach: float,
    z: float | None = None,
    heading: float | None = None,
) -> tuple[Projection, Lane] | None:
    """Best lane for a point: containing it, then by height, heading and centre."""
    x, y = point
    best: tuple[Projection, Lane] | None = None
    best_score: tuple[float, float, tuple[int, int, str]] | None = None
    for road, start in index.candidates(x, y, reach):
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
    """Sort key of positions for a point: distance, height and heading, then distance to the centre.

    Half a metre of height is free (slopes, vehicle origins); a lane in the opposite direction costs
    4 m.
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
    if road.cross_section is not None:
        z += road.cross_section.at(s, t)[0]
    return z


def position_of(foot: Projection, lane: Lane) -> LanePosition:
    """A foot point as a lane position."""
    offset = (foot.t - lane.centre.value(foot.s)) * lane.direction
    return LanePosition(foot.road.id, lane.id, foot.s, offset)

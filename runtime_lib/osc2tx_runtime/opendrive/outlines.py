"""Lane outlines for drawing, and default start positions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from .model import DRIVING, Lane, LaneOutline, LanePosition, LaneSection, Road

_Bounds = tuple[float, float, float, float]
_Edge = list[tuple[float, float]]

_SPAWN_FIRST = 10.0  # m from the start of the lane in direction of travel
_SPAWN_STEP = 20.0  # m
_SPAWN_WIDTH = 2.0  # m: a car does not start on a narrower lane


def lane_outlines(
    roads: Iterable[Road], bounds: _Bounds | None, step: float
) -> Iterator[LaneOutline]:
    """Outlines of all lanes with some width, in numeric order of roads.

    Args:
        roads: The roads.
        bounds: Box (xmin, ymin, xmax, ymax); lanes outside are omitted.
        step: Largest distance between points along a road (m).
    """
    for road in roads:
        for section in road.sections:
            if section.end <= section.begin:
                continue
            if not section.ready:
                section.prepare()
            positions = _positions(section, step)
            for lane in (*reversed(section.left), *section.right):
                outline = _outline(lane, positions)
                if outline is not None and (bounds is None or _touches(outline, bounds)):
                    yield outline


def _positions(section: LaneSection, step: float) -> list[float]:
    count = max(1, math.ceil((section.end - section.begin) / step))
    span = (section.end - section.begin) / count
    return [section.begin + i * span for i in range(count)] + [section.end]


def _outline(lane: Lane, positions: list[float]) -> LaneOutline | None:
    road = lane.road
    left: _Edge = []
    right: _Edge = []
    widest = 0.0
    for s in positions:
        x, y, h, _ = road.reference.at(s)
        c, n = math.cos(h), math.sin(h)
        low, high = lane.edges(s)
        widest = max(widest, high - low)
        if road.superelevation is not None:
            flat = math.cos(road.superelevation.value(s))
            low, high = low * flat, high * flat
        left.append((x - high * n, y + high * c))
        right.append((x - low * n, y + low * c))
    if widest < 1e-3:
        return None
    return LaneOutline(road.id, lane.id, lane.type, left, right, road.junction)


def _touches(outline: LaneOutline, bounds: _Bounds) -> bool:
    xs = [x for x, _ in (*outline.left, *outline.right)]
    ys = [y for _, y in (*outline.left, *outline.right)]
    return (
        max(xs) >= bounds[0]
        and max(ys) >= bounds[1]
        and min(xs) <= bounds[2]
        and min(ys) <= bounds[3]
    )


def spawn_points(roads: Iterable[Road]) -> tuple[LanePosition, ...]:
    """Start positions, by numeric road id, section, and lane from the outer side inwards."""
    points: list[LanePosition] = []
    for road in roads:
        if road.junction is not None:
            continue
        for section in road.sections:
            if not section.ready:
                section.prepare()
            for lane in (*reversed(section.right), *reversed(section.left)):
                if lane.type in DRIVING:
                    points.extend(_along(lane))
    return tuple(points)


def _along(lane: Lane) -> Iterator[LanePosition]:
    section = lane.section
    count = math.ceil((section.end - section.begin - _SPAWN_FIRST) / _SPAWN_STEP)
    for i in range(max(count, 0)):
        distance = _SPAWN_FIRST + i * _SPAWN_STEP
        s = section.begin + distance if lane.direction > 0 else section.end - distance
        if lane.width_at(s) >= _SPAWN_WIDTH:
            yield LanePosition(lane.road.id, lane.id, s)

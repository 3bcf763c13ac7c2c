"""The lanes and crosswalks near the actors' paths, clipped and thinned for drawing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

from .json_values import Json, short

if TYPE_CHECKING:
    from osc2tx_runtime.opendrive import LaneOutline, RoadMap

MARGIN = 100.0
"""Distance (m) from a path within which lanes are drawn."""

_CELL = 25.0  # m: size of the grid cells that index nearby paths
_TOLERANCE = 0.04  # m: greatest error of a thinned edge
_STEP = 2.0  # m: distance of the sampled points of the map
_INVISIBLE = frozenset({"none"})

Point = tuple[float, float]
Bounds = tuple[float, float, float, float]
"""Smallest x, smallest y, largest x, largest y (m)."""


def nearby_lanes(road_map: RoadMap, paths: Sequence[Sequence[Point]]) -> list[Json]:
    """Lanes within about `MARGIN` of the paths; an empty list without paths."""
    points = [point for path in paths for point in path]
    if not points:
        return []
    near = _near_test(points)
    shapes = [
        shape
        for shape in road_map.lane_outlines(_bounds(points), _STEP)
        if shape.type not in _INVISIBLE and min(len(shape.left), len(shape.right)) > 1
    ]
    outer_types = {_edge_key(shape, outer=True): shape.type for shape in shapes}
    inner_types = {_edge_key(shape, outer=False): shape.type for shape in shapes}
    result: list[Json] = []
    for shape in shapes:
        # The edges of neighbours coincide: my inner edge is the outer edge of the lane inside.
        inner = outer_types.get(_neighbour_key(shape, outer=False))
        outer = inner_types.get(_neighbour_key(shape, outer=True))
        direction = road_map.travel_direction(shape.road, shape.lane)
        for left, right in _clip(shape, near):
            piece = {"type": shape.type, "lane": shape.lane, "dir": direction}
            piece |= {"junction": shape.junction is not None, "inner": inner, "outer": outer}
            result.append({**piece, "left": _pack(left), "right": _pack(right)})
    return result


def nearby_crosswalks(
    road_map: RoadMap, paths: Sequence[Sequence[Point]]
) -> list[list[float | int]]:
    """Crosswalks within about `MARGIN` of the paths: x, y, heading, length and width of each."""
    near = _near_test([point for path in paths for point in path])
    return [
        [short(value, 3) for value in (walk.x, walk.y, walk.heading, walk.length, walk.width)]
        for walk in road_map.crosswalks()
        if walk.width > 0.0 and near((walk.x, walk.y))
    ]


def _bounds(points: Sequence[Point]) -> Bounds:
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return min(xs) - MARGIN, min(ys) - MARGIN, max(xs) + MARGIN, max(ys) + MARGIN


def _near_test(points: Sequence[Point]) -> Callable[[Point], bool]:
    """A test whether a point is in a grid cell within `MARGIN` of the points."""
    reach = math.ceil(MARGIN / _CELL)
    disc = [
        (i, j)
        for i in range(-reach, reach + 1)
        for j in range(-reach, reach + 1)
        if math.hypot(i, j) <= reach
    ]
    visited = {cell(point) for point in points}
    cells = {(column + i, row + j) for column, row in visited for i, j in disc}
    return lambda point: cell(point) in cells


def cell(point: Point) -> tuple[int, int]:
    """The grid cell of a point."""
    return math.floor(point[0] / _CELL), math.floor(point[1] / _CELL)


_EdgeKey = tuple[str, int, float, float]


def _edge_key(shape: LaneOutline, *, outer: bool) -> _EdgeKey:
    """Key of one edge of a lane: road, lane and its first point (to a decimetre)."""
    edge = shape.left if (shape.lane > 0) == outer else shape.right
    return shape.road, shape.lane, round(edge[0][0], 1), round(edge[0][1], 1)


def _neighbour_key(shape: LaneOutline, *, outer: bool) -> _EdgeKey:
    """The key of the neighbour on that side for the shared edge."""
    road, lane, x, y = _edge_key(shape, outer=outer)
    away = 1 if lane > 0 else -1
    return road, lane + away if outer else lane - away, x, y


def _clip(
    shape: LaneOutline, near: Callable[[Point], bool]
) -> Iterable[tuple[list[Point], list[Point]]]:
    """The runs of a lane's stations that are near, thinned."""
    if len(shape.left) != len(shape.right):
        yield list(shape.left), list(shape.right)
        return
    pairs = list(zip(shape.left, shape.right, strict=True))
    run: list[tuple[Point, Point]] = []
    for pair in [*pairs, None]:
        if pair is not None and (near(pair[0]) or near(pair[1])):
            run.append(pair)
            continue
        if len(run) > 1:
            kept = _thin(run)
            yield [run[i][0] for i in kept], [run[i][1] for i in kept]
        run = []


def _thin(run: Sequence[tuple[Point, Point]]) -> list[int]:
    """Stations needed so that both edges stay within the tolerance (Douglas-Peucker)."""
    kept = [0, len(run) - 1]
    open_spans = [(0, len(run) - 1)]
    while open_spans:
        first, last = open_spans.pop()
        worst, where = _TOLERANCE, -1
        for i in range(first + 1, last):
            off = max(_distance(run[i][k], run[first][k], run[last][k]) for k in (0, 1))
            if off > worst:
                worst, where = off, i
        if where >= 0:
            kept.append(where)
            open_spans += [(first, where), (where, last)]
    return sorted(kept)


def _distance(point: Point, begin: Point, end: Point) -> float:
    """Distance of a point from a chord (m)."""
    dx, dy = end[0] - begin[0], end[1] - begin[1]
    px, py = point[0] - begin[0], point[1] - begin[1]
    square = dx * dx + dy * dy
    along = min(max((px * dx + py * dy) / square, 0.0), 1.0) if square else 0.0
    return math.hypot(px - along * dx, py - along * dy)


def _pack(points: Sequence[Point]) -> list[int]:
    """Centimetres; each point relative to the one before, which keeps the numbers short."""
    packed: list[int] = []
    x = y = 0
    for point in points:
        px, py = round(point[0] * 100), round(point[1] * 100)
        packed += [px - x, py - y]
        x, y = px, py
    return packed

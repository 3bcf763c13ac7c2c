"""Index of roads by position: tiles touched by roads, with a grid of samples in each.

A tile is sampled on the first query in it, so the cost of a large map is that of its used part.
Tiles are chosen by discs around stretches of road of any shape: no point of a stretch is farther
from its middle than half its length, and half the road's width.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from osc2tx_shared.classes import dataclass

from .model import LaneSection, Road

_SAMPLE = 4.0  # m between samples along a road
_ACROSS = 8.0  # m between points of the cross-section of a sample
_CELL = 16.0  # m, edge of a grid cell
_TILE = 16  # cells along the edge of a tile
_REACH = 4.5  # m: a point is registered in each cell within this distance
_HALF_ROAD = 500.0  # m: limits the memory for invalid widths
_WIDE = 2.0  # m beyond the outermost lanes
_MOST = 64  # samples of a stretch
_LARGEST = 1e9  # m: upper limit of all attributes of a map
_WIDEST = 64  # tiles along the edge of the box of a stretch; a wider one is in all tiles

_Cell = tuple[int, int]
_Near = list[tuple[Road, float]]
_Box = tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True, slots=True)
class _Stretch:
    """Samples of a road within one piece of its reference line, and a disc around them."""

    number: int
    first: int
    last: int
    x: float
    y: float
    radius: float


class RoadIndex:
    """Tiles and cells over all roads.

    Args:
        roads: The roads, in their numeric order.
    """

    __slots__ = ("_cells", "_everywhere", "_extent", "_roads", "_stretches", "_tiles")

    def __init__(self, roads: Iterable[Road]) -> None:
        self._roads = tuple(roads)
        self._stretches = [
            stretch
            for number, road in enumerate(self._roads)
            for stretch in _stretches(number, road)
        ]
        self._tiles: dict[_Cell, list[_Stretch]] = {}
        self._everywhere: list[_Stretch] = []
        for stretch in self._stretches:
            if stretch.radius > 0.5 * _WIDEST * _TILE * _CELL:
                self._everywhere.append(stretch)
                continue
            for tile in _touched(stretch):
                self._tiles.setdefault(tile, []).append(stretch)
        self._cells: dict[_Cell, dict[_Cell, _Near]] = {}
        self._extent = _extent(self._stretches)

    def candidates(self, x: float, y: float, reach: float) -> _Near:
        """Roads near a point, each with an s to start from; empty if none within `reach` (m)."""
        if not (math.isfinite(x) and math.isfinite(y)):
            return []
        cx, cy = math.floor(x / _CELL), math.floor(y / _CELL)
        found = self._cell(cx, cy)
        if found:
            return found
        # Far from all roads, empty rings and parts of rings are skipped.
        (left, bottom), (right, top) = self._extent
        first = max(1, left - cx, cx - right, bottom - cy, cy - top)
        last = max(abs(left - cx), abs(right - cx), abs(bottom - cy), abs(top - cy))
        for ring in range(first, math.ceil(min(last, reach / _CELL)) + 1):
            hits = self._ring(cx, cy, ring)
            if hits:  # a corner of this ring may be farther away than the next ring
                return hits + self._ring(cx, cy, ring + 1)
        return []

    def bounds(self) -> tuple[float, float, float, float]:
        """Box around the edges of all roads: xmin, ymin, xmax, ymax (m)."""
        boxes: dict[int, _Box] = {}
        return (
            -self._farthest(-1, 0, boxes),
            -self._farthest(0, -1, boxes),
            self._farthest(1, 0, boxes),
            self._farthest(0, 1, boxes),
        )

    def _farthest(self, dx: int, dy: int, boxes: dict[int, _Box]) -> float:
        """Extent (m) of edges in a direction; stretches that cannot exceed it are not sampled."""

        def most(stretch: _Stretch) -> float:
            return stretch.x * dx + stretch.y * dy + stretch.radius

        best = -math.inf
        for stretch in sorted(self._stretches, key=most, reverse=True):
            if most(stretch) < best:
                break
            box = boxes.get(id(stretch))
            if box is None:
                box = boxes[id(stretch)] = self._box(stretch)
            xs, ys = box
            best = max(best, *(x * dx + y * dy for x in xs for y in ys))
        return best

    def _box(self, stretch: _Stretch) -> _Box:
        """Least and greatest x and y (m) of the edges of a stretch."""
        road = self._roads[stretch.number]
        places = (_place(road, i) for i in range(stretch.first, stretch.last + 1))
        points = [point for s in places for point in _across(road, s, 0.0, math.inf)]
        xs, ys = zip(*points, strict=True)
        return (min(xs), max(xs)), (min(ys), max(ys))

    def _ring(self, cx: int, cy: int, ring: int) -> _Near:
        (left, bottom), (right, top) = self._extent
        low, high = max(-ring, bottom - cy), min(ring, top - cy)
        hits: _Near = []
        for i in range(max(-ring, left - cx), min(ring, right - cx) + 1):
            inner = abs(i) < ring
            for j in (-ring, ring) if inner else range(low, high + 1):
                if low <= j <= high:
                    hits.extend(self._cell(cx + i, cy + j))
        return hits

    def _cell(self, cx: int, cy: int) -> _Near:
        tile = (cx // _TILE, cy // _TILE)
        cells = self._cells.get(tile)
        if cells is None:
            stretches = [*self._tiles.get(tile, ()), *self._everywhere]
            if not stretches:
                return []
            cells = self._cells[tile] = self._sampled(tile, stretches)
        return cells.get((cx, cy), [])

    def _sampled(self, tile: _Cell, stretches: Iterable[_Stretch]) -> dict[_Cell, _Near]:
        """Cells of a tile; in a cell each run of consecutive samples of a road is one entry."""
        samples = dict.fromkeys(
            (stretch.number, i)
            for stretch in stretches
            for i in range(stretch.first, stretch.last + 1)
        )
        points: list[tuple[float, float]] = []
        owners: list[tuple[int, int]] = []
        for number, i in samples:
            road = self._roads[number]
            for point in _across(road, _place(road, i), _WIDE, _ACROSS):
                points.append(point)
                owners.append((number, i))
        table: dict[_Cell, _Near] = {}
        for cx, cy, number, first, last in _runs(tile, points, owners):
            road = self._roads[number]
            middle = 0.5 * (_place(road, first) + _place(road, last))
            table.setdefault((cx, cy), []).append((road, middle))
        return table


def _extent(stretches: Iterable[_Stretch]) -> tuple[_Cell, _Cell]:
    """The cells at two corners of a box around all cells with samples."""
    low, high = [0.0, 0.0], [0.0, 0.0]
    for nth, stretch in enumerate(stretches):
        reach = stretch.radius + 2.0 * _REACH
        for axis, middle in enumerate((stretch.x, stretch.y)):
            low[axis] = min(low[axis], middle - reach) if nth else middle - reach
            high[axis] = max(high[axis], middle + reach) if nth else middle + reach
    if not all(map(math.isfinite, (*low, *high))):  # the geometry of the map is invalid
        low, high = [-_LARGEST] * 2, [_LARGEST] * 2
    return (
        (math.floor(low[0] / _CELL), math.floor(low[1] / _CELL)),
        (math.floor(high[0] / _CELL), math.floor(high[1] / _CELL)),
    )


def _samples(road: Road) -> int:
    """Samples of a road after that at its start."""
    return max(1, math.ceil(road.length / _SAMPLE))


def _place(road: Road, i: int) -> float:
    """The s of a sample."""
    return road.length * i / _samples(road)


def _stretches(number: int, road: Road) -> Iterator[_Stretch]:
    """Stretches with all samples of a road; those at joints are in both."""
    count = _samples(road)
    step = road.length / count
    width = min(max(map(_half_width, road.sections)), _HALF_ROAD) + _offset(road) + _WIDE
    reference = road.reference
    for k, segment in enumerate(reference.segments):
        own = reference.starts[k]
        begin = max(own, 0.0) if k > 0 else 0.0
        end = reference.starts[k + 1] if k + 1 < len(reference.starts) else road.length
        if end < 0.0 or begin > road.length:
            continue  # the road has no position there
        first = math.floor(begin / step) if step > 0.0 else 0
        last = min(math.ceil(end / step), count) if step > 0.0 else count
        for low in range(first, max(last, first + 1), _MOST):
            high = min(low + _MOST, last)
            a, b = max(low * step, begin), min(high * step, end)
            x, y, _, _ = segment.at(0.5 * (a + b) - own)
            # One more step, as the speed along a polynomial is only nearly constant.
            radius = 0.5 * abs(b - a) * segment.stretch + step + width
            yield _Stretch(number, low, high, x, y, radius)


def _offset(road: Road) -> float:
    low, high = road.lane_offset.extremes(0.0, road.length)
    return min(max(abs(low), abs(high)), _HALF_ROAD)


def _half_width(section: LaneSection) -> float:
    """Upper bound of the distance (m) of the outermost edge from lane 0."""
    total = 0.0
    for lane in section.lanes.values():
        edge = lane.width if lane.width is not None else lane.border
        if edge is not None:
            low, high = edge.extremes(section.begin, section.end)
            total += max(abs(low), abs(high))
    return total


def _touched(stretch: _Stretch) -> Iterator[_Cell]:
    edge = _CELL * _TILE
    reach = stretch.radius + _REACH
    for i in range(_floor(stretch.x - reach, edge), _floor(stretch.x + reach, edge) + 1):
        for j in range(_floor(stretch.y - reach, edge), _floor(stretch.y + reach, edge) + 1):
            yield i, j


def _floor(value: float, edge: float) -> int:
    return math.floor(value / edge)


def _across(road: Road, s: float, beside: float, step: float) -> Iterator[tuple[float, float]]:
    """Points of a cross-section, from `beside` metres outside its right edge to the left one."""
    section = road.section_at(s)
    low = high = road.lane_offset.value(s)
    if section.left:
        high = max(high, section.left[-1].outer.value(s))
    if section.right:
        low = min(low, section.right[-1].outer.value(s))
    low, high = max(low, -_HALF_ROAD) - beside, min(high, _HALF_ROAD) + beside
    x, y, h, _ = road.reference.at(s)
    c, n = math.cos(h), math.sin(h)
    count = max(1, math.ceil((high - low) / step))
    for j in range(count + 1):
        t = low + (high - low) * j / count
        yield x - t * n, y + t * c


def _runs(
    tile: _Cell, points: list[tuple[float, float]], owners: list[tuple[int, int]]
) -> Iterator[tuple[int, int, int, int, int]]:
    """Cell, road, first and last sample of each run of samples in a cell of the tile."""
    found: dict[tuple[int, int, int], set[int]] = {}
    for (x, y), (number, i) in zip(points, owners, strict=True):
        columns = _cells_of(x, tile[0])
        for cy in _cells_of(y, tile[1]) if columns else ():
            for cx in columns:
                found.setdefault((cx, cy, number), set()).add(i)
    for (cx, cy, number), samples in sorted(found.items()):
        first = last = min(samples)
        for i in sorted(samples):
            if i > last + 1:
                yield cx, cy, number, first, last
                first = i
            last = i
        yield cx, cy, number, first, last


def _cells_of(value: float, tile: int) -> set[int]:
    """The cells of a tile, along one axis, in which a point is registered."""
    if not math.isfinite(value):
        return set()  # the geometry of the map is invalid
    low, high = math.floor((value - _REACH) / _CELL), math.floor((value + _REACH) / _CELL)
    return {cell for cell in (low, high) if cell // _TILE == tile}

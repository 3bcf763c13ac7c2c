"""Shapes of trajectories as polylines: a curve is sampled so that no chord is far from it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import Pose
from osc2tx.xosc.player.courses import number
from osc2tx.xosc.player.errors import Unplayable
from osc2tx_runtime.opendrive.geometry import make_spiral

CHORD = 0.01  # m: a chord is nowhere farther from its curve
END = 1e-3
"""m: length of the first and last chord of a clothoid, which have the directions of its ends."""
NEAR_END = 1e-6
"""The same for a NURBS, as a part of the range of its parameter."""
SPAN_PIECES = 8  # of a span between knots at least
MOST_HALVINGS = 10

Way = list[tuple[float, Pose]]
"""Corners of a polyline, with times (s) where the shape has some."""
PoseOf = Callable[[Element], Pose]
"""The pose of a `Position`."""


def way_of(shape: Element, pose_of: PoseOf, here: Pose | None = None) -> Way:
    """Return the corners of the shape of a trajectory.

    Args:
        shape: The shape.
        pose_of: Gives the poses of positions.
        here: Where a curve begins that has no first position; `None`: nowhere.

    Raises:
        Unplayable: It is no polyline, clothoid or NURBS.
    """
    inner = shape.inner
    match inner.tag:
        case "Polyline":
            found = [
                (number(each, "time"), pose_of(each.one(xml.Position)))
                for each in inner.all(xml.Vertex)
            ]
        case "Clothoid":
            found = _clothoid(inner, pose_of)
        case "ClothoidSpline":
            found = _clothoids(inner, pose_of, here)
        case "Nurbs":
            found = _nurbs(inner, pose_of)
        case _:
            raise Unplayable(f"<{inner.tag}> is not played", inner.place)
    if len(found) < 2:
        raise Unplayable("a trajectory of a single point is not played", inner.place)
    return found


def lengths_of(way: Sequence[tuple[float, Pose]]) -> list[float]:
    """Return the distances (m) from the start of a path to its corners."""
    found = [0.0]
    for (_, a), (_, b) in pairwise(way):
        found.append(found[-1] + math.dist(a[:2], b[:2]))
    return found


def on_way(way: Sequence[tuple[float, Pose]], points: Sequence[float], driven: float) -> Pose:
    """Return the pose at a distance along a path with known distances of its corners.

    Its heading is along the path; beyond its ends the first and the last segment continue.
    """
    last = len(way) - 2
    index = next((i for i in range(last) if driven < points[i + 1]), last)
    (_, a), (_, b) = way[index], way[index + 1]
    length = points[index + 1] - points[index]
    part = (driven - points[index]) / length if length else 1.0
    h = math.atan2(b.y - a.y, b.x - a.x) if length else a.h
    return Pose(a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), h)


def nearest_on(
    way: Sequence[tuple[float, Pose]], points: Sequence[float], x: float, y: float
) -> float:
    """Return the distance along a path at its point nearest to another one."""

    def candidates() -> Iterator[tuple[float, float]]:
        for index, ((_, a), (_, b)) in enumerate(pairwise(way)):
            dx, dy = b.x - a.x, b.y - a.y
            square = dx * dx + dy * dy
            part = ((x - a.x) * dx + (y - a.y) * dy) / square if square else 0.0
            part = min(max(part, 0.0), 1.0)
            off = math.hypot(a.x + part * dx - x, a.y + part * dy - y)
            yield off, points[index] + part * math.sqrt(square)

    return min(candidates())[1]


# --- clothoids ------------------------------------------------------------------------------------


def _clothoid(node: Element, pose_of: PoseOf) -> Way:
    rate = number(node, "curvatureDot" if node.get("curvaturePrime") is None else "curvaturePrime")
    length, begin = number(node, "length"), number(node, "curvature")
    start = pose_of(node.one(xml.Position))
    times = number(node, "startTime"), number(node, "stopTime")
    return list(_curve(start, length, begin, begin + rate * length, times))


def _clothoids(node: Element, pose_of: PoseOf, here: Pose | None) -> Way:
    segments = list(node.all(xml.ClothoidSplineSegment))
    stamps = [number(each, "timeStart") for each in segments] + [number(node, "timeEnd")]
    found: Way = []
    for segment, times in zip(segments, pairwise(stamps), strict=True):
        given = segment.find(xml.PositionStart)
        before = found[-1][1] if found else here
        if given is None and before is None:
            raise Unplayable("its first segment begins nowhere", segment.place)
        start = pose_of(given) if given is not None else before
        assert start is not None
        start = start._replace(h=start.h + number(segment, "hOffset"))
        curvatures = number(segment, "curvatureStart"), number(segment, "curvatureEnd")
        piece = list(_curve(start, number(segment, "length"), *curvatures, times))
        found += piece if not found or given is not None else piece[1:]
    return found


def _curve(
    start: Pose, length: float, begin: float, end: float, times: tuple[float, float]
) -> Iterator[tuple[float, Pose]]:
    """Yield points of a clothoid; time runs evenly along it."""
    if length <= 0.0:
        yield times[0], start
        return
    curve = make_spiral(*start, length, begin, end)
    steep = max(abs(begin), abs(end))
    count = max(1, math.ceil(length / math.sqrt(8.0 * CHORD / steep))) if steep else 1
    parts = [index / count for index in range(count + 1)]
    if length > 2.0 * END:
        parts[1:-1] = [END / length, *parts[1:-1], 1.0 - END / length]
    for part in parts:
        x, y, h, _ = curve.at(part * length)
        yield times[0] + part * (times[1] - times[0]), Pose(x, y, h)


# --- NURBS ----------------------------------------------------------------------------------------


def _nurbs(node: Element, pose_of: PoseOf) -> Way:
    """Return points of a NURBS; times are weighed as places are."""
    degree = int(number(node, "order")) - 1
    poles = [
        (number(each, "weight", 1.0), pose_of(each.one(xml.Position)), number(each, "time"))
        for each in node.all(xml.ControlPoint)
    ]
    knots = [number(each, "value") for each in node.all(xml.Knot)]
    if len(knots) != len(poles) + degree + 1:
        raise Unplayable("the number of its knots does not fit its control points", node.place)

    def at(u: float) -> tuple[float, float, float]:
        basis = _basis(knots, degree, u)
        whole = sum(b * weight for b, (weight, *_) in zip(basis, poles, strict=True))
        x = y = t = 0.0
        for b, (weight, pose, time) in zip(basis, poles, strict=True):
            part = b * weight / whole
            x, y, t = x + part * pose.x, y + part * pose.y, t + part * time
        return x, y, t

    def halved(u: float, v: float, left: int) -> Iterator[tuple[float, float, float]]:
        """Yield the points behind the first one up to the last one."""
        a, b, middle = at(u), at(v), at(0.5 * (u + v))
        off = math.dist(middle[:2], (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])))
        if off <= CHORD or not left:
            yield b
            return
        yield from halved(u, 0.5 * (u + v), left - 1)
        yield from halved(0.5 * (u + v), v, left - 1)

    low, high = knots[degree], knots[-degree - 1]
    spans = [(u, v) for u, v in pairwise(sorted({*knots})) if low <= u and v <= high]
    found = [at(low)]
    for u, v in spans:
        for index in range(SPAN_PIECES):
            step = (v - u) / SPAN_PIECES
            found += halved(u + index * step, u + (index + 1) * step, MOST_HALVINGS)
    step = NEAR_END * (high - low)
    for index, corner in ((1, at(low + step)), (-1, at(high - step))):
        if corner[:2] not in (found[0][:2], found[-1][:2]):  # poles may coincide
            found.insert(index, corner)
    headings = [math.atan2(b[1] - a[1], b[0] - a[0]) for a, b in pairwise(found)]
    return [
        (t, Pose(x, y, h)) for (x, y, t), h in zip(found, [*headings, headings[-1]], strict=True)
    ]


def _basis(knots: Sequence[float], degree: int, u: float) -> list[float]:
    """Return the values of the B-splines at a parameter (Cox and de Boor)."""
    last = max(i for i, (a, b) in enumerate(pairwise(knots)) if a < b)
    span = max((i for i, (a, b) in enumerate(pairwise(knots)) if a <= u < b), default=last)
    found = [float(i == span) for i in range(len(knots) - 1)]
    for k in range(1, degree + 1):
        for i in range(len(knots) - 1 - k):
            left = knots[i + k] - knots[i]
            right = knots[i + k + 1] - knots[i + 1]
            value = found[i] * (u - knots[i]) / left if left else 0.0
            if right:
                value += found[i + 1] * (knots[i + k + 1] - u) / right
            found[i] = value
    return found[: len(knots) - degree - 1]

"""Distances between entities, in the coordinate systems of the standard.

Without signs, as conditions compare them; only the clearance condition distinguishes ahead from
behind.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import Body, Pose
from osc2tx.xosc.player.courses import number
from osc2tx.xosc.player.places import centre
from osc2tx_runtime.opendrive import LanePosition, RoadMap


class Extent(NamedTuple):
    """An interval along an axis (m)."""

    low: float
    high: float

    def apart(self, other: Extent) -> float:
        """Return the space between both; 0 if they overlap."""
        return max(other.low - self.high, self.low - other.high, 0.0)


def extent(body: Body, x: float, y: float) -> Extent:
    """Return from where to where it reaches along a direction, from its reference point."""
    c, s = math.cos(body.here.h), math.sin(body.here.h)
    along, across = c * x + s * y, c * y - s * x
    ends = (body.front * along, -body.rear * along)
    side = 0.5 * body.width * abs(across)
    return Extent(min(ends) - side, max(ends) + side)


def corners(body: Body) -> list[tuple[float, float]]:
    """Return the corners of its box, in order."""
    (x, y, h), half = body.here, 0.5 * body.width
    c, s = math.cos(h), math.sin(h)
    return [
        (x + a * c - b * s, y + a * s + b * c)
        for a, b in (
            (body.front, half),
            (-body.rear, half),
            (-body.rear, -half),
            (body.front, -half),
        )
    ]


def between_boxes(a: Body, b: Body) -> float:
    """Return the least distance of two boxes."""
    first, second = corners(a), corners(b)
    if any(_holds(second, point) for point in first) or any(_holds(first, p) for p in second):
        return 0.0
    return min(
        min(_to_edge(point, box[i - 1], box[i]) for point in points for i in range(4))
        for points, box in ((first, second), (second, first))
    )


def _holds(box: list[tuple[float, float]], point: tuple[float, float]) -> bool:
    turns = [
        (box[i][0] - box[i - 1][0]) * (point[1] - box[i - 1][1])
        - (box[i][1] - box[i - 1][1]) * (point[0] - box[i - 1][0])
        for i in range(4)
    ]
    return all(turn >= 0.0 for turn in turns) or all(turn <= 0.0 for turn in turns)


def _to_edge(point: tuple[float, float], a: tuple[float, float], b: tuple[float, float]) -> float:
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    part = ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / square if square else 0.0
    part = min(max(part, 0.0), 1.0)
    return math.dist(point, (a[0] + part * dx, a[1] + part * dy))


class Ruler:
    """Measures on a map."""

    def __init__(self, road_map: RoadMap) -> None:
        self.map = road_map

    # --- as a condition asks ------------------------------------------------------------------

    def relative(self, a: Body, b: Body, node: Element) -> float:
        """Return the distance of two entities that a condition compares; infinite without any."""
        kind, system = asked(node)
        freespace = node.get("freespace") == "true"
        if kind == "euclidian":
            return between_boxes(a, b) if freespace else math.dist(a.here[:2], b.here[:2])
        found = self.signed(a, b, kind, system)
        if found is None:
            return math.inf
        if not freespace:
            return abs(found)
        own, other = self.extents(a, b, kind, system)
        return own.apart(Extent(found + other.low, found + other.high))

    def extents(self, a: Body, b: Body, kind: str, system: str) -> tuple[Extent, Extent]:
        """Return from where to where each of two entities reaches, from its reference point."""
        return (
            extent(a, *self._axis(a, b, kind, system)),
            extent(b, *self._axis_at(b, a, kind, system)),
        )

    def space_ahead(self, a: Body, b: Body) -> float:
        """Return the space ahead of a box to another one, negative behind; 0 if they overlap."""
        found = self.signed(a, b, "longitudinal", "entity")
        assert found is not None, "a straight line leads anywhere"
        own, other = self.extents(a, b, "longitudinal", "entity")
        return math.copysign(own.apart(Extent(found + other.low, found + other.high)), found)

    def signed(self, a: Body, b: Body, kind: str, system: str) -> float | None:
        """Return how far b is ahead of a, or to its left; `None` without a route."""
        if system in ("road", "lane"):
            return self._on_road(a, b, kind, system)
        dx, dy = b.here.x - a.here.x, b.here.y - a.here.y
        x, y = self._axis(a, b, kind, system)
        return dx * x + dy * y

    def to_place(self, a: Body, place: LanePosition | Pose, node: Element) -> float:
        """Return the distance of an entity to a place."""
        pose = place if isinstance(place, Pose) else Pose(*self.map.pose(place)[:2], 0.0)
        mark = Body("place", "MiscObject", 0.0, 0.0, 0.0, {}, pose)
        if isinstance(place, LanePosition):  # however far aside of its road it is
            mark.located = pose, mark.place, mark.along, place
        return self.relative(a, mark, node)

    def clear(self, a: Body, others: list[Body], node: Element) -> bool:
        """Whether no other entity is in the lanes beside an entity."""
        ahead, behind = number(node, "distanceForward"), number(node, "distanceBackward")
        ranges = [
            (number(r, "from", -math.inf), number(r, "to", math.inf))
            for r in node.all(xml.RelativeLaneRange)
        ] or [(-math.inf, math.inf)]
        for b in others:
            along = self.signed(a, b, "longitudinal", "lane")
            if along is None:
                continue
            reach = Extent(along, along)
            if node.get("freeSpace") == "true":
                own = extent(b, *self._axis_at(b, a, "longitudinal", "lane"))
                reach = Extent(along + own.low, along + own.high)
            if reach.high < -behind or reach.low > ahead:
                continue
            count = self._lanes_between(a, b, opposite=node.get("oppositeLanes") == "true")
            if count is not None and any(low <= count <= high for low, high in ranges):
                return False
        return True

    def closing_speed(self, a: Body, b: Body, kind: str, system: str) -> float:
        """Return how fast (m/s) the distance of a condition shrinks."""
        if kind == "euclidian":
            dx, dy = b.here.x - a.here.x, b.here.y - a.here.y
            length = math.hypot(dx, dy)
            return sum(
                sign * body.v * (math.cos(body.here.h) * dx + math.sin(body.here.h) * dy) / length
                for body, sign in ((a, 1.0), (b, -1.0))
            )
        found = self.signed(a, b, kind, system) or 0.0
        x, y = self._axis(a, b, kind, system)
        bx, by = self._axis_at(b, a, kind, system)
        own = a.v * (math.cos(a.here.h) * x + math.sin(a.here.h) * y)
        theirs = b.v * (math.cos(b.here.h) * bx + math.sin(b.here.h) * by)
        return math.copysign(1.0, found) * (own - theirs)

    # --- axes -----------------------------------------------------------------------------------

    def _axis(self, a: Body, b: Body, kind: str, system: str) -> tuple[float, float]:
        """Return the axis of a coordinate system at an entity, as it looks."""
        h = a.here.h
        place = a.lane(self.map) if system in ("road", "lane") else None
        if place is not None:
            h = self.map.pose(place).h if a.along > 0 else self.map.pose(place).h + math.pi
        return _turned(h, kind)

    def _axis_at(self, b: Body, a: Body, kind: str, system: str) -> tuple[float, float]:
        """Return the same axis where another entity is: along its road, as the first one looks."""
        mine, theirs = a.lane(self.map), b.lane(self.map)
        if system not in ("road", "lane") or mine is None or theirs is None:
            return self._axis(a, b, kind, system)
        h = self.map.pose(theirs).h
        if mine.road == theirs.road:
            same = self.map.travel_direction(mine.road, mine.lane)
            h += 0.0 if same == self.map.travel_direction(theirs.road, theirs.lane) else math.pi
        return _turned(h if a.along > 0 else h + math.pi, kind)

    def _on_road(self, a: Body, b: Body, kind: str, system: str) -> float | None:
        mine, theirs = a.lane(self.map), b.lane(self.map)
        if mine is None or theirs is None:
            return None
        up = self.map.travel_direction(mine.road, mine.lane) * a.along
        if mine.road == theirs.road:
            if kind == "lateral":
                return (centre(self.map, theirs) - centre(self.map, mine)) * up
            return self._along(mine, theirs, "road" if a.counts_along_road else system) * up
        along = self.map.route_distance(mine, theirs)
        if along is None:
            return None
        if kind == "longitudinal":
            return along * a.along
        at = self.map.pose(self.map.advance(mine._replace(offset=0.0), along).position)
        aside = (b.here.y - at.y) * math.cos(at.h) - (b.here.x - at.x) * math.sin(at.h)
        return (aside - mine.offset) * a.along

    def _along(self, mine: LanePosition, theirs: LanePosition, system: str) -> float:
        """Return how far (m) one place is beyond another one of its road, in the sense of s.

        Along a road that is a difference of s, along a lane the length of its centre line.
        """
        apart = theirs.s - mine.s
        if system == "road":
            return apart
        there = mine._replace(s=theirs.s, offset=0.0)
        up = self.map.travel_direction(mine.road, mine.lane)
        route = self.map.route_distance(mine._replace(offset=0.0), there)
        return apart if route is None else route * up

    def _lanes_between(self, a: Body, b: Body, *, opposite: bool) -> int | None:
        """Return in which lane an entity is, counted to the left of another; `None` if in none."""
        mine, theirs = a.lane(self.map), b.lane(self.map)
        if mine is None or theirs is None:
            return None
        if mine.road != theirs.road:
            return 0  # the tested documents do not need the links between its lanes
        is_opposite = (mine.lane > 0) != (theirs.lane > 0)
        if is_opposite and not opposite:
            return None
        up = self.map.travel_direction(mine.road, mine.lane) * a.along
        return (theirs.lane - mine.lane) * up


def asked(node: Element) -> tuple[str, str]:
    """Return kind and coordinate system of a distance: by default euclidian, of the entity."""
    kind, system = node.get("relativeDistanceType"), node.get("coordinateSystem") or "entity"
    if kind is None and node.get("coordinateSystem") is None and node.get("alongRoute") == "true":
        return "longitudinal", "road"  # as 1.0 says it
    if kind in (None, "euclidianDistance", "cartesianDistance"):
        return "euclidian", system
    if node.get("coordinateSystem") is None and node.get("alongRoute") == "true":
        return kind, "road"
    return kind, system


def _turned(h: float, kind: str) -> tuple[float, float]:
    h += 0.5 * math.pi if kind == "lateral" else 0.0
    return math.cos(h), math.sin(h)

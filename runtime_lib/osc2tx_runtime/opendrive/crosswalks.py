"""Crosswalks: objects of type "crosswalk", each as the straight path of a person across it.

A file gives a box (`length`, `width`) or an outline, either turned by `hdg` against the road; it
does not state which axis of the box is the path and which the width. Pedestrians cross the road, so
the path is the axis that is closer to perpendicular.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from lxml import etree

from osc2tx_shared.classes import dataclass

from .errors import MapError
from .model import Road, road_order
from .poses import surface_pose
from .xml_reader import Attributes

Point = tuple[float, float]

_THIN = 1e-3  # m: an outline of two corners has no width


@dataclass(frozen=True, slots=True)
class Crosswalk:
    """A crosswalk.

    Attributes:
        id: Object id.
        name: Name, may be empty.
        subtype: `pedestrian`, `bicycle`, `zebra`, `virtual`, or empty.
        road: Id of the road that it belongs to.
        s: Road coordinate (m).
        x: Middle of the path (m).
        y: Likewise.
        heading: Direction of the path (rad), from the right side of the road to the left.
        length: Length of the path (m).
        width: Extent across it (m).
        lift: Height of its start above the road (m).
    """

    id: str
    name: str
    subtype: str
    road: str
    s: float
    x: float
    y: float
    heading: float
    length: float
    width: float
    lift: float = 0.0


def read_crosswalks(
    elements: Sequence[etree._Element], roads: Mapping[str, Road], attributes: Attributes
) -> tuple[Crosswalk, ...]:
    """All crosswalks of a map, sorted by id.

    Raises:
        MapError: A crosswalk has neither a box nor an outline.
    """
    found = []
    for element in elements:
        for container in element.iterchildren("objects"):
            for each in container.iterchildren("object"):
                if each.get("type") == "crosswalk":
                    found.append(_crosswalk(each, roads[element.get("id", "")], attributes))
    return tuple(sorted(found, key=lambda crosswalk: road_order(crosswalk.id)))


def _crosswalk(element: etree._Element, road: Road, attributes: Attributes) -> Crosswalk:
    number = attributes.number
    s, t = number(element, "s"), number(element, "t")
    s = min(max(s, 0.0), road.length)
    at = surface_pose(road, s, t, 0.0, 1, tangent=True)
    along_road, turned = at.h, at.h + number(element, "hdg", 0.0)
    box = number(element, "length", 0.0), number(element, "width", 0.0)
    corners = list(_corners(element, road, (at.x, at.y, turned), attributes))
    if len(corners) < 2 and not all(box):
        raise _without_extent(element, attributes)
    # of the box: the axis along `hdg`, or the one to the left of it
    u_is_way = abs(math.sin(turned - along_road)) >= math.sqrt(0.5)
    heading = turned if u_is_way else turned + 0.5 * math.pi
    if math.sin(heading - along_road) < 0.0:
        heading += math.pi
    x, y = at.x, at.y
    length, width = box if u_is_way else (box[1], box[0])
    if len(corners) >= 2:
        (x, y), extents = _middle(corners, heading)
        length = extents[0] if extents[0] > _THIN else length
        width = extents[1] if extents[1] > _THIN else width
    if not (length > 0.0 and width >= 0.0):
        raise _without_extent(element, attributes)
    return Crosswalk(
        id=attributes.text(element, "id"),
        name=element.get("name", ""),
        subtype=element.get("subtype", ""),
        road=road.id,
        s=s,
        x=x,
        y=y,
        heading=math.remainder(heading, math.tau),
        length=length,
        width=width,
        lift=number(element, "zOffset", 0.0),
    )


def _without_extent(element: etree._Element, attributes: Attributes) -> MapError:
    return attributes.error(
        element, "is a crosswalk without extent; give its `length` and `width`, or an `outline`"
    )


def _corners(
    element: etree._Element, road: Road, frame: tuple[float, float, float], attributes: Attributes
) -> Iterator[Point]:
    """Corners of the outlines in the world; `frame` belongs to the object: x, y, heading."""
    number = attributes.number
    x, y, h = frame
    c, n = math.cos(h), math.sin(h)
    for corner in element.iter("cornerLocal", "cornerRoad"):
        if corner.tag == "cornerRoad":
            s = min(max(number(corner, "s"), 0.0), road.length)
            there = surface_pose(road, s, number(corner, "t"), 0.0, 1, tangent=True)
            yield there.x, there.y
        else:
            u, v = number(corner, "u"), number(corner, "v")
            yield x + u * c - v * n, y + u * n + v * c


def _middle(corners: Sequence[Point], heading: float) -> tuple[Point, Point]:
    """Middle of the box around corners, and its extents along and across a heading."""
    c, n = math.cos(heading), math.sin(heading)
    along = [x * c + y * n for x, y in corners]
    across = [y * c - x * n for x, y in corners]
    a, b = 0.5 * (min(along) + max(along)), 0.5 * (min(across) + max(across))
    return (a * c - b * n, a * n + b * c), (max(along) - min(along), max(across) - min(across))

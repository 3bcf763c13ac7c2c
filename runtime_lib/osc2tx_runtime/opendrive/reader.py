"""OpenDRIVE text to roads and junctions. Queries are elsewhere; see `road_map`.

Everything the queries do not need (road marks, most objects, user data) is skipped without a look:
real maps carry junk there. `geoReference` is kept as it is until somebody asks for it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from lxml import etree

from .crosswalks import Crosswalk, read_crosswalks
from .errors import MapError
from .geodesy import GeoReference
from .geometry import Arc, Line, ParamPoly, ReferenceLine, Segment, make_spiral
from .model import Junction, JunctionConnection, Lane, LaneSection, Link, Road, road_order
from .polynomials import ZERO, Piecewise
from .signal_reader import read_controllers, read_signals
from .signals import Controller, Signal
from .xml_reader import Attributes, parse_bytes, parse_xml, source_line

LONGEST = 2e7
"""Metres of all roads together: what is made of them has to fit into memory."""

__all__ = ["MapContent", "read_content", "read_content_text"]


@dataclass(frozen=True, slots=True)
class MapContent:
    """All that is read from a file. Roads and junctions are in numeric order of their ids."""

    file: str
    name: str
    roads: dict[str, Road]
    junctions: dict[str, Junction]
    signals: tuple[Signal, ...]
    controllers: tuple[Controller, ...]
    crosswalks: tuple[Crosswalk, ...]
    geo_reference: GeoReference


def read_content(path: Path) -> MapContent:
    """Reads a file.

    Raises:
        MapError: The file is not a usable OpenDRIVE map.
    """
    return _read(parse_xml(path), str(path), path.stem)


def read_content_text(text: str | bytes, name: str) -> MapContent:
    """Reads a map that is in memory; `name` is used in messages."""
    content = text.encode() if isinstance(text, str) else text
    return _read(parse_bytes(content, name), name, name)


def _read(root: etree._Element, file: str, name: str) -> MapContent:
    attributes = Attributes(file)
    elements = root.findall("road")
    if not elements:
        raise MapError(file, "the map has no `road`; export it again with its road network")
    roads: dict[str, Road] = {}
    for element in elements:
        road = _road(element, attributes)
        if road.id in roads:
            raise attributes.error(element, f"road id `{road.id}` is used twice; make ids unique")
        roads[road.id] = road
    total = sum(road.length for road in roads.values())
    if total > LONGEST:
        raise MapError(file, f"has {total / 1000:.0f} km of roads; at most {LONGEST / 1000:.0f} km")
    junctions = [_junction(element, attributes) for element in root.iterchildren("junction")]
    return MapContent(
        file,
        name,
        dict(sorted(roads.items(), key=lambda item: item[1].order)),
        {j.id: j for j in sorted(junctions, key=lambda j: road_order(j.id))},
        read_signals(elements, attributes),
        read_controllers(root, junctions, attributes),
        read_crosswalks(elements, roads, attributes),
        _geo_reference(root.find("header"), attributes),
    )


def _geo_reference(header: etree._Element | None, attributes: Attributes) -> GeoReference:
    if header is None:
        return GeoReference()
    text, offset = header.findtext("geoReference", ""), header.find("offset")
    if offset is None:
        return GeoReference(text.strip())
    x, y, h = (attributes.number(offset, name, 0.0) for name in ("x", "y", "hdg"))
    return GeoReference(text.strip(), (x, y, h))


def _road(element: etree._Element, attributes: Attributes) -> Road:
    length = attributes.length(element, "length")
    junction = element.get("junction", "-1")
    link = element.find("link")
    lanes = element.find("lanes")
    if lanes is None:
        raise attributes.error(element, "has no `lanes`; a road needs at least one lane section")
    return Road(
        id=attributes.text(element, "id"),
        name=element.get("name", ""),
        length=length,
        junction=None if junction == "-1" else junction,
        right_hand_traffic=element.get("rule", "RHT") != "LHT",
        reference=_plan_view(element, attributes),
        elevation=_profile(element.find("elevationProfile"), "elevation", attributes),
        superelevation=_profile(element.find("lateralProfile"), "superelevation", attributes),
        lane_offset=_profile(lanes, "laneOffset", attributes) or ZERO,
        sections=_sections(lanes, length, attributes),
        predecessor=_link(link, "predecessor", attributes),
        successor=_link(link, "successor", attributes),
        file_line=source_line(element),
    )


def _link(link: etree._Element | None, name: str, attributes: Attributes) -> Link | None:
    element = None if link is None else link.find(name)
    if element is None:
        return None
    kind = element.get("elementType", "road")
    # A missing contact point is guessed later from the geometry; junction links have none.
    return Link(kind, attributes.text(element, "elementId"), element.get("contactPoint", ""))


def _profile(parent: etree._Element | None, name: str, attributes: Attributes) -> Piecewise | None:
    if parent is None:
        return None
    profile = Piecewise.from_records(
        (attributes.number(element, "s"), attributes.cubic(element))
        for element in parent.iterchildren(name)
    )
    return None if profile is None or profile.is_zero() else profile


def _plan_view(road: etree._Element, attributes: Attributes) -> ReferenceLine:
    view = road.find("planView")
    geometries = [] if view is None else view.findall("geometry")
    if not geometries:
        raise attributes.error(road, "has no `planView` with a `geometry`; add its reference line")
    pieces = [(attributes.number(g, "s"), _segment(g, attributes)) for g in geometries]
    pieces.sort(key=lambda piece: piece[0])
    kept = [piece for piece in pieces if piece[1].length > 0.0] or pieces[:1]
    return ReferenceLine([piece[0] for piece in kept], [piece[1] for piece in kept])


def _segment(geometry: etree._Element, attributes: Attributes) -> Segment:
    number = attributes.number
    x, y, h = number(geometry, "x"), number(geometry, "y"), number(geometry, "hdg")
    length = attributes.length(geometry, "length")
    shape = next((child for child in geometry if child.tag in _SHAPES), None)
    if shape is None:
        known = ", ".join(sorted(_SHAPES))
        raise attributes.error(geometry, f"has no known shape; use one of {known}")
    if shape.tag == "line" or length == 0.0:
        return Line(x, y, h, length)
    if shape.tag == "arc":
        return Arc(x, y, h, length, number(shape, "curvature"))
    if shape.tag == "spiral":
        return make_spiral(x, y, h, length, number(shape, "curvStart"), number(shape, "curvEnd"))
    if shape.tag == "poly3":
        v = attributes.cubic(shape)
        return ParamPoly(x, y, h, length, (0.0, 1.0, 0.0, 0.0), v, length, scaled=False)
    u, v = attributes.cubic(shape, "U"), attributes.cubic(shape, "V")
    normalized = shape.get("pRange", "normalized") != "arcLength"
    if not any(u[1:]) and not any(v[1:]):
        raise attributes.error(shape, "does not move: all coefficients are zero")
    return ParamPoly(x, y, h, length, u, v, 1.0 if normalized else length, scaled=True)


NARROWEST = -0.05
"""Metres below nothing that are the rounding of whoever wrote the map."""

_SHAPES = frozenset({"arc", "line", "paramPoly3", "poly3", "spiral"})


def _sections(
    lanes: etree._Element, length: float, attributes: Attributes
) -> tuple[LaneSection, ...]:
    elements = [(attributes.number(e, "s"), e) for e in lanes.iterchildren("laneSection")]
    if not elements:
        raise attributes.error(lanes, "has no `laneSection`; a road needs at least one")
    elements.sort(key=lambda item: item[0])
    begins = [min(max(begin, 0.0), length) for begin, _ in elements]
    begins[0] = 0.0
    ends = [*begins[1:], length]
    return tuple(
        LaneSection(i, begins[i], ends[i], _lanes(element, (begins[i], ends[i]), attributes))
        for i, (_, element) in enumerate(elements)
    )


def _lanes(
    section: etree._Element, ends: tuple[float, float], attributes: Attributes
) -> list[Lane]:
    lanes: list[Lane] = []
    for side in section:
        if side.tag == "left" or side.tag == "right":
            lanes.extend(_lane(e, ends, attributes) for e in side.iterchildren("lane"))
    # Edges are stacked from the centre outwards, so a repeated id would be an overlap.
    if len({lane.id for lane in lanes}) != len(lanes):
        raise attributes.error(section, "a lane id is used twice; make lane ids unique")
    return [lane for lane in lanes if lane.id != 0]


def _lane(element: etree._Element, ends: tuple[float, float], attributes: Attributes) -> Lane:
    begin, end = ends
    lane = Lane(
        attributes.integer(element, "id"),
        element.get("type", "none"),
        source_line(element),
    )
    widths: list[tuple[float, tuple[float, float, float, float]]] = []
    borders: list[tuple[float, tuple[float, float, float, float]]] = []
    for child in element:
        tag = child.tag
        if tag == "width" or tag == "border":
            records = widths if tag == "width" else borders
            start = begin + attributes.number(child, "sOffset")
            records.append((start, attributes.cubic(child)))
        elif tag == "link":
            lane.previous_ids = _linked_ids(child, "predecessor", attributes)
            lane.next_ids = _linked_ids(child, "successor", attributes)
    lane.width = Piecewise.from_records(widths)
    if lane.width is not None and (narrowest := lane.width.extremes(begin, end)[0]) < NARROWEST:
        raise attributes.error(element, f"is {narrowest:g} m wide at one place; give a width")
    lane.border = Piecewise.from_records(borders)
    return lane


def _linked_ids(link: etree._Element, name: str, attributes: Attributes) -> tuple[int, ...]:
    return tuple(attributes.integer(e, "id") for e in link.iterchildren(name))


def _junction(element: etree._Element, attributes: Attributes) -> Junction:
    kind = element.get("type", "default")
    connections = tuple(
        _connection(e, kind, attributes)
        for e in element.iterchildren("connection")
        if e.get("type") != "virtual"
    )
    controllers = tuple(attributes.text(e, "id") for e in element.iterchildren("controller"))
    return Junction(
        attributes.text(element, "id"), element.get("name", ""), kind, connections, controllers
    )


def _connection(element: etree._Element, kind: str, attributes: Attributes) -> JunctionConnection:
    target = element.get("linkedRoad") if kind == "direct" else None
    if target is None:
        target = element.get("connectingRoad") or element.get("linkedRoad")
    if target is None:
        raise attributes.error(element, "names neither `connectingRoad` nor `linkedRoad`")
    links = tuple(
        (attributes.integer(e, "from"), attributes.integer(e, "to"))
        for e in element.iterchildren("laneLink")
    )
    return JunctionConnection(
        element.get("id", ""),
        attributes.text(element, "incomingRoad"),
        target,
        element.get("contactPoint", "start"),
        links,
        source_line(element),
    )

"""OpenDRIVE text to roads and junctions. For queries see `road_map`.

Elements that no query needs (road marks, most objects, user data) are skipped: in real maps they
are often invalid. `geoReference` is kept as text until it is used.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from io import BytesIO
from itertools import pairwise
from pathlib import Path

from lxml import etree

from osc2tx_shared.classes import dataclass

from .cross_sections import read_cross_section
from .crosswalks import Crosswalk, read_crosswalks
from .errors import MapError
from .geodesy import GeoReference
from .geometry import Arc, Line, ParamPoly, ReferenceLine, Segment, make_spiral
from .lane_reader import read_reversed, read_sections
from .model import Junction, JunctionConnection, Link, Road, road_order
from .polynomials import ZERO, Piecewise
from .signal_reader import read_controllers, read_signals
from .signals import Controller, Signal
from .virtual_junctions import cut_where_roads_branch_off
from .xml_reader import Attributes, parse_stream, parse_xml, source_line

ROUNDING = 0.01
"""Difference (m) of numbers in a file that count as equal."""

LONGEST = 2e7
"""Upper limit of the total length (m) of all roads, which has to fit into memory."""


@dataclass(frozen=True, slots=True)
class MapContent:
    """The content of a file. Roads and junctions are in numeric order of their ids.

    `header` has the attributes of the element of that name. `remarks` are errors of the file, and
    relevant elements that are not read, with their lines.
    """

    file: str
    name: str
    roads: dict[str, Road]
    junctions: dict[str, Junction]
    signals: tuple[Signal, ...]
    controllers: tuple[Controller, ...]
    crosswalks: tuple[Crosswalk, ...]
    geo_reference: GeoReference
    header: Mapping[str, str]
    remarks: tuple[str, ...]


def read_content(path: Path) -> MapContent:
    """Reads a file.

    Raises:
        MapError: The file is not a usable OpenDRIVE map.
    """
    return _read(partial(parse_xml, path), str(path), path.stem)


def read_content_text(text: str | bytes, name: str) -> MapContent:
    """Reads a map that is in memory; `name` is used in messages."""
    stream = BytesIO(text.encode() if isinstance(text, str) else text)
    return _read(partial(parse_stream, stream, name), name, name)


def _read(
    parse: Callable[[Callable[[etree._Element], None]], etree._Element], file: str, name: str
) -> MapContent:
    attributes = Attributes(file)
    roads: dict[str, Road] = {}

    def take(element: etree._Element) -> None:
        road = _road(element, attributes)
        if road.id in roads:
            raise attributes.error(element, f"road id `{road.id}` is used twice; make ids unique")
        roads[road.id] = road
        _keep_furniture(element)

    root = parse(take)
    elements = root.findall("road")
    if not elements:
        raise MapError(file, "the map has no `road`; export it again with its road network")
    total = sum(road.length for road in roads.values())
    if total > LONGEST:
        raise MapError(file, f"has {total / 1000:.0f} km of roads; at most {LONGEST / 1000:.0f} km")
    cut_where_roads_branch_off(roads)
    header = root.find("header")
    junctions = [_junction(element, attributes) for element in root.iterchildren("junction")]
    return MapContent(
        file,
        name,
        dict(sorted(roads.items(), key=lambda item: item[1].order)),
        {j.id: j for j in sorted(junctions, key=lambda j: road_order(j.id))},
        read_signals(elements, attributes),
        read_controllers(root, junctions, attributes),
        read_crosswalks(elements, roads, attributes),
        _geo_reference(header, attributes),
        {} if header is None else {str(key): str(value) for key, value in header.items()},
        tuple(attributes.remarks),
    )


def _keep_furniture(road: etree._Element) -> None:
    """Keep the elements of a road that are read after all roads: signals and crosswalks."""
    for child in list(road):
        if child.tag == "objects":
            for each in [each for each in child if each.get("type") != "crosswalk"]:
                child.remove(each)
        elif child.tag != "signals":
            road.remove(child)


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
    lateral = element.find("lateralProfile")
    superelevation = _profile(lateral, "superelevation", attributes)
    cross_section = read_cross_section(lateral, attributes)
    if superelevation is not None and cross_section is not None:
        attributes.remark(
            element, "has a cross-section and superelevation: their heights are added up"
        )
    return Road(
        id=attributes.text(element, "id"),
        name=element.get("name", ""),
        length=length,
        junction=None if junction == "-1" else junction,
        right_hand_traffic=element.get("rule", "RHT") != "LHT",
        reference=_plan_view(element, attributes),
        elevation=_profile(element.find("elevationProfile"), "elevation", attributes),
        superelevation=superelevation,
        cross_section=cross_section,
        lane_offset=_profile(lanes, "laneOffset", attributes) or ZERO,
        sections=read_sections(lanes, length, attributes),
        reversed=read_reversed(lanes, attributes),
        predecessor=_link(link, "predecessor", attributes),
        successor=_link(link, "successor", attributes),
        file_line=source_line(element),
    )


def _link(link: etree._Element | None, name: str, attributes: Attributes) -> Link | None:
    element = None if link is None else link.find(name)
    if element is None:
        return None
    kind = element.get("elementType", "road")
    other = attributes.text(element, "elementId")
    if kind == "road" and element.get("elementS") is not None:
        with_s = element.get("elementDir", "+") != "-"
        return Link(kind, other, "", attributes.length(element, "elementS"), with_s)
    # A missing contact point is determined later from the geometry; junction links have none.
    return Link(kind, other, element.get("contactPoint", ""))


def _profile(parent: etree._Element | None, name: str, attributes: Attributes) -> Piecewise | None:
    if parent is None:
        return None
    records = [
        (attributes.number(element, "s"), attributes.cubic(element))
        for element in parent.iterchildren(name)
    ]
    if records and min(records)[0] > ROUNDING:  # zero before the first record
        records.append((0.0, (0.0, 0.0, 0.0, 0.0)))
    profile = Piecewise.from_records(records)
    return None if profile is None or profile.is_zero() else profile


def _plan_view(road: etree._Element, attributes: Attributes) -> ReferenceLine:
    view = road.find("planView")
    geometries = [] if view is None else view.findall("geometry")
    if not geometries:
        raise attributes.error(road, "has no `planView` with a `geometry`; add its reference line")
    pieces = [(attributes.number(g, "s"), _segment(g, attributes)) for g in geometries]
    pieces.sort(key=lambda piece: piece[0])
    kept = [piece for piece in pieces if piece[1].length > 0.0] or pieces[:1]
    end, length = kept[-1][0] + kept[-1][1].length, attributes.length(road, "length")
    if end - length > ROUNDING:
        attributes.remark(road, f"is {length:g} m long, its geometry {end:g} m")
    for (start, segment), (following, _) in pairwise([*kept, (length, kept[-1][1])]):
        end = start + segment.length
        if following - end > ROUNDING:  # a curve is not extended beyond its end
            told = (
                f"has no geometry from s = {end:g} m to {following:g} m: a straight line is assumed"
            )
            attributes.remark(road, told)
            kept.append((end, Line(*segment.at(segment.length)[:3], following - end)))
    kept.sort(key=lambda piece: piece[0])
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


_SHAPES = frozenset({"arc", "line", "paramPoly3", "poly3", "spiral"})


def _junction(element: etree._Element, attributes: Attributes) -> Junction:
    kind = element.get("type", "default")
    found = list(element.iterchildren("connection"))
    real = [e for e in found if e.get("type") != "virtual"]
    connections = tuple(_connection(e, kind, attributes) for e in real)
    if len(real) < len(found):
        number = len(found) - len(real)
        attributes.remark(element, f"has {number} connections without a road, which are ignored")
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
        attributes.text(element, "incomingRoad", "-1" if kind == "virtual" else None),
        target,
        element.get("contactPoint", "start"),
        links,
        source_line(element),
    )

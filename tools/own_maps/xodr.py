"""From a map to the text of its file."""

from __future__ import annotations

import math
from decimal import Decimal

from lxml import etree

from own_maps.shapes import corners, step
from own_maps.specs import JunctionSpec, LaneSpec, MapSpec, RoadSpec

COEFFICIENTS = ("b", "c", "d")


def number(value: float) -> str:
    """Fixed decimals: the same text on every platform; ten digits keep joints within 1e-9 m."""
    text = f"{value:.10f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def coefficient(value: float) -> str:
    """Fifteen digits, since coefficients of cubics are small and multiply cubes of metres."""
    text = format(Decimal(f"{value:.15g}"), "f")
    return "0" if text == "-0" else text


def add(parent: etree._Element, tag: str, **attributes: str | float | int) -> etree._Element:
    """Adds an element; a trailing underscore in an attribute name is dropped."""
    element = etree.SubElement(parent, tag)
    for name, value in attributes.items():
        write = coefficient if name in COEFFICIENTS else number
        text = value if isinstance(value, str) else write(float(value))
        element.set(name.rstrip("_"), text)
    return element


def write_plan(road: etree._Element, spec: RoadSpec) -> None:
    """The planView element."""
    plan = add(road, "planView")
    place, s = spec.start, 0.0
    for bend in spec.bends:
        x, y, h = place
        geometry = add(plan, "geometry", s=s, x=x, y=y, hdg=h, length=bend.length)
        if bend.start != bend.end:
            add(geometry, "spiral", curvStart=bend.start, curvEnd=bend.end)
        elif bend.start:
            add(geometry, "arc", curvature=bend.start)
        else:
            add(geometry, "line")
        place, s = step(place, bend), s + bend.length


def write_profiles(road: etree._Element, spec: RoadSpec) -> None:
    """Elevation and superelevation."""
    profile = add(road, "elevationProfile")
    for s, a, b, c, d in spec.elevation:
        add(profile, "elevation", s=s, a=a, b=b, c=c, d=d)
    lateral = add(road, "lateralProfile")
    for s, a, b, c, d in spec.superelevation:
        add(lateral, "superelevation", s=s, a=a, b=b, c=c, d=d)


def write_lane(side: etree._Element, spec: LaneSpec) -> None:
    """One lane with links, widths and its outer road mark."""
    lane = add(side, "lane", id=spec.id, type=spec.type, level="false")
    link = add(lane, "link")
    if spec.before is not None:
        add(link, "predecessor", id=spec.before)
    if spec.after is not None:
        add(link, "successor", id=spec.after)
    if spec.id != 0:
        records = spec.width
        if not isinstance(records, tuple):
            records = ((0.0, records, 0.0, 0.0, 0.0),)
        for s, a, b, c, d in records:
            add(lane, "width", sOffset=s, a=a, b=b, c=c, d=d)
    change = "both" if spec.mark == "broken" else "none"
    add(
        lane,
        "roadMark",
        sOffset=0.0,
        type=spec.mark,
        weight="standard",
        color="standard",
        width=0.12 if spec.mark != "none" else 0.0,
        laneChange=change,
    )


def write_lanes(road: etree._Element, spec: RoadSpec) -> None:
    """The lanes element with its sections."""
    lanes = add(road, "lanes")
    add(lanes, "laneOffset", s=0.0, a=0.0, b=0.0, c=0.0, d=0.0)
    for s, specs in spec.sections:
        section = add(lanes, "laneSection", s=s)
        left = sorted((x for x in specs if x.id > 0), key=lambda x: -x.id)
        right = sorted((x for x in specs if x.id < 0), key=lambda x: -x.id)
        both_ways = bool(left and right)
        middle = LaneSpec(0, "none", 0.0, "solid solid" if both_ways else "solid")
        for name, group in (("left", left), ("center", [middle]), ("right", right)):
            if group:
                side = add(section, name)
                for lane in group:
                    write_lane(side, lane)


def write_furniture(road: etree._Element, spec: RoadSpec) -> None:
    """Crosswalk objects and signals."""
    if spec.crosswalk is not None:
        s, width = spec.crosswalk
        add(
            add(road, "objects"),
            "object",
            type="crosswalk",
            subtype="zebra",
            id=f"{spec.id}00",
            name="crosswalk",
            s=s,
            t=0.0,
            zOffset=0.0,
            orientation="none",
            length=4.0,
            width=width,
            height=0.0,
            hdg=0.0,
        )
    if not spec.signals:
        return
    signals = add(road, "signals")
    for signal in spec.signals:
        element = add(
            signals,
            "signal",
            s=signal.s,
            t=signal.t,
            id=signal.id,
            name=signal.name,
            dynamic="yes" if signal.dynamic else "no",
            orientation=signal.orientation,
            zOffset=2.5,
            country="OpenDRIVE" if signal.dynamic else "DE",
            type=signal.type,
            subtype="-1",
            **({"value": signal.value} if signal.value else {}),
            height=0.9,
            width=0.4,
            hOffset=0.0,
        )
        if signal.unit:
            element.set("unit", signal.unit)


def write_road(root: etree._Element, spec: RoadSpec) -> None:
    """One road element."""
    length = sum(bend.length for bend in spec.bends)
    road = add(root, "road", name=spec.name, length=length, id=spec.id, junction=spec.junction)
    road.set("rule", spec.rule)
    link = add(road, "link")
    for tag, target in (("predecessor", spec.predecessor), ("successor", spec.successor)):
        if target is not None:
            element = add(link, tag, elementType=target[0], elementId=target[1])
            if target[2]:
                element.set("contactPoint", target[2])
    add(add(road, "type", s=0.0, type=spec.type), "speed", max=spec.speed, unit="km/h")
    write_plan(road, spec)
    write_profiles(road, spec)
    write_lanes(road, spec)
    write_furniture(road, spec)


def write_junction(root: etree._Element, spec: JunctionSpec) -> None:
    """One junction element; connecting roads are entered at their start."""
    junction = add(root, "junction", id=spec.id, name=spec.name, type="default")
    for i, (incoming, connecting, links) in enumerate(spec.connections):
        connection = add(
            junction,
            "connection",
            id=i,
            incomingRoad=incoming,
            connectingRoad=connecting,
            contactPoint="start",
        )
        for source, target in links:
            add(connection, "laneLink", from_=source, to=target)
    for controller in spec.controllers:
        add(junction, "controller", id=controller, type="0")


def render(spec: MapSpec) -> bytes:
    """A map as the bytes of its file."""
    root = etree.Element("OpenDRIVE")
    points = [point for road in spec.roads for point in corners(road)]
    header = add(
        root,
        "header",
        revMajor=1,
        revMinor=6,
        name=spec.name,
        version="1.00",
        date="2026-01-01T00:00:00",
        north=math.ceil(max(y for _, y in points)),
        south=math.floor(min(y for _, y in points)),
        east=math.ceil(max(x for x, _ in points)),
        west=math.floor(min(x for x, _ in points)),
        vendor="osc2tx",
    )
    geo = add(header, "geoReference")
    place = "+proj=tmerc +lat_0=0 +lon_0=0 +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m +no_defs"
    geo.text = etree.CDATA(place)
    for road in spec.roads:
        write_road(root, road)
    for identity, name, signals in spec.controllers:
        controller = add(root, "controller", id=identity, name=name, sequence=int(identity))
        for signal in signals:
            add(controller, "control", signalId=signal, type="0")
    for junction in spec.junctions:
        write_junction(root, junction)
    return etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")

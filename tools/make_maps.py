"""Writes the OpenDRIVE maps that ship with the runtime library.

Run `python tools/make_maps.py` to write `runtime_lib/osc2tx_runtime/maps/*.xodr`, or give another
folder. The bytes depend on nothing but this file: a test writes them again and compares.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

from lxml import etree

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "runtime_lib"))

from osc2tx_runtime.opendrive.geometry import make_spiral  # noqa: E402 (needs the path above)

FOLDER = ROOT / "runtime_lib" / "osc2tx_runtime" / "maps"
LANE = 3.5  # m, width of a driving lane

Cubic = tuple[float, float, float, float, float]
"""s, a, b, c, d."""
Place = tuple[float, float, float]
"""x (m), y (m), heading (rad)."""


@dataclass(frozen=True)
class Bend:
    """A piece of reference line whose curvature (1/m) changes linearly."""

    length: float
    start: float = 0.0
    end: float = 0.0


@dataclass(frozen=True)
class LaneSpec:
    """A lane: id, type, width records (sOffset first) and links."""

    id: int
    type: str = "driving"
    width: float | tuple[Cubic, ...] = LANE
    mark: str = "broken"
    before: int | None = None
    after: int | None = None


@dataclass(frozen=True)
class SignalSpec:
    """A signal at (s, t)."""

    id: str
    name: str
    s: float
    t: float
    orientation: str
    type: str
    dynamic: bool = False
    value: str = "-1"
    unit: str = ""


@dataclass(frozen=True)
class RoadSpec:
    """A road. Links are (kind, id, contact point)."""

    id: str
    name: str
    start: Place
    bends: tuple[Bend, ...]
    sections: tuple[tuple[float, tuple[LaneSpec, ...]], ...]
    speed: int = 50
    type: str = "town"
    junction: str = "-1"
    rule: str = "RHT"
    predecessor: tuple[str, str, str] | None = None
    successor: tuple[str, str, str] | None = None
    elevation: tuple[Cubic, ...] = ((0.0, 0.0, 0.0, 0.0, 0.0),)
    superelevation: tuple[Cubic, ...] = ()
    signals: tuple[SignalSpec, ...] = ()
    crosswalk: tuple[float, float] | None = None


@dataclass(frozen=True)
class JunctionSpec:
    """A junction. Connections are (incoming, connecting, lane links)."""

    id: str
    name: str
    connections: tuple[tuple[str, str, tuple[tuple[int, int], ...]], ...]
    controllers: tuple[str, ...] = ()


@dataclass(frozen=True)
class MapSpec:
    """A whole map."""

    name: str
    roads: tuple[RoadSpec, ...]
    junctions: tuple[JunctionSpec, ...] = ()
    controllers: tuple[tuple[str, str, tuple[str, ...]], ...] = field(default=())


def number(value: float) -> str:
    """Fixed decimals: the same text on every platform; ten digits keep joints within 1e-9 m."""
    text = f"{value:.10f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def add(parent: etree._Element, tag: str, **attributes: str | float | int) -> etree._Element:
    """Adds an element; a trailing underscore in an attribute name is dropped."""
    element = etree.SubElement(parent, tag)
    for name, value in attributes.items():
        text = value if isinstance(value, str) else number(float(value))
        element.set(name.rstrip("_"), text)
    return element


def step(place: Place, bend: Bend, distance: float | None = None) -> Place:
    """Place at the end of a bend (or at a distance along it)."""
    segment = make_spiral(*place, bend.length, bend.start, bend.end)
    x, y, h, _ = segment.at(bend.length if distance is None else distance)
    return x, y, h


def ending_at(end: Place, bends: Sequence[Bend]) -> Place:
    """Start place from which the bends lead to `end`."""
    x, y, h = 0.0, 0.0, 0.0
    for bend in bends:
        x, y, h = step((x, y, h), bend)
    turn = end[2] - h
    c, s = math.cos(turn), math.sin(turn)
    return end[0] - x * c + y * s, end[1] - x * s - y * c, turn


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
            value=signal.value,
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


def corners(spec: RoadSpec) -> list[tuple[float, float]]:
    """Points around a road, for the box in the header."""
    points: list[tuple[float, float]] = []
    place = spec.start
    for bend in spec.bends:
        for i in range(21):
            x, y, _ = step(place, bend, bend.length * i / 20)
            points.extend(((x - 20.0, y - 20.0), (x + 20.0, y + 20.0)))
        place = step(place, bend)
    return points


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
    geo.text = etree.CDATA("+proj=tmerc +lat_0=0 +lon_0=0 +k=1 +x_0=0 +y_0=0 +units=m +no_defs")
    for road in spec.roads:
        write_road(root, road)
    for identity, name, signals in spec.controllers:
        controller = add(root, "controller", id=identity, name=name, sequence=int(identity))
        for signal in signals:
            add(controller, "control", signalId=signal, type="0")
    for junction in spec.junctions:
        write_junction(root, junction)
    return etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")


def cross_section(
    right: Sequence[tuple[str, float]], left: Sequence[tuple[str, float]]
) -> tuple[LaneSpec, ...]:
    """Lanes from the centre outwards, given as (type, width); marks follow from the types."""
    lanes: list[LaneSpec] = []
    for sign, side in ((-1, right), (1, left)):
        for i, (kind, width) in enumerate(side, 1):
            inner = i < len(side) and kind == "driving" and side[i][0] == "driving"
            mark = "broken" if inner else "solid" if kind == "driving" else "none"
            lanes.append(LaneSpec(sign * i, kind, width, mark))
    return tuple(lanes)


def hermite(knots: Sequence[tuple[float, float]]) -> tuple[Cubic, ...]:
    """Smooth steps between (s, value) knots, level at each knot."""
    records: list[Cubic] = []
    for (s0, v0), (s1, v1) in pairwise(knots):
        span, rise = s1 - s0, v1 - v0
        records.append((s0, v0, 0.0, 3.0 * rise / span**2, -2.0 * rise / span**3))
    records.append((knots[-1][0], knots[-1][1], 0.0, 0.0, 0.0))
    return tuple(records)


DRIVING = ("driving", LANE)
SHOULDER = ("shoulder", 3.0)
SIDEWALK = ("sidewalk", 2.5)


def highway() -> MapSpec:
    """Motorway of 2 km: 4 lanes one way, 3 the other; straight for 1300 m, then a gentle left."""
    k = 1.0 / 800.0
    bends = (Bend(1300), Bend(120, 0.0, k), Bend(260, k, k), Bend(120, k, 0.0), Bend(200))
    lanes = cross_section([DRIVING] * 4 + [SHOULDER], [DRIVING] * 3 + [SHOULDER])
    sign = SignalSpec("1", "speed limit", 50.0, -18.5, "+", "274", value="120", unit="km/h")
    road = RoadSpec(
        "1",
        "highway",
        (0.0, 0.0, 0.0),
        bends,
        ((0.0, lanes),),
        speed=120,
        type="motorway",
        signals=(sign,),
    )
    return MapSpec("highway", (road,))


def curve() -> MapSpec:
    """S-curve of clothoids and arcs with elevation and superelevation."""
    k = 1.0 / 120.0
    bends = (
        Bend(100),
        Bend(50, 0.0, k),
        Bend(120, k, k),
        Bend(50, k, 0.0),
        Bend(50, 0.0, -k),
        Bend(120, -k, -k),
        Bend(50, -k, 0.0),
        Bend(100),
    )
    lanes = cross_section([DRIVING] * 2 + [SHOULDER], [DRIVING] * 2 + [SHOULDER])
    # The road leans into the curve: left curve, left side down.
    roll = hermite(
        [(0, 0), (100, 0), (150, -0.05), (270, -0.05), (370, 0.05), (490, 0.05), (540, 0)]
    )
    road = RoadSpec(
        "1",
        "s-curve",
        (0.0, 0.0, 0.0),
        bends,
        ((0.0, lanes),),
        speed=70,
        type="rural",
        elevation=hermite([(0, 0), (80, 0), (300, 6), (400, 6), (600, 1)]),
        superelevation=roll,
    )
    return MapSpec("curve", (road,))


def left_hand() -> MapSpec:
    """Left-hand traffic: two lanes each way, a straight and a right curve."""
    k = -1.0 / 150.0
    bends = (Bend(300), Bend(60, 0.0, k), Bend(100, k, k), Bend(60, k, 0.0), Bend(100))
    lanes = cross_section([DRIVING] * 2 + [SIDEWALK], [DRIVING] * 2 + [SIDEWALK])
    road = RoadSpec("1", "left-hand", (0.0, 0.0, 0.0), bends, ((0.0, lanes),), rule="LHT")
    return MapSpec("left_hand", (road,))


def crossing() -> MapSpec:
    """Straight street of 500 m with sidewalks and a crosswalk in the middle."""
    lanes = cross_section([DRIVING, SIDEWALK], [DRIVING, SIDEWALK])
    road = RoadSpec(
        "1",
        "street",
        (0.0, 0.0, 0.0),
        (Bend(500),),
        ((0.0, lanes),),
        crosswalk=(250.0, 2 * LANE),
        signals=(SignalSpec("1", "pedestrian crossing", 245.0, -4.5, "+", "350"),),
    )
    return MapSpec("crossing", (road,))


MERGE = 340.0  # m, x at which the ramp has joined the motorway
TWO_LANES = (DRIVING, DRIVING, ("shoulder", 2.5))
THREE_LANES = (DRIVING, DRIVING, ("entry", LANE), ("shoulder", 2.5))


def merge() -> MapSpec:
    """Motorway with an on-ramp: junction, acceleration lane, taper."""
    to_junction = ("junction", "5", "")
    joint = (Bend(40, -0.00375, -0.00375),)
    joint_start = ending_at((MERGE, -2 * LANE, 0.0), joint)
    ramp = (Bend(150), Bend(50, -0.003, -0.003))
    ramp_lanes = cross_section([DRIVING, ("shoulder", 1.5)], [])
    before = RoadSpec(
        "1",
        "before",
        (0.0, 0.0, 0.0),
        (Bend(300),),
        ((0.0, cross_section(TWO_LANES, [])),),
        speed=120,
        type="motorway",
        successor=to_junction,
    )
    after = RoadSpec(
        "2",
        "after",
        (MERGE, 0.0, 0.0),
        (Bend(600),),
        _sections_after_merge(),
        speed=120,
        type="motorway",
        predecessor=to_junction,
    )
    ramp_road = RoadSpec(
        "3",
        "ramp",
        ending_at(joint_start, ramp),
        ramp,
        ((0.0, ramp_lanes),),
        speed=80,
        type="motorway",
        successor=to_junction,
    )
    # The shoulder ends at the ramp.
    through = tuple(
        _linked(x, x.id, None if x.id == -3 else x.id) for x in cross_section(TWO_LANES, [])
    )
    entry = (LaneSpec(-1, mark="solid", before=-1, after=-3),)
    connectors = (
        _merge_connector("10", "through", (300.0, 0.0, 0.0), (Bend(40),), through, "1"),
        _merge_connector("11", "entry", joint_start, joint, entry, "3"),
    )
    connections = (("1", "10", ((-1, -1), (-2, -2), (-3, -3))), ("3", "11", ((-1, -1),)))
    junction = JunctionSpec("5", "merge", connections)
    return MapSpec("merge", (before, after, ramp_road, *connectors), (junction,))


def _sections_after_merge() -> tuple[tuple[float, tuple[LaneSpec, ...]], ...]:
    """Acceleration lane of 200 m, then 100 m in which it closes, then two lanes."""
    taper = 100.0
    closing = ((0.0, LANE, 0.0, -3.0 * LANE / taper**2, 2.0 * LANE / taper**3),)
    wide = cross_section(THREE_LANES, [])
    beside = tuple(_linked(x, None if x.id == -4 else x.id, x.id) for x in wide)
    narrowing = tuple(
        _linked(x, x.id, {-3: None, -4: -3}.get(x.id, x.id), closing if x.id == -3 else None)
        for x in wide
    )
    two = tuple(_linked(x, {-3: -4}.get(x.id, x.id), None) for x in cross_section(TWO_LANES, []))
    return (0.0, beside), (200.0, narrowing), (300.0, two)


def _merge_connector(
    identity: str,
    name: str,
    start: Place,
    bends: tuple[Bend, ...],
    lanes: tuple[LaneSpec, ...],
    source: str,
) -> RoadSpec:
    """Connecting road of the merge, from the end of `source` to the motorway after it."""
    return RoadSpec(
        identity,
        name,
        start,
        bends,
        ((0.0, lanes),),
        speed=120 if source == "1" else 80,
        type="motorway",
        junction="5",
        predecessor=("road", source, "end"),
        successor=("road", "2", "start"),
    )


def _linked(
    lane: LaneSpec, before: int | None, after: int | None, width: tuple[Cubic, ...] | None = None
) -> LaneSpec:
    """A lane with links, and with another width if one is given."""
    return LaneSpec(lane.id, lane.type, width or lane.width, lane.mark, before, after)


ARM, HALF = 150.0, 20.0  # m: length of an arm, distance of its end from the centre


def urban_crossing() -> MapSpec:
    """Crossing of two streets with two lanes each way, turn roads, lights and controllers."""
    arms = tuple(_arm(i) for i in range(4))
    turns: list[RoadSpec] = []
    connections: list[tuple[str, str, tuple[tuple[int, int], ...]]] = []
    for i in range(4):
        for j, (name, offset) in enumerate((("right", 1), ("straight", 2), ("left", 3))):
            road, links = _turn(i, (i + offset) % 4, name, str(10 * (i + 1) + j))
            turns.append(road)
            connections.append((str(i + 1), road.id, links))
    controllers = (("1", "east-west", ("101", "103")), ("2", "north-south", ("102", "104")))
    junction = JunctionSpec("9", "crossing", tuple(connections), ("1", "2"))
    return MapSpec("urban_crossing", arms + tuple(turns), (junction,), controllers)


def _arm(i: int) -> RoadSpec:
    """Arm i lies at i x 90 degrees; s runs towards the crossing."""
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[i]
    far = ARM + HALF
    lanes = cross_section([DRIVING] * 2 + [SIDEWALK], [DRIVING] * 2 + [SIDEWALK])
    light = SignalSpec(f"{101 + i}", f"light {i + 1}", ARM - 1.0, -8.0, "+", "1000001", True)
    return RoadSpec(
        str(i + 1),
        ("east", "north", "west", "south")[i],
        (c * far, s * far, math.pi / 2 * i - math.pi if i else math.pi),
        (Bend(ARM),),
        ((0.0, lanes),),
        successor=("junction", "9", ""),
        signals=(
            light,
            SignalSpec(
                f"{201 + i}", "speed limit", 10.0, -8.0, "+", "274", value="50", unit="km/h"
            ),
        ),
    )


def _turn(
    i: int, target: int, name: str, identity: str
) -> tuple[RoadSpec, tuple[tuple[int, int], ...]]:
    """Connecting road from arm i; its reference line is the left edge of its lanes."""
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[i]
    h = math.pi / 2 * i - math.pi if i else math.pi
    aside = LANE if name == "right" else 0.0
    # Inbound heading is (-c, -s), so its right-hand side is (-s, c).
    start = (c * HALF - s * aside, s * HALF + c * aside, h)
    radius = {"right": -(HALF - LANE), "left": HALF}.get(name)
    bend = Bend(2 * HALF)
    if radius is not None:
        bend = Bend(abs(radius) * math.pi / 2, 1.0 / radius, 1.0 / radius)
    links: tuple[tuple[int, int], ...]
    if name == "straight":
        links, exits = ((-1, -1), (-2, -2)), {-1: 1, -2: 2}
    elif name == "right":
        links, exits = ((-2, -1),), {-1: 2}
    else:
        links, exits = ((-1, -1),), {-1: 1}
    lanes = tuple(LaneSpec(to, "driving", LANE, "none", source, exits[to]) for source, to in links)
    road = RoadSpec(
        identity,
        f"{name} from {i + 1}",
        start,
        (bend,),
        ((0.0, lanes),),
        junction="9",
        predecessor=("road", str(i + 1), "end"),
        successor=("road", str(target + 1), "end"),
    )
    return road, links


MAPS: dict[str, Callable[[], MapSpec]] = {
    "crossing": crossing,
    "curve": curve,
    "highway": highway,
    "left_hand": left_hand,
    "merge": merge,
    "urban_crossing": urban_crossing,
}


def main(arguments: Sequence[str]) -> int:
    """Writes all maps into the folder given, or into the runtime library."""
    folder = Path(arguments[0]) if arguments else FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    for name, build in MAPS.items():
        (folder / f"{name}.xodr").write_bytes(render(build()))
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))

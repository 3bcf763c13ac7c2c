"""The elements of a map: roads, lane sections, lanes, junctions, and the public value types."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import field
from typing import TYPE_CHECKING, NamedTuple

from osc2tx_shared.classes import dataclass

from .polynomials import ZERO, Piecewise, combine

if TYPE_CHECKING:
    from .arc_length import LaneLine
    from .cross_sections import CrossSection
    from .geometry import ReferenceLine

new_tuple = tuple.__new__
"""Creates a named tuple of all its fields in half the time of a call: `new_tuple(Pose, (x,
...))`."""

DRIVING: frozenset[str] = frozenset(
    {
        "HOV",
        "bidirectional",
        "bus",
        "connectingRamp",
        "driving",
        "entry",
        "exit",
        "mwyEntry",
        "mwyExit",
        "offRamp",
        "onRamp",
        "slipLane",
        "taxi",
    }
)
"""Lane types that vehicles drive on."""


class Pose(NamedTuple):
    """Position (m) and attitude (rad, ISO 8855: nose down and right side down are positive)."""

    x: float
    y: float
    z: float
    h: float
    pitch: float = 0.0
    roll: float = 0.0


@dataclass(frozen=True, slots=True)
class LaneKey:
    """A lane within one lane section of a road."""

    road: str
    section: int
    lane: int


class LanePosition(NamedTuple):
    """A position on a lane.

    Attributes:
        road: Road id.
        lane: OpenDRIVE lane id.
        s: Road coordinate (m); the lane section follows from it.
        offset: Distance from the lane centre (m), left in direction of travel is positive.
    """

    road: str
    lane: int
    s: float
    offset: float = 0.0


class Advance(NamedTuple):
    """Result of moving along a lane: position and distance moved (m, signed)."""

    position: LanePosition
    travelled: float


@dataclass(frozen=True, slots=True)
class LaneOutline:
    """Both edges of a lane (left and right of the reference line direction), for drawing."""

    road: str
    lane: int
    type: str
    left: list[tuple[float, float]]
    right: list[tuple[float, float]]
    junction: str | None


@dataclass(frozen=True, slots=True)
class Link:
    """Road link.

    Attributes:
        kind: "road" or "junction".
        id: Of the linked element.
        contact: The end of a linked road, "start" or "end".
        s: Position of the link within a road (m), None if at an end of it.
        with_s: Whether the direction from start to end continues along s of that road.
    """

    kind: str
    id: str
    contact: str
    s: float | None = None
    with_s: bool = True


@dataclass(frozen=True, slots=True)
class JunctionConnection:
    """Connection from an incoming road to a connecting (or, in direct junctions, linked) road."""

    id: str
    incoming: str
    connecting: str
    contact: str
    links: tuple[tuple[int, int], ...]
    line: int


@dataclass(frozen=True, slots=True)
class Junction:
    """A junction. `type` is "default", "direct", "virtual" or "crossing"."""

    id: str
    name: str
    type: str
    connections: tuple[JunctionConnection, ...]
    controllers: tuple[str, ...] = ()


class LaneBends(NamedTuple):
    """The bends of a lane.

    Attributes:
        sharpest: The largest curvature (1/m); 0 of a straight lane.
        stretches: Start and end (m from the start of the lane) and curvature of each stretch.
    """

    sharpest: float
    stretches: tuple[tuple[float, float, float], ...]


class Lane:
    """A lane of one lane section; node of the lane graph.

    Attributes:
        direction: +1 if traffic runs with s, -1 against.
        successors: Lanes that follow in direction of travel, sorted.
        predecessors: Lanes that lead here, sorted.
        centre: t of the centre line over road s (m).
        outer: t of the edge away from the reference line (m).
        level: Whether it remains level on a road with superelevation.
        level_from: t of the edge (m) whose height it then has, None if it follows its road.
        bends: Its bends.
        heights: Heights above the road at the inner and at the outer edge (m); None if it is on the
            road.
    """

    __slots__ = (
        "bends",
        "border",
        "centre",
        "direction",
        "file_line",
        "group",
        "heights",
        "id",
        "key",
        "level",
        "level_from",
        "line",
        "next_ids",
        "outer",
        "predecessors",
        "previous_ids",
        "road",
        "section",
        "successors",
        "type",
        "width",
    )

    def __init__(self, lane_id: int, lane_type: str, file_line: int) -> None:
        self.id = lane_id
        self.type = lane_type
        self.file_line = file_line
        self.width: Piecewise | None = None
        self.border: Piecewise | None = None
        self.level = False
        self.level_from: Piecewise | None = None
        self.heights: tuple[Piecewise, Piecewise] | None = None
        self.previous_ids: tuple[int, ...] = ()
        self.next_ids: tuple[int, ...] = ()
        self.direction = 1
        self.successors: tuple[Lane, ...] = ()
        self.predecessors: tuple[Lane, ...] = ()
        self.group = -1
        self.centre: Piecewise = ZERO
        self.outer: Piecewise = ZERO
        self.line: LaneLine | None = None
        self.bends: LaneBends | None = None
        self.key: LaneKey
        self.road: Road
        self.section: LaneSection

    def edges(self, s: float) -> tuple[float, float]:
        """Right and left edge (t, m) at `s`, right meaning the smaller t."""
        outer = self.outer.value(s)
        inner = 2.0 * self.centre.value(s) - outer
        return (outer, inner) if outer < inner else (inner, outer)

    def height_at(self, s: float, t: float) -> float:
        """Height (m) of the surface above the road, linear from edge to edge."""
        if self.heights is None:
            return 0.0
        inner, outer = (edge.value(s) for edge in self.heights)
        width = 2.0 * (self.outer.value(s) - self.centre.value(s))
        share = 1.0 - (self.outer.value(s) - t) / width if width else 0.0
        return inner + (outer - inner) * min(max(share, 0.0), 1.0)

    def width_at(self, s: float) -> float:
        """Width (m) at `s`."""
        return 2.0 * abs(self.outer.value(s) - self.centre.value(s))


class LaneSection:
    """Adjacent lanes on [begin, end) of a road. Lane 0 is not stored."""

    __slots__ = ("begin", "end", "index", "lanes", "left", "ready", "right", "road")

    def __init__(self, index: int, begin: float, end: float, lanes: list[Lane]) -> None:
        self.index, self.begin, self.end = index, begin, end
        self.lanes = {lane.id: lane for lane in sorted(lanes, key=lambda lane: lane.id)}
        self.left = tuple(lane for key, lane in sorted(self.lanes.items()) if key > 0)
        self.right = tuple(
            lane for key, lane in sorted(self.lanes.items(), reverse=True) if key < 0
        )
        self.ready = False
        self.road: Road

    def prepare(self) -> None:
        """Builds the edge and centre polynomials of all lanes (on first use: loading is faster)."""
        self.ready = True
        offset = self.road.lane_offset
        for sign, lanes in ((1.0, self.left), (-1.0, self.right)):
            inner, level_from = offset, None
            for lane in lanes:
                if lane.level:
                    level_from = lane.level_from = level_from or inner
                lane.outer = self._outer(lane, inner, sign)
                lane.centre = combine(((0.5, inner), (0.5, lane.outer)), self.begin, self.end)
                inner = lane.outer

    def _outer(self, lane: Lane, inner: Piecewise, sign: float) -> Piecewise:
        if lane.width is not None:
            return combine(((1.0, inner), (sign, lane.width)), self.begin, self.end)
        if lane.border is not None:
            offset = self.road.lane_offset
            return combine(((1.0, offset), (1.0, lane.border)), self.begin, self.end)
        return inner


@dataclass(slots=True, eq=False)
class Road:
    """A road.

    Attributes:
        id: Road id.
        name: Name, may be empty.
        length: Length of the reference line (m).
        junction: Id of the junction the road belongs to as a connecting road, else None.
        right_hand_traffic: False for rule="LHT".
        reference: Plan view.
        elevation: Height over s (m), None if flat.
        superelevation: Roll of the cross-section over s (rad), None if zero.
        cross_section: Cross-section heights, None if it is flat.
        lane_offset: t of lane 0 over s (m).
        sections: Lane sections in order of s.
        reversed: Ids of its lanes with traffic opposite to that of their side.
    """

    id: str
    name: str
    length: float
    junction: str | None
    right_hand_traffic: bool
    reference: ReferenceLine
    elevation: Piecewise | None
    superelevation: Piecewise | None
    cross_section: CrossSection | None
    lane_offset: Piecewise
    sections: tuple[LaneSection, ...]
    predecessor: Link | None
    successor: Link | None
    file_line: int
    starts: list[float] = field(default_factory=list)
    order: tuple[int, int, str] = (0, 0, "")
    reversed: frozenset[int] = frozenset()

    def __post_init__(self) -> None:
        """Ties lanes and sections to this road."""
        self.starts = [section.begin for section in self.sections]
        self.order = road_order(self.id)
        for section in self.sections:
            section.road = self
            for lane in section.lanes.values():
                lane.road, lane.section = self, section
                lane.key = LaneKey(self.id, section.index, lane.id)
                lane.direction = self.direction_of(lane.id)

    def direction_of(self, lane: int) -> int:
        """+1 if traffic on a lane of this id runs with s, -1 against."""
        with_s = (lane < 0) == self.right_hand_traffic
        return 1 if with_s != (lane in self.reversed) else -1

    @property
    def is_flat(self) -> bool:
        """Whether it is in the xy plane, except for heights of lanes."""
        return self.elevation is None and self.superelevation is None and self.cross_section is None

    def section_at(self, s: float) -> LaneSection:
        """Lane section at `s`; a boundary belongs to the section that begins there."""
        i = bisect_right(self.starts, s) - 1 if len(self.starts) > 1 else 0
        section = self.sections[i if i > 0 else 0]
        if not section.ready:
            section.prepare()
        return section


def road_order(road: str) -> tuple[int, int, str]:
    """Sort key of a road id: numbers first and by value, then names."""
    return (0, int(road), road) if road.isdecimal() else (1, 0, road)

"""Entities of a document as bodies on a map: where they are, how they move."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import field
from typing import NamedTuple

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.courses import Course, number
from osc2tx.xosc.player.errors import Unplayable
from osc2tx_runtime.opendrive import LaneCursor, LanePosition, RoadMap, Route
from osc2tx_shared.classes import dataclass

LONGITUDINAL, LATERAL = "longitudinal", "lateral"
STANDING = 1e-3  # m/s
STRAIGHT = 0.75 * math.pi  # beyond: it looks against its lane


class Pose(NamedTuple):
    """Metres and radians in the world."""

    x: float
    y: float
    h: float


@dataclass
class Body:
    """An entity.

    Attributes:
        name: Its name.
        kind: Its element: `Vehicle`, `Pedestrian` or `MiscObject`.
        front: Metres from its reference point to its front end.
        rear: Metres from its reference point to its rear end.
        width: Metres.
        limits: Attributes of `Performance`, infinite where they are omitted.
        pose: Its pose.
        place: The lane that it follows, with its offset from there; `None` off the lanes.
        along: 1 if its heading is the direction of travel of that lane, -1 if against it.
        route: Decides at forks.
        v: m/s.
        a: m/s^2, along its axis.
        rate: m/s to its left.
        velocity: m/s in the world.
        swing: m/s^2 to its left.
        actions: Running actions, by domain.
        driven: Metres since the start.
        stood: Seconds at standstill.
        is_at_end: Its road has ended.
        beyond: Seconds since then.
        keeps_lanes: Without a path it moves along its lane, not along its heading.
        counts_along_road: Positions relative to it count metres along its road, not along its lane.
        reports_commanded: Its speed without a direction is the one along its axis.
        behind: The towing body, with the metres from its reference point back to the hitch, and
            from the coupler to the own reference point.
        cursor: Moves it along its lane; made with the first step.
        located: For what pose, place and direction of its lane it was looked up last, and where
            it is then. Several conditions of a step read it.
    """

    name: str
    kind: str
    front: float
    rear: float
    width: float
    limits: dict[str, float]
    pose: Pose | None = None
    place: LanePosition | None = None
    along: int = 1
    route: Route | None = None
    v: float = 0.0
    a: float = 0.0
    rate: float = 0.0
    velocity: tuple[float, float] = (0.0, 0.0)
    swing: float = 0.0
    actions: dict[str, Running] = field(default_factory=dict)
    driven: float = 0.0
    stood: float = 0.0
    is_at_end: bool = False
    beyond: float = 0.0
    keeps_lanes: bool = False
    counts_along_road: bool = False
    reports_commanded: bool = False
    behind: tuple[Body, float, float] | None = None
    cursor: LaneCursor | None = None
    located: tuple[Pose, LanePosition | None, int, LanePosition | None] | None = None

    @property
    def here(self) -> Pose:
        """Its pose.

        Raises:
            Unplayable: It has no position.
        """
        if self.pose is None:
            raise Unplayable(f"{self.name} has no position")
        return self.pose

    def lane(self, road_map: RoadMap) -> LanePosition | None:
        """Return the driving lane in which its reference point is, else that of its nearest one."""
        pose, place, along, known = self.here, self.place, self.along, self.located
        if known is not None and known[0] is pose and known[1] is place and known[2] == along:
            return known[3]
        h = pose.h if along > 0 else pose.h + math.pi
        found = road_map.locate(pose.x, pose.y, None, h, hint=place)
        self.located = pose, place, along, found
        return found

    def in_lane(self, road_map: RoadMap) -> LanePosition:
        """Return the same lane, which there has to be.

        Raises:
            Unplayable: There is none.
        """
        place = self.lane(road_map)
        if place is None:
            raise Unplayable(f"{self.name} is on no lane")
        return place

    # --- teleports ----------------------------------------------------------------------------

    def put(self, road_map: RoadMap, place: LanePosition | Pose, turned: float | None) -> None:
        """Place it.

        Args:
            road_map: The map.
            place: On a lane, or anywhere: then it is on a lane where that one lies below it.
            turned: Its heading (rad) in the world; `None`: that of the place.
        """
        self.behind, self.is_at_end = None, False
        if isinstance(place, LanePosition):
            pose = road_map.pose(place)
            self.pose, self.place = Pose(pose.x, pose.y, pose.h), place
        else:
            self.pose, self.place = place, None
            if self.keeps_lanes:
                self.place = self._lane_below(road_map)
        if turned is not None:
            self.pose = self.here._replace(h=turned)
        if self.place is not None:
            off = abs(math.remainder(self.here.h - road_map.pose(self.place).h, math.tau))
            self.along = -1 if off > STRAIGHT else 1

    def _lane_below(self, road_map: RoadMap) -> LanePosition | None:
        """Return its place in a lane; only who is no vehicle is in one from beside it."""
        most = 0.0 if self.kind == "Vehicle" else math.inf
        return road_map.locate(*self.here[:2], heading=self.here.h, max_distance=most)

    def leave_path(self, road_map: RoadMap) -> None:
        """Go on along the lane from where a path ends, if it keeps to lanes."""
        place = self._lane_below(road_map) if self.keeps_lanes else None
        if place is not None:
            self.put(road_map, place, self.here.h)

    # --- motion over one step -----------------------------------------------------------------

    def move(self, road_map: RoadMap, way: float, offset: float | None, dt: float) -> None:
        """Move it by a distance (m), to an offset (m) from its lane where that changes."""
        if self.place is None:
            x, y, h = self.here
            self.pose = Pose(x + way * math.cos(h), y + way * math.sin(h), h)
            return
        aside = 0.0 if offset is None else offset - self.place.offset
        self.rate = aside / dt * self.along
        if way == 0.0 and aside == 0.0:
            return
        onward = math.copysign(math.sqrt(max(way * way - aside * aside, 0.0)), way) * self.along
        cursor = self.cursor = self.cursor or road_map.cursor()
        place, left = cursor.moved(self.place, onward, self.place.offset + aside), 0.0
        if place is None:
            ahead = road_map.advance(self.place, onward, self.route)
            left = abs(onward) - abs(ahead.travelled)
            place = ahead.position._replace(offset=self.place.offset + aside)
        self.place = place
        pose = cursor.pose(place)
        turned = math.atan2(aside * self.along, abs(onward)) if onward else 0.0
        h = (pose.h if self.along > 0 else pose.h + math.pi) + turned
        self.pose = Pose(pose.x, pose.y, h)
        if left > 1e-6:  # the standard does not define ends of roads: the body stops there
            onward = math.copysign(left, way)
            x, y = pose.x + onward * math.cos(h), pose.y + onward * math.sin(h)
            self.pose, self.v, self.is_at_end = Pose(x, y, h), 0.0, True

    def note_motion(self, before: Pose, dt: float) -> None:
        """Take down velocity and lateral acceleration over a step."""
        x, y, h = self.here
        vx, vy = (x - before.x) / dt, (y - before.y) / dt
        ax, ay = (vx - self.velocity[0]) / dt, (vy - self.velocity[1]) / dt
        self.driven += abs(self.v) * dt
        self.stood = self.stood + dt if abs(self.v) < STANDING else 0.0
        self.beyond = self.beyond + dt if self.is_at_end else 0.0
        self.velocity, self.swing = (vx, vy), ay * math.cos(h) - ax * math.sin(h)

    def trail(self) -> None:
        """Move it straight towards the hitch of its towing vehicle."""
        assert self.behind is not None
        tow, hitch, bar = self.behind
        x = tow.here.x - hitch * math.cos(tow.here.h)
        y = tow.here.y - hitch * math.sin(tow.here.h)
        h = math.atan2(y - self.here.y, x - self.here.x)
        self.pose, self.v = Pose(x - bar * math.cos(h), y - bar * math.sin(h), h), tow.v


@dataclass
class Running:
    """An action at work.

    Attributes:
        body: The body.
        domains: The domains that it controls.
        begun: When it began (s).
        length: Its duration (s), or its way (m) if that counts; `None`: it ends by itself or never.
        speed: Course of the speed.
        offset: Course of the offset.
        changes_lane: The offset is a lane change.
        is_by_way: Its course counts the metres along its path, not the seconds.
        way: Points of a polyline, with times where it has some.
        is_timed: These times count.
        points: Metres from its start to each of its points.
        gap: The action that keeps a distance.
        side: 1 if the gap is behind the reference or to its left, -1 on the other side.
        relative: The action that keeps a speed relative to the reference.
        master: Of a synchronized entity: the master, the action, and the positions of both.
        driven: Metres along the path so far.
        done: It is over.
    """

    body: Body
    domains: tuple[str, ...]
    begun: float
    length: float | None
    speed: Course | None = None
    offset: Course | None = None
    changes_lane: bool = False
    is_by_way: bool = False
    way: Sequence[tuple[float, Pose]] = ()
    is_timed: bool = False
    points: list[float] = field(default_factory=list)
    gap: Element | None = None
    side: int = 1
    relative: Element | None = None
    master: tuple[Body, Element, LanePosition | Pose, LanePosition | Pose] | None = None
    driven: float = 0.0
    done: bool = False


LIMITS = (
    "maxSpeed",
    "maxAcceleration",
    "maxDeceleration",
    "maxAccelerationRate",
    "maxDecelerationRate",
)
"""Attributes of `Performance`."""


KINDS = ("Vehicle", "Pedestrian", "MiscObject")


def body_of(node: Element) -> Body:
    """Return the body that a `ScenarioObject` describes."""
    kind = next((child for child in node.children if child.tag in KINDS), None)
    if kind is None:
        raise Unplayable(f"{node.get('name')} has no size", node.place)
    centre, size = (
        kind.one(xml.BoundingBox).one(xml.Center),
        kind.one(xml.BoundingBox).one(xml.Dimensions),
    )
    half, x = 0.5 * number(size, "length"), number(centre, "x")
    performance = kind.find(xml.Performance)
    limits = {
        name: math.inf if performance is None else number(performance, name, math.inf)
        for name in LIMITS
    }
    ends, width = (half + x, half - x), number(size, "width")
    is_vehicle = kind.tag == "Vehicle"
    return Body(node.said("name"), kind.tag, *ends, width, limits, keeps_lanes=is_vehicle)


def couple(root: Element, bodies: dict[str, Body]) -> None:
    """Hang up the trailers that are coupled from the start on."""
    for described in root.below(xml.ScenarioObject):
        for trailer in described.below(xml.TrailerRef):
            hang(root, bodies[described.name], bodies[trailer.entityRef])


def hang(root: Element, tow: Body, trailer: Body) -> None:
    """Couple a trailer."""
    described = {node.said("name"): node for node in root.below(xml.ScenarioObject)}
    hitch = described[tow.name].one(xml.Vehicle).one(xml.TrailerHitch)
    coupler = described[trailer.name].one(xml.Vehicle).one(xml.TrailerCoupler)
    trailer.behind = (tow, -number(hitch, "dx"), number(coupler, "dx"))
    trailer.place = None

"""What is known of a document before the run: its map, its entities, and what lies ahead."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from osc2tx.importing.cursor import Node
from osc2tx.importing.document import Document
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element, Unresolved
from osc2tx.xosc.player.bodies import LATERAL, Body, Pose, body_of
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.places import place_of, trajectory_way
from osc2tx.xosc.player.scene import Scene
from osc2tx.xosc.player.shapes import Way, on_way
from osc2tx.xosc.player.ways import Ways
from osc2tx_runtime.opendrive import GeoReference, LanePosition, MapError, RoadMap, read_map
from osc2tx_runtime.opendrive.reader import MapContent

UNKNOWN = (Unplayable, Unresolved, MapError, ArithmeticError, ValueError, LookupError)
"""What places raise that refer to what is not there."""

NO_ROADS = RoadMap(MapContent("", "", {}, {}, (), (), (), GeoReference(), {}, ()))
"""The map of a document without one."""


class OnRoad(NamedTuple):
    """An actor in a lane at the start.

    Attributes:
        body: The actor.
        place: Its lane, and where it is in it.
        map: The map.
    """

    body: Body
    place: LanePosition
    map: RoadMap

    @property
    def direction(self) -> int:
        """The direction of travel of its lane: 1 along the road, -1 against it."""
        return self.map.travel_direction(self.place.road, self.place.lane)


class Ground:
    """What is known of a document before the run.

    Attributes:
        map: The map; `None` without it.
        bodies: The entities where they are at the start, and as fast, as far as that is known.
    """

    def __init__(self, document: Document) -> None:
        self._document = document
        self.map: RoadMap | None = None
        if document.map_file is not None:
            try:
                self.map = read_map(document.map_file)
            except MapError:
                self.map = None
        self._roads = NO_ROADS if self.map is None else self.map
        self.bodies: dict[str, Body] = {}
        self._place_bodies()
        self._put_on_ways()

    def _place_bodies(self) -> None:
        """Put the entities at their places of `Init`, references before what is beside them."""
        for element in self._document.resolved_tagged("ScenarioObject"):
            try:
                body = body_of(element)
            except UNKNOWN:
                body = Body(element.get("name") or "", "Vehicle", 3.7, 0.9, 1.9, {})
            self.bodies[body.name] = body
        waiting = {
            private.get("entityRef") or "": teleport
            for private in self._document.resolved_tagged("Private")
            for teleport in teleports(private)
        }
        for _ in range(len(waiting)):
            for name, position in list(waiting.items()):
                refs = [node.get("entityRef") for node in position.walk()]
                if any(ref in waiting and ref != name for ref in refs):
                    continue
                del waiting[name]
                found = self._static(position)
                body_ = self.bodies.get(name)
                if found is not None and body_ is not None:
                    try:
                        body_.put(self._roads, *found)
                    except UNKNOWN:
                        continue

    def _put_on_ways(self) -> None:
        """Put entities on the trajectories that they follow from the start on."""
        ways = Ways(Scene(self.bodies, self._roads, 0.0))
        for private in self._document.resolved_tagged("Private"):
            body = self.bodies.get(private.get("entityRef") or "")
            if body is None:
                continue
            body.v = speed_at_start(private)
            for node in behind_teleports(private):
                if node.tag == "FollowTrajectoryAction":
                    try:
                        run = ways.begin(body, node)
                    except UNKNOWN:
                        continue
                    if run is not None:
                        body.actions[LATERAL] = run

    def on_road(self, said: str) -> OnRoad | None:
        """Return an entity with its lane; `None`: it is in none, or there is no map."""
        body = self.bodies.get(said)
        if body is None or body.place is None or self.map is None:
            return None
        return OnRoad(body, body.place, self.map)

    # --- places -----------------------------------------------------------------------------------

    def _static(self, position: Element) -> tuple[LanePosition | Pose, float | None] | None:
        """Return the place of a resolved position at the start; `None` if it is not known."""
        try:
            return place_of(position.inner, self.bodies, self._roads)
        except UNKNOWN:
            return None

    def static_of(self, inner: Node) -> tuple[LanePosition | Pose, float | None] | None:
        """Return the place of the element below a `Position`; `None` if it is not known."""
        return self._static(Element.of((), (self.resolved(inner),)))

    def resolved(self, node: Node) -> Element:
        """Return an element with its parameters at nominal values, and catalog entries in it."""
        return self._document.resolution(node.element)

    def known(self, position: Element) -> LanePosition | Pose | None:
        """Return the place of a resolved position at the start; `None` if it is not known."""
        found = self._static(position)
        return None if found is None else found[0]

    def pose_of(self, place: LanePosition | Pose) -> Pose:
        """Return a place in the world."""
        if isinstance(place, Pose):
            return place
        return Pose(*self._roads.pose(place)[:2], 0.0)

    def coordinates(self, position: Node) -> tuple[float, float] | None:
        """Return where a place is in the world, if that is known."""
        place = self.known(self.resolved(position))
        if place is None:
            return None
        try:
            return self.pose_of(place)[:2]
        except (MapError, LookupError):
            return None

    def height(self, x: float, y: float) -> float:
        """Return the height (m) of the road at a place in the world; 0 beside all roads."""
        place = None if self.map is None else self.map.locate(x, y, max_distance=0.0)
        return 0.0 if place is None or self.map is None else self.map.pose(place).z

    def trajectory(self, node: Node, here: Pose | None = None) -> Way | None:
        """Return the corners of the trajectory in an element, if they are known.

        Args:
            node: The element.
            here: Where a curve begins that begins with its actor.
        """
        try:
            return trajectory_way(self.resolved(node), self.bodies, self._roads, here)
        except UNKNOWN:
            return None

    def ahead_of_start(self, body: Body, way: float) -> Pose:
        """Return where a body is that has gone a way (m) from its start."""
        run = body.actions.get(LATERAL)
        if run is not None and run.way:
            return on_way(run.way, run.points, run.driven + way)
        if body.place is None:
            x, y, h = body.here
            return Pose(x + way * math.cos(h), y + way * math.sin(h), h)
        ahead = self._roads.advance(body.place, way * body.along, body.route)
        return self.pose_of(ahead.position)


STRAIGHT = 1e-4  # rad
LOOK, MOST_LOOKS = 10.0, 300  # m: how a lane is looked along where it is not even


def teleports(private: Element) -> Sequence[Element]:
    """Return the place at which an entity is put, if it is."""
    actions = private.below(xml.TeleportAction)
    return [place for action in actions for place in action.all(xml.Position)][-1:]


def behind_teleports(private: Element) -> Iterator[Element]:
    """Yield the elements of a private behind its last teleport, which ends ways before it."""
    nodes = list(private.walk())
    last = max((at for at, each in enumerate(nodes) if each.tag == "TeleportAction"), default=-1)
    yield from nodes[last + 1 :]


def speed_at_start(private: Element) -> float:
    """Return the speed (m/s) that a resolved private sets; 0 if it is none by itself."""
    speeds = [each for each in private.walk() if each.tag == "AbsoluteTargetSpeed"]
    try:
        return float(speeds[-1].get("value") or 0.0) if speeds else 0.0
    except ValueError:
        return 0.0


def is_ahead(body: Body, other: Body) -> bool:
    """Whether an entity begins ahead of another one."""
    (x, y, h), there = other.here, body.here
    return (there.x - x) * math.cos(h) + (there.y - y) * math.sin(h) > 0.0


def is_straight_ahead(road_map: RoadMap | None, body: Body | None, *, beside: bool) -> bool:
    """Whether the lane of an entity leads straight on from its place at the start.

    Args:
        road_map: The map.
        body: The entity.
        beside: Whether the lanes beside it have to as well, to which it may change.
    """
    if road_map is None or body is None or body.place is None:
        return False
    try:
        return _is_straight(road_map, body.place, body, set() if beside else None)
    except (MapError, LookupError):
        return False


def _is_straight(
    road_map: RoadMap, place: LanePosition, body: Body, known: set[tuple[str, int]] | None
) -> bool:
    """Whether a lane leads straight on.

    Args:
        road_map: The map.
        place: Where the lane begins to count.
        body: The entity.
        known: The lanes that are looked along already, if those beside each one count.
    """
    heading, cursor = road_map.pose(place).h, road_map.cursor()
    for _ in range(MOST_LOOKS):
        for other in () if known is None else _beside(road_map, place, body.along, known):
            if not _is_straight(road_map, other, body, known):
                return False
        look, even = LOOK, cursor.stretch(place._replace(offset=0.0))
        if even is not None and even.curvature == 0.0:
            is_along_s = even.direction * body.along > 0
            look = max(LOOK, even.end - place.s if is_along_s else place.s - even.begin)
        ahead = road_map.advance(place, look * body.along)
        place = ahead.position
        if abs(wrapped(road_map.pose(place).h - heading)) > STRAIGHT:
            return False
        if abs(ahead.travelled) < look:
            return True
    return False


def _beside(
    road_map: RoadMap, place: LanePosition, along: int, known: set[tuple[str, int]]
) -> Iterator[LanePosition]:
    """Yield where other lanes of the same direction begin on the rest of a road, if not known.

    Those of exits begin behind the place.
    """
    known.add((place.road, place.lane))
    goes_up = road_map.travel_direction(place.road, place.lane) * along > 0
    for section in road_map.roads[place.road].sections:
        if section.end <= place.s if goes_up else section.begin > place.s:
            continue
        s = max(section.begin, place.s) if goes_up else min(section.end, place.s)
        for lane in section.lanes.values():
            is_beside = lane.id * place.lane > 0 and lane.type == "driving"
            if is_beside and (place.road, lane.id) not in known:
                known.add((place.road, lane.id))
                yield LanePosition(place.road, lane.id, s)


def wrapped(angle: float) -> float:
    """Return an angle (rad) between -pi and pi."""
    return math.atan2(math.sin(angle), math.cos(angle))

"""What is known of a document before the run: its map, and its entities at the start."""

from __future__ import annotations

import math

from osc2tx.importing.cast import bodies_of
from osc2tx.importing.cursor import Node
from osc2tx.importing.document import Document
from osc2tx.importing.starting import behind_teleports, privates, speed_at_start, teleports
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
        for element in bodies_of(self._document):
            try:
                body = body_of(element)
            except UNKNOWN:
                body = Body(element.get("name") or "", "Vehicle", 3.7, 0.9, 1.9, {})
            self.bodies[body.name] = body
        waiting = {
            private.get("entityRef") or "": teleport
            for private in privates(self._document.resolved)
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
        for private in privates(self._document.resolved):
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

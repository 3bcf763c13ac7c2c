"""Positions: where actors are at the start, and where actions and conditions take them.

A place of the map is a point of the road, of the world, or a relation to another actor. What the
language has no form for is computed where the reference is known: at the start.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import field
from itertools import pairwise

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import ANGLE, LENGTH, PRODUCT, SUM, Quantity, literal
from osc2tx.importing.document import Document
from osc2tx.importing.ground import Ground
from osc2tx.importing.names import Names
from osc2tx.importing.program import declaration
from osc2tx.importing.starting import STRAIGHT, privates, teleports, wrapped
from osc2tx.importing.values import Values
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element, Unresolved
from osc2tx.xosc.player.bodies import Pose
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.places import waypoints
from osc2tx_runtime.opendrive import LanePosition, MapError
from osc2tx_shared.classes import dataclass


@dataclass
class Spot:
    """A place in the language.

    Attributes:
        argument: `position: p` or `odr_point: …` of `assign_position`; `""`: only modifiers say it.
        modifiers: Modifiers that say it, without their `at`.
        yaw: A modifier for the heading, where it is not that of the lane.
    """

    argument: str = ""
    modifiers: list[str] = field(default_factory=list)
    yaw: str = ""


class Places(Ground):
    """Positions of a document.

    Attributes:
        lines: Declarations of the points in the world.
    """

    def __init__(
        self, document: Document, values: Values, names: Names, actors: dict[str, str]
    ) -> None:
        super().__init__(document)
        self._values, self._names = values, names
        self._actors = actors
        self.lines: list[str] = []
        self._declared: dict[tuple[float, float], str] = {}

    # --- forms ------------------------------------------------------------------------------------

    def spot(self, position: Node, name: str, *, at_start: bool) -> Spot | None:
        """Return a place in the language; `None`, with a finding, if there is none.

        Args:
            position: `Position`.
            name: The actor that it is for, for names of points.
            at_start: Whether it counts at the start, when the places of others are known.
        """
        inner = position.inner
        if inner.tag == "LanePosition":
            return self._lane(inner)
        if inner.tag == "RoadPosition":
            return self._road(inner)
        if inner.tag == "RelativeLanePosition":
            found = self._beside(inner, name, at_start)
            if found is None and at_start:
                found = self._beside_in_road(inner)
            if found is not None:
                return found
        if inner.tag == "WorldPosition" or at_start:
            found = self._known(position, name)
            if found is not None:
                return found
        inner.leave_out(
            "the language has no form for this place, and it is not known before the run"
        )
        return None

    def _lane(self, node: Node) -> Spot:
        road, lane = self._values.text(node, "roadId"), self._values.text(node, "laneId")
        s = self._values.quantity(node, "s", LENGTH)
        t = self._values.quantity(node, "offset", LENGTH)
        lane = str(int(float(lane))) if lane.replace(".", "").lstrip("-").isdigit() else lane
        text = _odr_point(road, lane, s.text, t.text)
        direction = 0.0
        if self.map is not None and road in self.map.roads:
            try:
                along = self.map.travel_direction(road, int(lane))
                direction = self.map.pose(LanePosition(road, int(lane), s.value)).h
                direction += math.pi if along < 0 else 0.0
            except (MapError, LookupError, ValueError, AttributeError):
                along = 1
        else:
            along = -1 if lane.lstrip("-").isdigit() and int(lane) > 0 else 1
        return Spot(text, yaw=self._yaw(node, direction, 0.0 if along > 0 else math.pi))

    def _yaw(self, node: Node, road: float, of_lane: float) -> str:
        """Return the modifier for an orientation, given those of road and lane."""
        orientation = node.find("Orientation")
        if orientation is None:
            return ""
        kind = orientation.text("type") or "absolute"
        for name in ("p", "r"):
            if abs(self._values.nominal(orientation, name)) > 1e-6:
                orientation.approximate(f"{name} is that of the road here")
        h = self._values.nominal(orientation, "h")
        turned = h - of_lane if kind == "relative" else h - road - of_lane
        turned = wrapped(turned)
        if abs(turned) < STRAIGHT:
            return ""
        return f"yaw({literal(round(turned, 9), ANGLE)})"

    def _road(self, node: Node) -> Spot:
        road = self._values.text(node, "roadId")
        s, t = (self._values.quantity(node, name, LENGTH) for name in ("s", "t"))
        text = _odr_point(road, "", s.text, t.text)
        node_pose = None
        if self.map is not None and road in self.map.roads:
            try:
                node_pose = self.map.road_pose(road, s.value, t.value)
            except (MapError, LookupError, ValueError):
                node_pose = None
        if node_pose is None:
            return Spot(text, yaw=self._yaw(node, 0.0, 0.0))
        found = self.static_of(node)
        h = found[1] if found is not None and found[1] is not None else node_pose.h
        node.find("Orientation") and node.find("Orientation").use_all()  # type: ignore[union-attr]
        return Spot(text, yaw=_absolute(h))

    def _beside(self, node: Node, name: str, at_start: bool) -> Spot | None:
        """Return a place in lanes and metres beside another actor."""
        said = node.said("entityRef")
        reference = self._actors.get(said)
        if reference is None or node.find("Orientation") is not None:
            return None
        lanes = int(self._values.nominal(node, "dLane"))
        if abs(self._values.nominal(node, "offset")) > 1e-9:
            return None
        body, found = self.bodies.get(said), self.static_of(node)
        direction = 1
        if self.map is not None and at_start:
            if (
                body is None
                or body.pose is None
                or found is None
                or not isinstance(found[0], LanePosition)
            ):
                return None
            theirs, ours = body.in_lane(self.map), found[0]
            directions = [
                self.map.travel_direction(each.road, each.lane) for each in (theirs, ours)
            ]
            if theirs.road != ours.road or len(set(directions)) > 1 or body.along < 0:
                return None
            direction = directions[0]
        along = "dsLane" if node.has("dsLane") else "ds"
        ahead = self._values.quantity(node, along, LENGTH)
        side = "ahead_of" if direction > 0 or along == "dsLane" else "behind"
        if not ahead.is_open and ahead.value < 0.0:
            ahead = Quantity(literal(-ahead.value, LENGTH), -ahead.value)
            side = {"ahead_of": "behind", "behind": "ahead_of"}[side]
        modifiers = [
            self._beside_lane(node, reference, lanes),
            f"position({ahead.text}, {side}: {reference})",
        ]
        return Spot(modifiers=modifiers)

    def _beside_in_road(self, node: Node) -> Spot | None:
        """Return a place on the road of another actor, whose own place says where that is."""
        said = node.said("entityRef")
        body, found = self.bodies.get(said), self.static_of(node)
        start = self._start_of(said)
        if body is None or body.place is None or found is None or start is None:
            return None
        place, own = found[0], body.place
        if not isinstance(place, LanePosition) or start.tag != "LanePosition":
            return None
        assert self.map is not None
        s = self._values.quantity(node.other(start), "s", LENGTH)
        along = "dsLane" if node.has("dsLane") else "ds"
        ahead = self._values.quantity(node, along, LENGTH)
        direction = self.map.travel_direction(own.road, own.lane) * body.along
        sign = 1 if along == "ds" else direction
        if place.road != own.road or abs(s.value + sign * ahead.value - place.s) > 1e-6:
            return None
        if (node.text("dLane") or "0").startswith("$"):
            node.approximate(f"dLane keeps the nominal value of `{node.text('dLane')}`")
        offset = self._values.quantity(node, "offset", LENGTH)
        t = offset.text if direction > 0 else f"-{offset.within(PRODUCT)}"
        way = f"{s.within(SUM)} {'+' if sign > 0 else '-'} {ahead.within(PRODUCT)}"
        if not (s.is_open or ahead.is_open):
            way = literal(place.s, LENGTH)
        heading = found[1]
        return Spot(
            _odr_point(place.road, str(place.lane), way, t),
            yaw="" if heading is None else _absolute(heading),
        )

    def _start_of(self, said: str) -> Element | None:
        """Return the element of the place at which an entity is put at the start."""
        return next(
            (
                position.inner
                for private in privates(self._document.root)
                if private.get("entityRef") == said
                for position in teleports(private)
            ),
            None,
        )

    def at_gap(self, node: Node, said: str, reference: str, way: str) -> Spot | None:
        """Return the place along the road of another entity, as far aside as it was put before.

        Args:
            node: The action that says the gap.
            said: The entity.
            reference: The other one, in the same lane.
            way: How far the entity is ahead, along the road.
        """
        body, start, own = self.bodies[said], self._start_of(reference), self._start_of(said)
        if body.place is None or start is None or own is None or start.tag != "LanePosition":
            return None
        assert self.map is not None
        s = self._values.quantity(node.other(start), "s", LENGTH)
        offset = self._values.quantity(node.other(own), "offset", LENGTH)
        direction = self.map.travel_direction(body.place.road, body.place.lane) * body.along
        is_left = own.tag == "LanePosition" or direction > 0
        t = offset.text if is_left else f"-{offset.within(PRODUCT)}"
        way = f"{s.within(SUM)} {'+' if direction > 0 else '-'} {way}"
        return Spot(_odr_point(body.place.road, str(body.place.lane), way, t))

    def _beside_lane(self, node: Node, reference: str, lanes: int) -> str:
        text = node.text("dLane") or "0"
        parameter = self._values.parameters.get(text[1:]) if text.startswith("$") else None
        if (
            parameter is not None
            and lanes != 0
            and parameter.kind != "double"
            and parameter.expression is not None
        ):
            parameter.is_used = True
            p = parameter.name
            return f"lane({p} > 0 ? {p} : -{p}, side_of: {reference}, side: {p} > 0 ? left : right)"
        if text.startswith("$"):
            node.approximate(f"dLane keeps the nominal value of `{text}`")
        if lanes == 0:
            return f"lane(same_as: {reference})"
        count = "" if abs(lanes) == 1 else f"{abs(lanes)}, "
        return f"lane({count}side_of: {reference}, side: {'left' if lanes > 0 else 'right'})"

    def _known(self, position: Node, name: str) -> Spot | None:
        """Return a place that is known: a point of a road, or of the world."""
        inner = position.inner
        found = self.static_of(inner)
        if found is None:
            return None
        for element in inner.element.walk():
            if any(text.startswith("$") for _, text in element.attributes):
                inner.approximate("it keeps the place that its nominal values give")
                break
        inner.use_all()
        where, heading = found
        if isinstance(where, LanePosition) and self.map is not None:
            t = where.offset * self.map.travel_direction(where.road, where.lane)
            at = literal(where.s, LENGTH), literal(t, LENGTH)
            text = _odr_point(where.road, str(where.lane), *at)
            return Spot(text, yaw="" if heading is None else _absolute(heading))
        assert isinstance(where, Pose)
        point = self.point(where.x, where.y, name)
        h = where.h if heading is None else heading
        return Spot(f"position: {point}", yaw=_absolute(h))

    def point(self, x: float, y: float, name: str) -> str:
        """Return the name of a point in the world."""
        key = (round(x, 6), round(y, 6))
        if key not in self._declared:
            made = self._names.new("", kind="point", base=f"{name}_point")
            told = [
                f"it.{axis} == {literal(v, LENGTH)}"
                for axis, v in zip("xyz", (*key, 0.0), strict=True)
            ]
            self.lines += declaration(made, "position_3d", [" and ".join(told)])
            self._declared[key] = made
        return self._declared[key]

    def pose(self, x: float, y: float, name: str) -> str:
        """Return the name of a pose in the world, of a corner of a path."""
        made = self._names.new("", kind="point", base=f"{name}_pose")
        told = [
            f"it.position.{axis} == {literal(round(v, 6), LENGTH)}"
            for axis, v in zip("xyz", (x, y, 0.0), strict=True)
        ]
        self.lines += declaration(made, "pose_3d", [" and ".join(told)])
        return made

    def corners(self, trajectory: Node) -> list[str]:
        """Return the points of the map that a trajectory leads along; none if others are in it."""
        found = []
        for vertex in self.resolved(trajectory).below(xml.Vertex):
            place = self.known(vertex.one(xml.Position))
            if not isinstance(place, LanePosition) or self.map is None:
                return []
            t = place.offset * self.map.travel_direction(place.road, place.lane)
            at = literal(round(place.s, 6), LENGTH), literal(round(t, 6), LENGTH)
            found.append(_odr_point(place.road, str(place.lane), *at).partition(": ")[2])
        return found

    def stops_of(self, route: Node) -> list[LanePosition]:
        """Return the waypoints of a route in lanes; none if they are not known."""
        try:
            assert self.map is not None
            return waypoints(self._document._resolve(route.element), self.bodies, self.map)
        except (Unplayable, Unresolved, MapError, ValueError, LookupError, AssertionError):
            return []

    def is_way(self, stops: Sequence[LanePosition]) -> bool:
        """Whether a lane leads from each place to the next one."""
        road_map = self.map
        if road_map is None:
            return False
        ways = (road_map.route_distance(a, b) for a, b in pairwise(stops))
        return all(way is not None and way > 0.0 for way in ways)

    def leads_on(self, start: LanePosition, goal: LanePosition) -> bool:
        """Whether a lane leads to a place without a choice of branches."""
        assert self.map is not None
        length = self.map.route_distance(start, goal)
        there = self.map.advance(start, length or 0.0).position
        return there[:2] == goal[:2] and abs(there.s - goal.s) < 1.0

    def way(self, stops: Sequence[LanePosition], name: str) -> str:
        """Return the name of a route for an actor."""
        made = self._names.new("", kind="route", base=f"{name}_way")
        points = ", ".join(
            _odr_point(each.road, str(each.lane), literal(each.s, LENGTH), "0m").partition(": ")[2]
            for each in stops
        )
        self.lines.append(f"{made}: route = road.create_route([{points}])")
        return made


def _odr_point(road: str, lane: str, s: str, t: str) -> str:
    point = f'road_id: "{road}", lane_id: "{lane}", s: {s}, t: {t}'
    return f"odr_point: road.create_odr_point({point})"


def _absolute(h: float) -> str:
    return f"orientation(yaw: {literal(round(wrapped(h), 9), ANGLE)}, measure_by: absolute)"

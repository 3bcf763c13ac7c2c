"""Positions: where actors are at the start, and where actions and conditions take them.

A place of the map is a point of the road, of the world, or a relation to another actor. What the
language has no form for is computed where the reference is known: at the start.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx.importing.beside import Beside
from osc2tx.importing.courses import Courses
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import LENGTH, literal
from osc2tx.importing.document import Document
from osc2tx.importing.ground import STRAIGHT, Ground, wrapped
from osc2tx.importing.names import Names
from osc2tx.importing.points import Points, Spot, degrees, heading_of, odr_point, point_of
from osc2tx.importing.values import Values
from osc2tx.xosc.player.bodies import Pose
from osc2tx.xosc.player.places import offset_of
from osc2tx_runtime.opendrive import LanePosition, MapError


class Places(Ground):
    """Positions of a document.

    Attributes:
        points: The points that are declared.
        beside: Places that are told by other actors.
        courses: Where routes and trajectories lead.
    """

    def __init__(
        self, document: Document, values: Values, names: Names, actors: Mapping[str, str]
    ) -> None:
        super().__init__(document)
        self._values = values
        self.points = Points(names)
        self.beside = Beside(self, document, values, actors)
        self.courses = Courses(self, values)

    def spot(self, position: Node, name: str, *, at_start: bool) -> Spot | None:
        """Return a place in the language; `None`, with a finding, if there is none.

        Args:
            position: `Position`.
            name: The actor that it is for, for names of points.
            at_start: Whether it counts at the start, when the places of others are known.
        """
        inner = position.inner
        if inner.tag == "LanePosition":
            return self._lane(inner, name)
        if inner.tag == "RoadPosition":
            return self._road(inner)
        if inner.tag == "RelativeLanePosition":
            found = self.beside.in_lanes(inner, at_start=at_start)
            if found is None and at_start:
                found = self.beside.in_road(inner)
            if found is not None:
                return found
        if inner.tag == "RelativeRoadPosition" and at_start:
            found = self._along_road(inner)
            if found is not None:
                return found
        if inner.tag == "WorldPosition" or at_start:
            found = self._known(position, name)
            if found is not None:
                return found
        inner.leave_out("the DSL has no form of this position, and it is not known before the run")
        return None

    def _lane(self, node: Node, name: str) -> Spot:
        road, lane = self._values.text(node, "roadId"), self._values.text(node, "laneId")
        s = self._values.quantity(node, "s", LENGTH)
        t = self._values.quantity(node, "offset", LENGTH)
        lane = str(int(float(lane))) if lane.replace(".", "").lstrip("-").isdigit() else lane
        text = odr_point(road, lane, s.text, t.text)
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
        of_lane = 0.0 if along > 0 else math.pi
        turn = self._turn(node, direction, of_lane)
        if self.map is None or abs(turn) <= 0.5 * math.pi:
            return Spot(text, yaw=_yaw(turn))
        aside = self._against(LanePosition(road, int(lane), s.value, t.value * along))
        if aside is not None:
            return Spot(odr_point(road, str(aside[0]), s.text, literal(aside[1], LENGTH)))
        heading = direction + of_lane + turn
        return Spot(text, yaw=_yaw(turn), turned=self.points.orientation(heading, name))

    def _along_road(self, node: Node) -> Spot | None:
        """Return a place on the road of another actor, in its direction or against it."""
        found = self.beside.along_road(node)
        if found is None:
            return None
        place, s, heading = found
        assert self.map is not None
        along = self.map.travel_direction(place.road, place.lane)
        lane, across = place.lane, place.offset * along
        turn = wrapped(heading - self.map.pose(place).h - (math.pi if along < 0 else 0.0))
        if abs(turn) > STRAIGHT:
            aside = self._against(place)
            if aside is None or abs(abs(turn) - math.pi) > STRAIGHT:
                return None
            lane, across = aside
        node.use_all()
        return Spot(odr_point(place.road, str(lane), s, literal(round(across, 6), LENGTH)))

    def _against(self, place: LanePosition) -> tuple[int, float] | None:
        """Return the innermost lane of oncoming traffic, and the offset (m) from it of a position.

        An actor that drives against its lane belongs to the lane of its direction. `None`: the
        road has no such lane there.
        """
        assert self.map is not None
        along = self.map.travel_direction(place.road, place.lane)
        lanes = self.map.roads[place.road].section_at(place.s).lanes.values()
        like = next((each.id for each in lanes if each.direction == -along), None)
        oncoming = () if like is None else self.map.lanes(place.road, place.s, like=like)
        if not oncoming:
            return None
        lane, at = place._replace(lane=oncoming[-1]), self.map.pose(place)
        return lane.lane, -along * offset_of(self.map, lane, Pose(at.x, at.y, at.h))

    def _turn(self, node: Node, road: float, of_lane: float) -> float:
        """Return how an orientation is turned (rad) from that of the lane.

        Args:
            node: The position with the orientation.
            road: Heading (rad) of the road, in the direction of s.
            of_lane: Heading (rad) of the lane from that of the road.
        """
        orientation = node.find("Orientation")
        if orientation is None:
            return 0.0
        kind = orientation.text("type") or "absolute"
        for name in ("p", "r"):
            if abs(self._values.nominal(orientation, name)) > 1e-6:
                orientation.approximate(f"{name} is that of the road here")
        h = self._values.nominal(orientation, "h")
        turned = h - of_lane if kind == "relative" else h - road - of_lane
        return wrapped(turned)

    def _road(self, node: Node) -> Spot:
        road = self._values.text(node, "roadId")
        s, t = (self._values.quantity(node, name, LENGTH) for name in ("s", "t"))
        text = odr_point(road, "", s.text, t.text)
        node_pose = None
        if self.map is not None and road in self.map.roads:
            try:
                node_pose = self.map.road_pose(road, s.value, t.value)
            except (MapError, LookupError, ValueError):
                node_pose = None
        if node_pose is None:
            return Spot(text, yaw=_yaw(self._turn(node, 0.0, 0.0)))
        found = self.static_of(node)
        h = found[1] if found is not None and found[1] is not None else node_pose.h
        orientation = node.find("Orientation")
        if orientation is not None:
            orientation.use_all()
        return Spot(text, yaw=heading_of(h))

    def _known(self, position: Node, name: str) -> Spot | None:
        """Return a place that is known: a point of a road, or of the world."""
        inner = position.inner
        found = self.static_of(inner)
        if found is None:
            return None
        for element in inner.element.walk():
            if any(text.startswith("$") for _, text in element.attributes):
                inner.approximate("its position is that of its nominal values")
                break
        inner.use_all()
        where, heading = found
        if isinstance(where, LanePosition) and self.map is not None:
            text = point_of(where, self.map)
            return Spot(text, yaw="" if heading is None else heading_of(heading))
        assert isinstance(where, Pose)
        pose = where if heading is None else where._replace(h=heading)
        in_lane = self._in_lane(pose)
        if in_lane:
            return Spot(in_lane)
        return Spot(position=self.points.point(*pose[:2], name), yaw=heading_of(pose.h))

    def _in_lane(self, pose: Pose) -> str:
        """Return a point of the map that is a place in the world, with its heading; `""`: none."""
        points = self.courses.on_map([pose])
        if not points or self.map is None:
            return ""
        lane = self.map.locate(pose.x, pose.y, heading=pose.h)
        assert lane is not None
        is_along = abs(wrapped(self.map.pose(lane).h - pose.h)) < STRAIGHT
        return points[0] if is_along else ""


def _yaw(turn: float) -> str:
    """Return the modifier for a turn (rad) from the direction of the lane; `""`: there is none."""
    return "" if abs(turn) < STRAIGHT else f"yaw({degrees(turn)})"

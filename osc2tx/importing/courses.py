"""Routes and trajectories on the map."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import LENGTH, literal
from osc2tx.importing.ground import UNKNOWN, Ground
from osc2tx.importing.points import odr_point, point_of
from osc2tx.importing.values import Values
from osc2tx.xosc import elements as xml
from osc2tx.xosc.player.bodies import Body, Pose
from osc2tx.xosc.player.places import waypoints
from osc2tx.xosc.player.shapes import Way, lengths_of
from osc2tx_runtime.opendrive import LanePosition

MILLIMETRES = 2e-3  # m: how near a point of the map has to be to the place that it stands for
MOST_IN_CALL = 100
"""Points in a call; each of more has a name of its own."""
ROUNDING = 1e-6  # m
SPARSE = 0.05  # m: a corner that is nearer to the line between others is left out
LAST = 0.5
"""m: length of the last chord of a curve."""


def sparse(poses: Sequence[Pose]) -> list[Pose]:
    """Return the corners that a polyline needs to lead along all of them."""
    if len(poses) < 3:
        return list(poses)
    (x, y, _), (to_x, to_y, _) = poses[0], poses[-1]
    length = math.hypot(to_x - x, to_y - y)
    off = [
        (
            abs((each.x - x) * (to_y - y) - (each.y - y) * (to_x - x)) / length
            if length > SPARSE
            else math.dist(each[:2], (x, y))
        )
        for each in poses[1:-1]
    ]
    worst = max(range(len(off)), key=off.__getitem__)
    if off[worst] <= SPARSE:
        return [poses[0], poses[-1]]
    return [*sparse(poses[: worst + 2])[:-1], *sparse(poses[worst + 1 :])]


def of_curve(way: Way) -> Way:
    """Return the corners that a polyline needs to lead along a curve.

    The last chord is short and has the direction of the end, in which an actor leaves the curve.
    """
    kept, lengths = {id(pose) for pose in sparse([pose for _, pose in way])}, lengths_of(way)
    if lengths[-1] <= LAST:
        return [corner for corner in way if id(corner[1]) in kept]
    found = [
        corner
        for corner, length in zip(way, lengths, strict=True)
        if id(corner[1]) in kept and length < lengths[-1] - LAST
    ]
    end, goal = way[-1]
    x, y = goal.x - LAST * math.cos(goal.h), goal.y - LAST * math.sin(goal.h)
    return [*found, (end, Pose(x, y, goal.h)), way[-1]]


class Courses:
    """Finds out where routes and trajectories lead."""

    def __init__(self, ground: Ground, values: Values) -> None:
        self._ground, self._values = ground, values

    def corners(self, trajectory: Node) -> list[str]:
        """Return the points of the map that a trajectory leads along; none if others are in it.

        What varies from run to run stands in them.
        """
        found = []
        given = self._values.document.given(trajectory.element, xml.Vertex)
        for raw, vertex in zip(
            given, self._ground.resolved(trajectory).below(xml.Vertex), strict=True
        ):
            place = self._ground.known(vertex.one(xml.Position))
            if not isinstance(place, LanePosition) or self._ground.map is None:
                return []
            length = self._ground.map.roads[place.road].length
            if not -ROUNDING <= place.s <= length + ROUNDING:
                return []
            place = place._replace(s=round(place.s, 6), offset=round(place.offset, 6))
            varied = self._varied(trajectory.other(raw.one(xml.Position).inner))
            found.append(varied or point_of(place, self._ground.map))
        return found

    def is_nominal(self, trajectory: Node) -> bool:
        """Whether parameters give a part of a trajectory that does not follow them."""
        vertices = list(self._values.document.given(trajectory.element, xml.Vertex))
        for part in vertices or [trajectory.element]:
            starts = [text[:1] for each in part.walk() for _, text in each.attributes]
            if "$" in starts and not (
                vertices and self._varied(trajectory.other(part.one(xml.Position).inner))
            ):
                return True
        return False

    def _varied(self, place: Node) -> str:
        """Return a point of the map whose place varies from run to run; `""`: it does not."""
        across = {"LanePosition": "offset", "RoadPosition": "t"}.get(place.tag, "")
        if not across or not any(self._values.varies(place, name) for name in ("s", across)):
            return ""
        lane = self._values.text(place, "laneId") if place.has("laneId") else ""
        s, t = (self._values.quantity(place, name, LENGTH).text for name in ("s", across))
        return odr_point(self._values.text(place, "roadId"), lane, s, t)

    def along_road(self, trajectory: Node, body: Body) -> list[str]:
        """Return the points that a trajectory leads along on the road of an entity beside it.

        Their s counts from the entity. None if others are in it.
        """
        found = []
        for vertex in self._ground.resolved(trajectory).below(xml.Vertex):
            position = vertex.one(xml.Position)
            place = self._ground.known(position)
            if position.inner.tag != "RelativeLanePosition" or body.place is None:
                return []
            if not isinstance(place, LanePosition) or place.road != body.place.road:
                return []
            assert self._ground.map is not None
            t = place.offset * self._ground.map.travel_direction(place.road, place.lane)
            s = literal(round(place.s - body.place.s, 6), LENGTH)
            found.append(odr_point("", str(place.lane), s, literal(round(t, 6), LENGTH)))
        return found

    def offsets(self, trajectory: Node, said: str) -> list[tuple[float, float] | None]:
        """Return how far (m) corners are ahead and left of where their own actor begins them.

        Args:
            trajectory: The trajectory.
            said: The entity that follows it; `None` stands for corners somewhere else.
        """
        found: list[tuple[float, float] | None] = []
        for vertex in self._ground.resolved(trajectory).below(xml.Vertex):
            inner = vertex.one(xml.Position).inner
            is_own = inner.tag == "RelativeObjectPosition" and inner.get("entityRef") == said
            if not is_own or inner.children:
                found.append(None)
                continue
            found.append((float(inner.get("dx") or 0.0), float(inner.get("dy") or 0.0)))
        return found

    def on_map(self, poses: Sequence[Pose]) -> list[str]:
        """Return the points of the map at some places; none if one of them is beside all lanes."""
        found: list[str] = []
        if len(poses) > MOST_IN_CALL:
            return []
        road_map = self._ground.map
        for pose in poses if road_map is not None else ():
            assert road_map is not None
            place = road_map.locate(pose.x, pose.y, heading=pose.h)
            if place is None:
                return []
            end = math.floor(1e3 * road_map.roads[place.road].length) / 1e3
            place = place._replace(s=min(round(place.s, 3), end), offset=round(place.offset, 3))
            there = road_map.pose(place)
            if math.dist(there[:2], pose[:2]) > MILLIMETRES:
                return []
            found.append(point_of(place, road_map))
        return found

    def stops_of(self, route: Node) -> list[LanePosition]:
        """Return the waypoints of a route in lanes; none if they are not known."""
        if self._ground.map is None:
            return []
        try:
            return waypoints(self._ground.resolved(route), self._ground.bodies, self._ground.map)
        except UNKNOWN:
            return []

    def is_way(self, stops: Sequence[LanePosition]) -> bool:
        """Whether a lane leads from each place to the next one."""
        road_map = self._ground.map
        if road_map is None:
            return False
        ways = (road_map.route_distance(a, b) for a, b in pairwise(stops))
        return all(way is not None and way > 0.0 for way in ways)

    def reached(self, start: LanePosition, goal: LanePosition) -> LanePosition:
        """Return the end of a route in the lane that leads there: a route changes no lanes."""
        road_map = self._ground.map
        assert road_map is not None
        length = road_map.route_distance(start, goal) or 0.0
        there = road_map.advance(start, length, road_map.route_to(goal)).position
        return goal._replace(lane=there.lane) if there.road == goal.road else goal

    def leads_on(self, start: LanePosition, goal: LanePosition) -> bool:
        """Whether a lane leads to a place without a choice of branches."""
        assert self._ground.map is not None
        length = self._ground.map.route_distance(start, goal)
        there = self._ground.map.advance(start, length or 0.0).position
        return there[:2] == goal[:2] and abs(there.s - goal.s) < 1.0

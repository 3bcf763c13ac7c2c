"""Conditions on the distance of an actor to a place."""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import LENGTH, PRODUCT, SUM, TIME, Quantity, literal, total
from osc2tx.importing.effects import Reader
from osc2tx.xosc.player.distances import asked
from osc2tx_runtime.opendrive import LanePosition

COMPARISONS: Mapping[str, str] = {
    "greaterThan": ">",
    "lessThan": "<",
    "greaterOrEqual": ">=",
    "lessOrEqual": "<=",
    "equalTo": "==",
    "notEqualTo": "!=",
}
MIRRORED: Mapping[str, str] = {">": "<", "<": ">", ">=": "<=", "<=": ">=", "==": "==", "!=": "!="}
ANYWHERE = 1000.0  # m: so far away is only what tells the side of something else
ROUNDING = 1e-6  # m


class PlaceConditions(Reader):
    """Reads conditions on the distance to a place."""

    def reached(self, node: Node, a: str) -> str | None:
        """Return the condition that an actor is at a place."""
        point = self._point(node, a)
        if point is None:
            return None
        within = self._values.quantity(node, "tolerance", LENGTH)
        return f"{a}.distance_to_xyz_point({point}, euclidean) <= {within.within(SUM)}"

    def in_time(self, node: Node, target: Node, a: str) -> str | None:
        """Return the condition on the time until an actor is at a place, at its speed."""
        point = self._point(target, a)
        if point is None:
            return None
        node.approximate("the distance to a position is the Euclidean one")
        time = self._values.quantity(node, "value", TIME).within(PRODUCT)
        measure = f"{a}.distance_to_xyz_point({point}, euclidean{boxes(node)})"
        return f"{measure} {COMPARISONS[node.said('rule')]} {time} * {a}.speed"

    def far(self, node: Node, actor: Actor) -> str | None:
        """Return the condition on how far an actor is from a place."""
        for name in ("coordinateSystem", "alongRoute", "routingAlgorithm", "relativeDistanceType"):
            node.text(name)
        kind, system = asked(self._places.resolved(node))
        if kind == "longitudinal" and system in ("road", "lane"):
            found = self._along_road(node, actor)
        elif kind in ("longitudinal", "lateral") and system == "entity":
            found = self._beside_another(node, actor, kind)
        else:
            found = None
        if found is not None:
            return found
        point = self._point(node, actor.name)
        if point is None:
            return None
        if kind in ("longitudinal", "lateral"):
            node.approximate("the distance to a position is the Euclidean one")
        value = self._values.quantity(node, "value", LENGTH)
        measure = f"{actor.name}.distance_to_xyz_point({point}, euclidean{boxes(node)})"
        return f"{measure} {COMPARISONS[node.said('rule')]} {value.within(SUM)}"

    def _point(self, node: Node, a: str) -> str | None:
        """Return the point of the world in a condition; `None`, with a finding: it is not known."""
        found = self._places.coordinates(node.one("Position"))
        if found is None:
            node.leave_out("the position is not known before the run; it is never met here")
            return None
        self._take_place(node)
        return self._places.points.goal(*found, self._places.height(*found), a)

    @staticmethod
    def _take_place(node: Node) -> None:
        position = node.one("Position")
        position.use_all()
        if any(text.startswith("$") for e in position.element.walk() for _, text in e.attributes):
            node.approximate("the position is that of its nominal values")

    # --- places on a road -------------------------------------------------------------------------

    def _along_road(self, node: Node, actor: Actor) -> str | None:
        """Return the condition on s, for an actor on the road of the place."""
        here, place = self._on_road(actor), self._s_of(node.one("Position"))
        if here is None or place is None or boxes(node) or place[0] != here.place.road:
            return None
        self._take_place(node)
        road, begin = place
        sign, value = COMPARISONS[node.said("rule")], self._values.quantity(node, "value", LENGTH)
        at = Quantity(literal(round(begin, 6), LENGTH), begin)
        beyond, before = total(LENGTH, (1, at), (1, value)), total(LENGTH, (1, at), (-1, value))
        direction = here.direction * here.body.along
        apart = (here.place.s - begin) * direction
        s = f"{actor.name}.get_s_coord()"
        up = f"{s} {sign} {beyond.within(SUM)}"
        down = f"{s} {MIRRORED[sign]} {before.within(SUM)}"
        if begin < ROUNDING or (sign.startswith(">") and apart >= 0.0 and direction > 0):
            return up  # it never is on the other side
        if begin > here.map.roads[road].length - ROUNDING:
            return down
        if sign.startswith(">") and apart >= 0.0:
            return down
        if sign.startswith("<") and -apart > value.value:
            return down if direction > 0 else up  # it is met before the actor is there
        return f"{up} {'and' if sign.startswith('<') else 'or'} {down}"

    def _s_of(self, node: Node) -> tuple[str, float] | None:
        """Return the road of a position, and how far along it is (m)."""
        position = self._places.resolved(node)
        if position.inner.tag == "RoadPosition":
            return position.inner.said("roadId"), float(position.inner.said("s"))
        place = self._places.known(position)
        return (place.road, place.s) if isinstance(place, LanePosition) else None

    # --- places beside another actor --------------------------------------------------------------

    def _beside_another(self, node: Node, actor: Actor, kind: str) -> str | None:
        """Return the condition on the distance of another actor, far beyond which the place is.

        XML measures without signs; a place that is far beyond gives the distance one.
        """
        position = self._places.resolved(node.one("Position")).inner
        body, other = self._body(actor), self._actors.get(position.get("entityRef") or "")
        if position.tag != "RelativeWorldPosition" or body is None or other is None:
            return None
        if body.pose is None or boxes(node):
            return None
        dx, dy = float(position.get("dx") or 0.0), float(position.get("dy") or 0.0)
        h = body.pose.h + (0.5 * math.pi if kind == "lateral" else 0.0)
        shift = dx * math.cos(h) + dy * math.sin(h)
        value = self._values.quantity(node, "value", LENGTH)
        if abs(shift) < ANYWHERE or value.is_open:
            return None
        self._take_place(node)
        if actor.kind == "vehicle":
            node.approximate("the heading of the actor is that of its start")
        sign, limit = COMPARISONS[node.said("rule")], value.value - abs(shift)
        if shift < 0.0:
            sign, limit = MIRRORED[sign], -limit
        text = literal(round(limit, 3) + 0.0, LENGTH)
        return f"{actor.name}.object_distance({other.name}, {kind}) {sign} {text}"


def boxes(node: Node, name: str = "freespace") -> str:
    """Return the argument with which a distance counts between boxes; `""`: it does not."""
    return ", bounding_boxes" if node.is_true(name) else ""

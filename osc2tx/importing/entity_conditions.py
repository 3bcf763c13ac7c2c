"""Conditions on entities as expressions."""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import (
    ACCELERATION,
    LENGTH,
    PRODUCT,
    SPEED,
    SUM,
    TIME,
    Dimension,
    literal,
)
from osc2tx.importing.places import Places
from osc2tx.importing.values import Values
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.player.distances import asked

COMPARISONS: Mapping[str, str] = {
    "greaterThan": ">",
    "lessThan": "<",
    "greaterOrEqual": ">=",
    "lessOrEqual": "<=",
    "equalTo": "==",
    "notEqualTo": "!=",
}
STANDING = 0.01  # m/s
ANYWHERE = 1000.0  # m: a clearance of that size only asks for the side


class EntityConditions:
    """Reads conditions on entities."""

    def __init__(self, values: Values, places: Places, actors: Mapping[str, Actor]) -> None:
        self._values, self._places, self._actors = values, places, actors

    def expression(self, node: Node, said: str, a: str) -> str | None:
        """Return the expression of a condition on an actor; `None`, with a finding, if none."""
        match node.tag:
            case "SpeedCondition":
                if node.text("direction") not in (None, "longitudinal"):
                    node.leave_out("the language has no speed in this direction")
                    return None
                return self._compared(node, f"{a}.speed", SPEED)
            case "RelativeSpeedCondition":
                node.text("direction")
                b = self._actor(node)
                value = self._values.quantity(node, "value", SPEED)
                sign = COMPARISONS[node.said("rule")]
                if not value.is_open and value.value == 0.0:
                    return f"{a}.speed {sign} {b}.speed"
                return f"{a}.speed - {b}.speed {sign} {value.within(SUM)}"
            case "AccelerationCondition":
                node.text("direction")
                return self._compared(node, f"{a}.acceleration.translational.x", ACCELERATION)
            case "RelativeDistanceCondition":
                return self._distance(node, said, a)
            case "TimeHeadwayCondition":
                return self._headway(node, said, a)
            case "TimeToCollisionCondition":
                return self._collision_time(node, said, a)
            case "TraveledDistanceCondition":
                return self._travelled(node, said, a)
            case "ReachPositionCondition" | "DistanceCondition":
                return self._at_place(node, said, a)
            case "StandStillCondition":
                if self._values.nominal(node, "duration") > 0.0:
                    node.approximate("a time of standing still begins with the first such instant")
                return f"{a}.speed < {literal(STANDING, SPEED)}"
            case "CollisionCondition":
                return self._collision(node, a)
            case "RelativeClearanceCondition":
                far = self._values.nominal(node, "distanceForward")
                if far >= ANYWHERE or self._values.nominal(node, "distanceBackward") >= ANYWHERE:
                    node.use_all()
                    return "true"
        node.leave_out("the language has no condition for it; it is never met here")
        return None

    def _actor(self, node: Node) -> str:
        said = self._values.text(node, "entityRef")
        actor = self._actors.get(said)
        if actor is None:
            raise Unresolved(f"there is no entity {said}", node.place)
        return actor.name

    def _compared(self, node: Node, measure: str, dimension: Dimension) -> str:
        value = self._values.quantity(node, "value", dimension)
        return f"{measure} {COMPARISONS[node.said('rule')]} {value.within(SUM)}"

    def _distance(self, node: Node, said: str, a: str) -> str:
        value = self._values.quantity(node, "value", LENGTH)
        return self._far(node, said, a, value.within(SUM), f"-{value.within(PRODUCT)}")

    def _headway(self, node: Node, said: str, a: str) -> str:
        time = self._values.quantity(node, "value", TIME)
        way = f"{time.within(PRODUCT)} * {a}.speed"
        behind = f"-{time.within(PRODUCT)} * {a}.speed"
        return self._far(node, said, a, way, behind)

    def _far(self, node: Node, said: str, a: str, value: str, negative: str) -> str:
        """Return the condition on the distance of another actor, which has no sign.

        Args:
            node: The condition.
            said: The actor in the document.
            a: The actor.
            value: The distance.
            negative: The same one behind the actor, or to its right.
        """
        b_said, b = self._values.text(node, "entityRef"), self._actor(node)
        for name in ("alongRoute", "relativeDistanceType", "coordinateSystem", "routingAlgorithm"):
            node.text(name)
        kind, system = asked(self._places.resolved(node))
        mode = _mode(node, default=False)
        rule = node.said("rule")
        if kind not in ("longitudinal", "lateral"):
            measure = f"{a}.object_distance({b}, euclidean{mode})"
            return f"{measure} {COMPARISONS[rule]} {value}"
        method = "object_distance" if system == "entity" else "road_distance"
        if system in ("lane", "trajectory"):
            node.approximate(f"distances in the system of a {system} are those of the road")
        from_, to = a, b
        sign = self._side(said, b_said, kind)
        if kind == "longitudinal" and sign is not None and sign < 0:
            from_, to = b, a  # the one behind asks, so the distance is positive
        measure = f"{from_}.{method}({to}, {kind}{mode})"
        compared = f"{measure} {COMPARISONS[rule]} {value}"
        if rule.startswith("less"):
            is_ahead = kind == "longitudinal" and sign is not None
            if is_ahead and self._values.nominal(node, "value") > 0.0:
                return compared  # it is met before the sign of the distance changes
            word, other = "and", COMPARISONS[rule].replace("<", ">")
        else:
            word, other = "or", COMPARISONS[rule].replace(">", "<")
        return f"{compared} {word} {measure} {other} {negative}"

    def _side(self, said: str, other: str, kind: str) -> int | None:
        """Return 1 if the other one is ahead at the start, -1 if behind; `None`: not known."""
        a, b = self._places.bodies.get(said), self._places.bodies.get(other)
        if a is None or b is None or a.pose is None or b.pose is None or kind != "longitudinal":
            return None
        along = (b.pose.x - a.pose.x) * math.cos(a.pose.h) + (b.pose.y - a.pose.y) * math.sin(
            a.pose.h
        )
        return None if abs(along) < 1e-6 else 1 if along > 0 else -1

    def _collision_time(self, node: Node, said: str, a: str) -> str | None:
        target = node.one("TimeToCollisionConditionTarget").inner
        if target.tag != "EntityRef":
            target.leave_out("the language has a time to collision with actors only")
            return None
        b = self._actor(target)
        for name in (
            "freespace",
            "relativeDistanceType",
            "coordinateSystem",
            "alongRoute",
            "routingAlgorithm",
        ):
            node.text(name)
        kind, system = asked(self._places.resolved(node))
        rule = node.said("rule")
        sign = self._side(said, target.said("entityRef"), kind)
        is_behind = self._look_alike(said, target.said("entityRef"))
        if is_behind and kind == "longitudinal" and sign is not None and rule.startswith("less"):
            # a distance that shrinks is positive, so the rule tells nothing of one that grows
            time = self._values.quantity(node, "value", TIME).within(PRODUCT)
            behind, ahead = (a, b) if sign > 0 else (b, a)
            method = "object_distance" if system == "entity" else "road_distance"
            mode = _mode(node, default=False)
            way = f"{behind}.{method}({ahead}, longitudinal{mode})"
            return f"{way} {COMPARISONS[rule]} {time} * ({behind}.speed - {ahead}.speed)"
        node.approximate("the time to collision counts from the velocities of both boxes")
        return self._compared(node, f"{a}.time_to_collision({b})", TIME)

    def _look_alike(self, said: str, other: str) -> bool:
        """Whether two actors look in the same direction at the start."""
        bodies = [self._places.bodies.get(each) for each in (said, other)]
        headings = [each.pose.h for each in bodies if each is not None and each.pose is not None]
        return len(headings) == 2 and math.cos(headings[0] - headings[1]) > 0.0

    def _travelled(self, node: Node, said: str, a: str) -> str | None:
        value = self._values.quantity(node, "value", LENGTH)
        body, road_map = self._places.bodies.get(said), self._places.map
        if body is None or body.place is None or road_map is None:
            node.leave_out(
                "how far an actor has driven is only known on a road; it is never met here"
            )
            return None
        road = road_map.roads[body.place.road]
        direction = road_map.travel_direction(body.place.road, body.place.lane) * body.along
        direction *= 1 if body.v >= 0.0 else -1
        end = body.place.s + direction * value.value
        if not 0.0 <= end <= road.length:
            node.leave_out("the way leads beyond the first road; it is never met here")
            return None
        node.approximate("the way is that along the road from the place of the start")
        start = literal(body.place.s, LENGTH)
        reached = f"{a}.get_s_coord()"
        if direction > 0:
            return f"{reached} >= {start} + {value.within(SUM)}"
        return f"{reached} <= {start} - {value.within(2)}"

    def _at_place(self, node: Node, said: str, a: str) -> str | None:
        found = self._places.coordinates(node.one("Position"))
        if found is None:
            node.leave_out("the place is not known before the run; it is never met here")
            return None
        node.one("Position").use_all()
        if any(
            text.startswith("$")
            for each in node.element.walk()
            for _, text in each.attributes
            if each is not node.element
        ):
            node.approximate("the place keeps that of its nominal values")
        point = self._places.points.goal(*found, a)
        if node.tag == "ReachPositionCondition":
            within = self._values.quantity(node, "tolerance", LENGTH)
            return f"{a}.distance_to_xyz_point({point}, euclidean) <= {within.within(SUM)}"
        kind = node.text("relativeDistanceType")
        if kind in ("longitudinal", "lateral"):
            node.approximate("the distance to a place is the straight one")
        for name in ("coordinateSystem", "alongRoute", "routingAlgorithm"):
            node.text(name)
        mode = _mode(node, default=False)
        return self._compared(node, f"{a}.distance_to_xyz_point({point}, euclidean{mode})", LENGTH)

    def _collision(self, node: Node, a: str) -> str | None:
        by = node.inner
        if by.tag != "EntityRef":
            others = [each.name for each in self._actors.values() if each.name != a]
            by.use_all()
            if not others:
                return None
            node.approximate("collisions with any actor of a kind are those with any other actor")
        else:
            others = [self._actor(by)]
        touching = [f"{a}.object_distance({b}, euclidean, bounding_boxes) <= 0m" for b in others]
        return touching[0] if len(touching) == 1 else " or ".join(f"({each})" for each in touching)


def _mode(node: Node, *, default: bool) -> str:
    text = (node.text("freespace") or str(default)).lower()
    return ", bounding_boxes" if text in ("true", "1") else ""

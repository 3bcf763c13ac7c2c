"""Conditions on entities as expressions."""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx.importing.cast import Actor
from osc2tx.importing.clearances import Clearances
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import (
    ACCELERATION,
    LENGTH,
    PRODUCT,
    SPEED,
    SUM,
    TIME,
    Dimension,
    Quantity,
    literal,
    total,
)
from osc2tx.importing.effects import Reader, Readings
from osc2tx.importing.place_conditions import COMPARISONS, PlaceConditions, boxes
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.player.distances import asked

DIRECTIONS: Mapping[str, str] = {"longitudinal": "x", "lateral": "y", "vertical": "z"}
WORDS: Mapping[str, Mapping[str, str]] = {"rule": COMPARISONS, "direction": DIRECTIONS}
"""What attributes of conditions may say."""

STANDING = 0.01  # m/s
SYSTEMS = ("alongRoute", "relativeDistanceType", "coordinateSystem", "routingAlgorithm")


class EntityConditions(Reader):
    """Reads conditions on entities."""

    def __init__(self, readings: Readings) -> None:
        super().__init__(readings)
        self._at_places, self._clearances = PlaceConditions(readings), Clearances(readings)
        self.begin_group = self._clearances.begin_group

    def expression(self, node: Node, actor: Actor) -> str | None:
        """Return the expression of a condition on an actor; `None`, with a finding, if none.

        Raises:
            Unresolved: A word of it is none of those that the standard has there.
        """
        a = actor.name
        for name, words in WORDS.items():
            said_here = node.element.get(name)
            if said_here is not None and said_here not in words:
                raise Unresolved(f"{name} has no value {said_here!r}", node.place)
        match node.tag:
            case "SpeedCondition":
                part = _part(node, f"{a}.velocity.translational")
                return self._compared(node, part or f"{a}.speed", SPEED)
            case "RelativeSpeedCondition":
                return self._relative_speed(node, actor)
            case "AccelerationCondition":
                whole = f"{a}.acceleration.translational"
                return self._compared(node, _part(node, whole) or f"{whole}.norm()", ACCELERATION)
            case "RelativeDistanceCondition":
                return self._distance(node, actor)
            case "TimeHeadwayCondition":
                return self._headway(node, actor)
            case "TimeToCollisionCondition":
                return self._collision_time(node, actor)
            case "TraveledDistanceCondition":
                return self._travelled(node, actor)
            case "ReachPositionCondition":
                return self._at_places.reached(node, a)
            case "DistanceCondition":
                return self._at_places.far(node, actor)
            case "StandStillCondition":
                if self._values.nominal(node, "duration") > 0.0:
                    node.approximate(
                        "its duration does not count: it is met as soon as the actor stands still"
                    )
                return f"{a}.speed < {literal(STANDING, SPEED)}"
            case "CollisionCondition":
                return self._collision(node, a)
            case "RelativeClearanceCondition":
                return self._clearances.expression(node, actor)
        node.leave_out("the language has no condition for it; it is never met here")
        return None

    def _compared(self, node: Node, measure: str, dimension: Dimension) -> str:
        value = self._values.quantity(node, "value", dimension)
        return f"{measure} {COMPARISONS[node.said('rule')]} {value.within(SUM)}"

    def _distance(self, node: Node, actor: Actor) -> str:
        value = self._values.quantity(node, "value", LENGTH)
        return self._far(node, actor, value.within(SUM), f"-{value.within(PRODUCT)}")

    def _headway(self, node: Node, actor: Actor) -> str:
        time = self._values.quantity(node, "value", TIME)
        way = f"{time.within(PRODUCT)} * {actor.name}.speed"
        return self._far(node, actor, way, f"-{way}")

    def _far(self, node: Node, actor: Actor, value: str, negative: str) -> str:
        """Return the condition on the distance of another actor, which has no sign.

        Args:
            node: The condition.
            actor: The actor.
            value: The distance.
            negative: The same one behind the actor, or to its right.
        """
        reference = self._actor(node)
        both, a, b = (actor.said, reference.said), actor.name, reference.name
        for name in SYSTEMS:
            node.text(name)
        kind, system = asked(self._places.resolved(node))
        mode = boxes(node)
        rule = node.said("rule")
        if kind not in ("longitudinal", "lateral"):
            measure = f"{a}.object_distance({b}, euclidean{mode})"
            return f"{measure} {COMPARISONS[rule]} {value}"
        method = "object_distance" if system == "entity" else "road_distance"
        if system in ("lane", "trajectory"):
            node.approximate(f"distances in the system of a {system} are those of the road")
        from_, to = a, b
        told = self._clearances.sides.get(both) if kind == "longitudinal" else None
        cleared = self._clearances.cleared.get(both) if kind == "longitudinal" else None
        sign = cleared or self._side(actor, reference, kind)
        if kind == "longitudinal" and sign is not None and sign < 0:
            from_, to = b, a  # the one behind asks, so the distance is positive
        measure = f"{from_}.{method}({to}, {kind}{mode})"
        compared = f"{measure} {COMPARISONS[rule]} {value}"
        if told and rule.startswith("greater"):
            return compared
        if rule.startswith("less"):
            is_ahead = kind == "longitudinal" and sign is not None
            if is_ahead and self._values.nominal(node, "value") > 0.0:
                return compared  # it is met before the sign of the distance changes
            word, other = "and", COMPARISONS[rule].replace("<", ">")
        else:
            word, other = "or", COMPARISONS[rule].replace(">", "<")
        return f"{compared} {word} {measure} {other} {negative}"

    def _side(self, actor: Actor, other: Actor, kind: str) -> int | None:
        """Return 1 if the other one is ahead at the start, -1 if behind; `None`: not known."""
        a, b = self._body(actor), self._body(other)
        if a is None or b is None or a.pose is None or b.pose is None or kind != "longitudinal":
            return None
        dx, dy, h = b.pose.x - a.pose.x, b.pose.y - a.pose.y, a.pose.h
        along = dx * math.cos(h) + dy * math.sin(h)
        return None if abs(along) < 1e-6 else 1 if along > 0 else -1

    def _collision_time(self, node: Node, actor: Actor) -> str | None:
        for name in (*SYSTEMS, "freespace"):
            node.text(name)
        target = node.one("TimeToCollisionConditionTarget")
        if target.inner.tag != "EntityRef":
            return self._at_places.in_time(node, target, actor.name)
        other = self._actor(target.inner)
        a, b = actor.name, other.name
        kind, system = asked(self._places.resolved(node))
        rule = node.said("rule")
        sign = self._side(actor, other, kind)
        if kind == "longitudinal" and sign is not None and rule.startswith("less"):
            time = self._values.quantity(node, "value", TIME).within(PRODUCT)
            is_behind = (self._turned(actor, other) or 0.0) > 0.0
            behind, ahead = (a, b) if sign > 0 or not is_behind else (b, a)
            method = "object_distance" if system == "entity" else "road_distance"
            way = f"{behind}.{method}({ahead}, longitudinal{boxes(node)})"
            met = f"{way} {COMPARISONS[rule]} {time} * "
            if is_behind:
                # a distance that shrinks is positive, so the rule tells nothing of one that grows
                return f"{met}({behind}.speed - {ahead}.speed)"
            if sign > 0:  # they meet; behind each other they part
                return f"{way} > 0m and {met}({behind}.speed + {ahead}.speed)"
        node.approximate("the time to collision counts from the velocities of both boxes")
        return self._compared(node, f"{a}.time_to_collision({b})", TIME)

    def _relative_speed(self, node: Node, actor: Actor) -> str:
        """Return the condition on a difference of speeds, along the axes of the first actor."""
        reference, sign = self._actor(node), "-"
        a, b, mine = actor.name, reference.name, f"{actor.name}.speed"
        other, rule = f"{b}.speed", COMPARISONS[node.said("rule")]
        if node.has("direction"):
            mine, other = (_part(node, f"{each}.velocity.translational") or "" for each in (a, b))
            is_level = node.said("direction") == "vertical"
            if not is_level and (self._turned(actor, reference) or 0.0) < 0.0:
                sign = "+"
            if not (is_level or (actor.is_free and reference.is_free)):
                node.approximate(f"the speed of {b} counts along its own axes, as at the start")
        value = self._values.quantity(node, "value", SPEED)
        if not value.is_open and value.value == 0.0 and sign == "-":
            return f"{mine} {rule} {other}"
        return f"{mine} {sign} {other} {rule} {value.within(SUM)}"

    def _turned(self, actor: Actor, other: Actor) -> float | None:
        """Return the cosine between two actors at the start: 1 if both look the same way."""
        bodies = [self._body(each) for each in (actor, other)]
        headings = [each.pose.h for each in bodies if each is not None and each.pose is not None]
        return math.cos(headings[0] - headings[1]) if len(headings) == 2 else None

    def _travelled(self, node: Node, actor: Actor) -> str | None:
        value, at = self._values.quantity(node, "value", LENGTH), self._on_road(actor)
        if at is None:
            node.leave_out("the distance travelled is only known on a road; it is never met here")
            return None
        direction = at.direction * at.body.along * (1 if at.body.v >= 0.0 else -1)
        end = at.place.s + direction * value.value
        if not 0.0 <= end <= at.map.roads[at.place.road].length:
            node.leave_out("the distance leads beyond the first road; it is never met here")
            return None
        node.approximate("the distance travelled counts along the road from the start position")
        there = total(LENGTH, (1, Quantity("", at.place.s)), (direction, value))
        return f"{actor.name}.get_s_coord() {'>=' if direction > 0 else '<='} {there.text}"

    def _collision(self, node: Node, a: str) -> str | None:
        by = node.inner
        if by.tag != "EntityRef":
            others = [each.name for each in self._actors.values() if each.name != a]
            by.use_all()
            if not others:
                return None
            node.approximate("collisions with any actor of a kind are those with any other actor")
        else:
            others = [self._actor(by).name]
        touching = [f"{a}.object_distance({b}, euclidean, bounding_boxes) <= 0m" for b in others]
        return touching[0] if len(touching) == 1 else " or ".join(f"({each})" for each in touching)


def _part(node: Node, whole: str) -> str | None:
    """Return the part of a velocity or acceleration that a condition is about; `None`: all."""
    direction = node.text("direction")
    return None if direction is None else f"{whole}.{DIRECTIONS[direction]}"

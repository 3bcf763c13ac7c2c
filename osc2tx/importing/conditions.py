"""Conditions as expressions, and triggers as what has to be waited for.

A trigger is an OR of groups, a group an AND of conditions. What stays true once it is (times, ends
of events) is waited for first; then what may change.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import field

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.places import Places
from osc2tx.importing.values import (
    ACCELERATION,
    LENGTH,
    SPEED,
    SUM,
    TIME,
    Dimension,
    Quantity,
    Values,
    literal,
)
from osc2tx.xosc.element import Unresolved
from osc2tx_shared.classes import dataclass

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


@dataclass(frozen=True, slots=True)
class Condition:
    """A condition in the language.

    Attributes:
        kind: `time`: seconds since the start; `state`: of elements of the storyboard; `event`: an
            event of the scenario; `expression`; `always` or `never`.
        text: The expression, or the name of the event.
        edge: `rising`, `falling`, `risingOrFalling` or `none`.
        delay: How much later it counts.
        quantity: The time.
        element: Kind and name of the element of the storyboard.
        state: Its state.
        node: Where it stands.
    """

    kind: str
    node: Node
    text: str = ""
    edge: str = "none"
    delay: Quantity | None = None
    quantity: Quantity | None = None
    element: tuple[str, str] = ("", "")
    state: str = ""
    lasting: float = 0.0


@dataclass
class Trigger:
    """A trigger: one of its groups has to be met.

    Attributes:
        groups: Conditions that count together.
        node: Where it stands.
    """

    groups: list[list[Condition]] = field(default_factory=list)
    node: Node | None = None

    @property
    def is_immediate(self) -> bool:
        """Whether nothing is waited for."""
        return not self.groups or any(not group for group in self.groups)


class Conditions:
    """Reads the triggers of a document.

    Attributes:
        events: Names of events that variables stand for, by variable and value.
        outside: Names of events that come from outside.
    """

    def __init__(
        self,
        values: Values,
        places: Places,
        actors: Mapping[str, Actor],
        name_of_mark: Callable[[str, str], str],
        texts: Callable[[str], str | None],
    ) -> None:
        self._values, self._places, self._actors = values, places, actors
        self._name_of_mark, self._texts = name_of_mark, texts
        self.outside: dict[str, str] = {}

    def trigger(self, node: Node | None) -> Trigger:
        """Read a trigger; groups that cannot be met here are left out, with a finding."""
        if node is None:
            return Trigger()
        found = Trigger(node=node)
        groups = list(node.children("ConditionGroup"))
        for group in groups:
            conditions = [self._condition(each) for each in group.children("Condition")]
            if any(each.kind == "never" for each in conditions):
                continue
            found.groups.append([each for each in conditions if each.kind != "always"])
        if groups and not found.groups:
            never = Condition("never", node)
            found.groups.append([never])
        return found

    def _condition(self, node: Node) -> Condition:
        try:
            return self._read(node)
        except Unresolved as error:
            node.leave_out(error.reason)
            return Condition("never", node)

    def _read(self, node: Node) -> Condition:
        inner = node.inner
        edge = node.text("conditionEdge") or "none"
        delay = self._values.quantity(node, "delay", TIME)
        shift = delay if delay.is_open or delay.value > 0.0 else None
        if inner.tag == "ByEntityCondition":
            return self._by_entity(inner, edge, shift)
        return self._by_value(inner.inner, edge, shift)

    # --- by value ---------------------------------------------------------------------------------

    def _by_value(self, node: Node, edge: str, delay: Quantity | None) -> Condition:
        match node.tag:
            case "SimulationTimeCondition":
                return self._of_time(node, delay)
            case "StoryboardElementStateCondition":
                element = node.said("storyboardElementType"), node.said("storyboardElementRef")
                state = node.said("state")
                return Condition("state", node, element=element, state=state, delay=delay)
            case "VariableCondition":
                return self._of_variable(node, edge, delay)
            case "ParameterCondition":
                return self._of_parameter(node, delay)
            case "UserDefinedValueCondition":
                name, value = self._values.text(node, "name"), self._values.text(node, "value")
                node.text("rule")
                event = self._name_of_mark(name, value)
                self.outside[event] = f"{name} = {value}, from outside"
                return Condition("event", node, text=event, delay=delay)
        node.leave_out("the language has no condition for it; it is never met here")
        return Condition("never", node)

    def _of_time(self, node: Node, delay: Quantity | None) -> Condition:
        rule = node.said("rule")
        time = self._values.quantity(node, "value", TIME)
        if rule.startswith("greater"):
            if not time.is_open and time.value <= 0.0 and delay is None:
                return Condition("always", node)
            return Condition("time", node, quantity=time, delay=delay)
        if rule == "equalTo":
            return Condition("time", node, quantity=time, delay=delay)
        if time.value > 0.0:
            node.approximate("it is met from the start, and taken to be met always")
            return Condition("always", node)
        return Condition("never", node)

    def _of_variable(self, node: Node, edge: str, delay: Quantity | None) -> Condition:
        name, value = self._values.text(node, "variableRef"), self._values.text(node, "value")
        rule = node.said("rule")
        if rule != "equalTo":
            node.approximate(f"a variable is an event here: `{rule} {value}` is met when it is set")
            value = ""
        return Condition("event", node, text=self._name_of_mark(name, value), delay=delay)

    def _of_parameter(self, node: Node, delay: Quantity | None) -> Condition:
        said = node.said("parameterRef")
        rule, value = node.said("rule"), self._values.text(node, "value")
        given = self._texts(said)
        if given is None:
            node.leave_out(f"there is no parameter {said}; it is never met here")
            return Condition("never", node)
        node.approximate(f"{said} keeps its nominal value {given}")
        try:
            a, b = float(given), float(value)
            holds = {"greaterThan": a > b, "lessThan": a < b, "greaterOrEqual": a >= b}
            holds |= {"lessOrEqual": a <= b, "equalTo": a == b, "notEqualTo": a != b}
            return Condition("always" if holds[rule] else "never", node)
        except ValueError:
            return Condition("always" if (given == value) == (rule == "equalTo") else "never", node)

    # --- by entity --------------------------------------------------------------------------------

    def _by_entity(self, node: Node, edge: str, delay: Quantity | None) -> Condition:
        triggering = node.one("TriggeringEntities")
        rule = triggering.text("triggeringEntitiesRule") or "any"
        condition = node.one("EntityCondition").inner
        said = [self._values.text(ref, "entityRef") for ref in triggering.children("EntityRef")]
        texts = []
        lasting = 0.0
        for name in said:
            actor = self._actors.get(name)
            if actor is None:
                raise Unresolved(f"there is no entity {name}", triggering.place)
            text = self._of_entity(condition, name, actor.name)
            if text is None:
                return Condition("never", condition)
            texts.append(text)
        if condition.tag == "StandStillCondition":
            lasting = self._values.fixed(condition, "duration")
        if not texts:
            raise Unresolved("a condition of no entity", triggering.place)
        if all(text == "true" for text in texts):
            return Condition("always", condition)
        word = " or " if rule == "any" else " and "
        joined = texts[0] if len(texts) == 1 else word.join(f"({text})" for text in texts)
        return Condition("expression", condition, joined, edge, delay, lasting=lasting)

    def _of_entity(self, node: Node, said: str, a: str) -> str | None:
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
                b = self._actor(node)
                mode = _mode(node, default=False)
                node.text("alongRoute")
                node.text("coordinateSystem")
                node.text("relativeDistanceType")
                time = self._values.quantity(node, "value", TIME)
                sign = COMPARISONS[node.said("rule")]
                way = f"{a}.road_distance(reference: {b}, direction: longitudinal{mode})"
                return f"{way} {sign} {time.within(2)} * {a}.speed"
            case "TimeToCollisionCondition":
                return self._collision_time(node, a)
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
        b_said = self._values.text(node, "entityRef")
        b = self._actor(node)
        kind = node.text("relativeDistanceType") or "euclidianDistance"
        system = node.text("coordinateSystem") or "entity"
        node.text("routingAlgorithm")
        mode = _mode(node, default=False)
        value = self._values.quantity(node, "value", LENGTH)
        rule = node.said("rule")
        if kind not in ("longitudinal", "lateral"):
            measure = f"{a}.object_distance(reference: {b}, direction: euclidean{mode})"
            return f"{measure} {COMPARISONS[rule]} {value.within(SUM)}"
        method = "object_distance" if system == "entity" else "road_distance"
        if system in ("lane", "trajectory"):
            node.approximate(f"distances in the system of a {system} are those of the road")
        from_, to = a, b
        sign = self._side(said, b_said, kind)
        if kind == "longitudinal" and sign is not None and sign < 0:
            from_, to = b, a  # the one behind asks, so the distance is positive
        measure = f"{from_}.{method}(reference: {to}, direction: {kind}{mode})"
        compared = f"{measure} {COMPARISONS[rule]} {value.within(SUM)}"
        if rule.startswith("less"):
            if kind == "longitudinal" and sign is not None:
                return compared
            word, other = "and", COMPARISONS[rule].replace("<", ">")
        else:
            word, other = "or", COMPARISONS[rule].replace(">", "<")
        return f"{compared} {word} {measure} {other} -{value.within(2)}"

    def _side(self, said: str, other: str, kind: str) -> int | None:
        """Return 1 if the other one is ahead at the start, -1 if behind; `None`: not known."""
        a, b = self._places.bodies.get(said), self._places.bodies.get(other)
        if a is None or b is None or a.pose is None or b.pose is None or kind != "longitudinal":
            return None
        along = (b.pose.x - a.pose.x) * math.cos(a.pose.h) + (b.pose.y - a.pose.y) * math.sin(
            a.pose.h
        )
        return None if abs(along) < 1e-6 else 1 if along > 0 else -1

    def _collision_time(self, node: Node, a: str) -> str | None:
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
        node.approximate("the time to collision counts from the velocities of both boxes")
        return self._compared(node, f"{a}.time_to_collision(reference: {b})", TIME)

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
        x, y = (literal(round(value, 6), LENGTH) for value in found)
        point = f"point: road.create_xyz_point(x: {x}, y: {y}, z: 0m)"
        if node.tag == "ReachPositionCondition":
            within = self._values.quantity(node, "tolerance", LENGTH)
            return (
                f"{a}.distance_to_xyz_point({point}, direction: euclidean) <= {within.within(SUM)}"
            )
        kind = node.text("relativeDistanceType")
        if kind in ("longitudinal", "lateral"):
            node.approximate("the distance to a place is the straight one")
        for name in ("coordinateSystem", "alongRoute", "routingAlgorithm"):
            node.text(name)
        mode = _mode(node, default=False)
        return self._compared(
            node, f"{a}.distance_to_xyz_point({point}, direction: euclidean{mode})", LENGTH
        )

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
        touching = [
            f"{a}.object_distance(reference: {b}, direction: euclidean, mode: bounding_boxes) <= 0m"
            for b in others
        ]
        return touching[0] if len(touching) == 1 else " or ".join(f"({each})" for each in touching)


def _mode(node: Node, *, default: bool) -> str:
    text = (node.text("freespace") or str(default)).lower()
    return ", mode: bounding_boxes" if text in ("true", "1") else ""

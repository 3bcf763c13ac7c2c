"""Triggers: an OR of groups, each an AND of conditions with edges and delays."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from typing import Protocol

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.elements import class_of
from osc2tx.xosc.player.bodies import STANDING, Body
from osc2tx.xosc.player.courses import RULES, number
from osc2tx.xosc.player.distances import Ruler, asked, between_boxes
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.places import place_of
from osc2tx_shared.classes import dataclass

KINDS = {
    "act": "Act",
    "action": "Action",
    "event": "Event",
    "maneuver": "Maneuver",
    "maneuverGroup": "ManeuverGroup",
    "story": "Story",
}


@dataclass(frozen=True)
class Reading:
    """How a tool reads documents, where that is not what the standard says.

    Attributes:
        is_lazy: Of a group of conditions it looks at none behind a false one, but at delayed ones.
        latches: Of a group it wants each condition once, not all at one time.
        counts_from_looking: A time counts from when it begins to look for it.
        carries_acceleration: A profile of speeds begins with the present acceleration.
    """

    is_lazy: bool = False
    latches: bool = False
    counts_from_looking: bool = False
    carries_acceleration: bool = False


BY_THE_STANDARD = Reading()


class World(Protocol):
    """What conditions read besides the bodies."""

    root: Element
    step: int
    variables: dict[str, str]
    lights: dict[str, str]
    bodies: dict[str, Body]
    ruler: Ruler

    @property
    def time(self) -> float:
        """Seconds since the start."""

    def is_in(self, element: Element, state: str) -> bool:
        """Whether an element of the storyboard is in a state, or just in a transition."""


class Past:
    """What a condition was at each look; there may be several in a step."""

    def __init__(self) -> None:
        self.steps: list[int] = []
        self.values: list[bool] = []

    def note(self, step: int, value: bool) -> None:
        """Note a value; what was true in a step stays so in it."""
        if self.steps and self.steps[-1] == step:
            self.values[-1] = self.values[-1] or value
        else:
            self.steps.append(step)
            self.values.append(value)

    def at(self, step: int) -> bool:
        """Return the value of a step; false before the first look."""
        index = bisect_right(self.steps, step) - 1
        return index >= 0 and self.values[index]


class Conditions:
    """Evaluates the triggers of a document."""

    def __init__(self, world: World, dt: float, reading: Reading) -> None:
        self.world, self.dt, self.reading = world, dt, reading
        self.looking_since: dict[int, float] = {}  # s
        self.latched: set[int] = set()
        self.last: dict[int, bool] = {}  # at the look before
        self.edged: dict[int, Past] = {}
        self.named = {
            (kind, node.said("name")): node
            for kind, tag in KINDS.items()
            for node in world.root.below(class_of(tag))
        }

    def fires(self, trigger: Element | None) -> bool:
        """Whether a trigger fires; all its conditions are looked at in each step."""
        groups = () if trigger is None else trigger.all(xml.ConditionGroup)
        return any([self._all_hold(group.children) for group in groups])

    def _all_hold(self, conditions: Sequence[Element]) -> bool:
        result = True
        for condition in conditions:
            if result or not self.reading.is_lazy or number(condition, "delay") > 0.0:
                held = self._holds(condition) or id(condition) in self.latched
                if held and self.reading.latches:
                    self.latched.add(id(condition))
                result = result and held
        return result

    def _holds(self, condition: Element) -> bool:
        step = self.world.step
        value = self.test(condition.inner)
        before, edge = self.last.get(id(condition)), condition.said("conditionEdge")
        self.last[id(condition)] = value
        if edge == "none" and number(condition, "delay") == 0.0:
            return value
        if edge != "none":
            rises, falls = value and before is False, not value and before is True
            value = {"rising": rises, "falling": falls, "risingOrFalling": rises or falls}[edge]
        delay = number(condition, "delay")
        edged = self.edged.setdefault(id(condition), Past())
        edged.note(step, value)
        return edged.at(step - math.ceil(delay / self.dt - 1e-6))

    def test(self, node: Element) -> bool:
        """Whether a condition is met at the present step."""
        if node.tag == "ByEntityCondition":
            triggering = node.one(xml.TriggeringEntities)
            found = [
                self._of_entity(
                    self.world.bodies[ref.said("entityRef")], node.one(xml.EntityCondition).inner
                )
                for ref in triggering.all(xml.EntityRef)
            ]
            return any(found) if triggering.get("triggeringEntitiesRule") == "any" else all(found)
        if not (node.tag == "ByValueCondition"):
            raise Unplayable(f"<{node.tag}> is not played", node.place)
        node = node.inner
        match node.tag:
            case "SimulationTimeCondition":
                since = self.looking_since.setdefault(id(node), self.world.time)
                counts = self.reading.counts_from_looking
                return _compare(node, self.world.time - (since if counts else 0.0))
            case "VariableCondition" | "ParameterCondition":
                name = node.get("variableRef") or node.said("parameterRef")
                value, rule = self.world.variables[name], node.said("rule")
                if rule in ("equalTo", "notEqualTo"):
                    return (value == node.said("value")) is (rule == "equalTo")
                return RULES[rule](float(value), float(node.said("value")))
            case "StoryboardElementStateCondition":
                key = node.said("storyboardElementType"), node.said("storyboardElementRef")
                return self.world.is_in(self.named[key], node.said("state"))
            case "TrafficSignalCondition":
                return self.world.lights.get(node.said("name")) == node.said("state")
            case "UserDefinedValueCondition":
                return False  # nobody sets such a value
        raise Unplayable(f"<{node.tag}> is not played", node.place)

    def _of_entity(self, body: Body, node: Element) -> bool:
        world = self.world
        match node.tag:
            case "SpeedCondition":
                return _compare(node, _part(node, body.v, body.rate))
            case "AccelerationCondition":
                return _compare(node, _part(node, body.a, body.swing))
            case "RelativeSpeedCondition":
                other = world.bodies[node.said("entityRef")]
                turned = other.here.h - body.here.h if node.get("direction") else 0.0
                return _compare(node, body.v - other.v * math.cos(turned))
            case "RelativeDistanceCondition":
                other = world.bodies[node.said("entityRef")]
                return _compare(node, world.ruler.relative(body, other, node))
            case "DistanceCondition" | "ReachPositionCondition":
                place, _ = place_of(node.one(xml.Position).inner, world.bodies, world.ruler.map)
                found = world.ruler.to_place(body, place, node)
                if node.tag == "ReachPositionCondition":
                    return found <= number(node, "tolerance")
                return _compare(node, found)
            case "RelativeClearanceCondition":
                named = [ref.said("entityRef") for ref in node.all(xml.EntityRef)]
                others = [each for each in world.bodies.values() if each is not body]
                others = [each for each in others if not named or each.name in named]
                return world.ruler.clear(body, others, node)
            case "TimeHeadwayCondition":
                other = world.bodies[node.said("entityRef")]
                return self._time(node, world.ruler.relative(body, other, node), body.v)
            case "TimeToCollisionCondition":
                target = node.one(xml.TimeToCollisionConditionTarget).one(xml.EntityRef)
                other = world.bodies[target.said("entityRef")]
                speed = world.ruler.closing_speed(body, other, *asked(node))
                return self._time(node, world.ruler.relative(body, other, node), speed)
            case "StandStillCondition":
                return abs(body.v) < STANDING and body.stood >= number(node, "duration") - 1e-9
            case "TraveledDistanceCondition":
                return body.driven >= number(node, "value") - 1e-9
            case "CollisionCondition" if node.find(xml.EntityRef) is not None:
                other = world.bodies[node.one(xml.EntityRef).entityRef]
                return between_boxes(body, other) == 0.0
        raise Unplayable(f"<{node.tag}> is not played", node.place)

    @staticmethod
    def _time(node: Element, distance: float, speed: float) -> bool:
        """Whether a time to come compares; one that cannot be predicted does not."""
        return speed > 0.0 and _compare(node, distance / speed)


def _compare(node: Element, value: float) -> bool:
    return RULES[node.said("rule")](value, number(node, "value"))


def _part(node: Element, along: float, across: float) -> float:
    match node.get("direction"):
        case "longitudinal":
            return along
        case "lateral":
            return across
        case "vertical":
            return 0.0
    return math.hypot(along, across)

"""Conditions on the motion of entities.

A run looks at most conditions in each step, so the element of each is turned into a function once.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol, TypeAlias

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import STANDING, Body
from osc2tx.xosc.player.courses import RULES, number
from osc2tx.xosc.player.distances import Ruler, asked, between_boxes
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.global_state import GlobalState
from osc2tx.xosc.player.places import target_of

Test: TypeAlias = Callable[[], bool]
"""Whether a condition is met at the present step."""

Measure: TypeAlias = Callable[[], float]
"""The value that a condition compares, at the present step."""


class World(Protocol):
    """The state that conditions read besides the bodies."""

    root: Element
    step: int
    globals: GlobalState
    bodies: dict[str, Body]
    ruler: Ruler

    @property
    def time(self) -> float:
        """Seconds since the start."""

    def is_in(self, element: Element, state: str) -> bool:
        """Whether an element of the storyboard is in a state, or just in a transition."""


def test_of_entities(node: Element, world: World) -> Test:
    """Return the test of a `ByEntityCondition`."""
    triggering, asked_for = node.one(xml.TriggeringEntities), node.one(xml.EntityCondition).inner
    tests = [
        _test_of(world.bodies[each.said("entityRef")], asked_for, world)
        for each in triggering.all(xml.EntityRef)
    ]
    if len(tests) == 1:
        return tests[0]
    if triggering.get("triggeringEntitiesRule") == "any":
        return lambda: any([test() for test in tests])
    return lambda: all([test() for test in tests])


def compared(node: Element, measure: Measure) -> Test:
    """Return the test that compares a measure by the rule of a condition."""
    holds, value = RULES[node.said("rule")], number(node, "value")
    return lambda: holds(measure(), value)


def _test_of(body: Body, node: Element, world: World) -> Test:
    match node.tag:
        case "SpeedCondition":
            if body.reports_commanded and not node.get("direction"):
                return compared(node, lambda: body.v)
            return compared(node, _part(node, lambda: body.v, lambda: body.rate))
        case "AccelerationCondition":
            return compared(node, _part(node, lambda: body.a, lambda: body.swing))
        case "RelativeSpeedCondition":
            return compared(node, _relative_speed(body, node, world))
        case "RelativeDistanceCondition":
            other = world.bodies[node.said("entityRef")]
            return compared(node, lambda: world.ruler.relative(body, other, node))
        case "DistanceCondition" | "ReachPositionCondition":
            return _test_of_place(body, node, world)
        case "RelativeClearanceCondition":
            named = [ref.said("entityRef") for ref in node.all(xml.EntityRef)]
            others = [each for each in world.bodies.values() if each is not body]
            others = [each for each in others if not named or each.name in named]
            return lambda: world.ruler.clear(body, others, node)
        case "TimeHeadwayCondition":
            other = world.bodies[node.said("entityRef")]
            return _test_of_time(body, other, node, world, lambda: body.v)
        case "TimeToCollisionCondition":
            target = node.one(xml.TimeToCollisionConditionTarget).find(xml.EntityRef)
            if target is None:
                return _test_of_time_to_place(body, node, world)
            other, way = world.bodies[target.said("entityRef")], asked(node)
            closing = world.ruler.closing_speed
            return _test_of_time(body, other, node, world, lambda: closing(body, other, *way))
        case "StandStillCondition":
            least = number(node, "duration") - 1e-9
            return lambda: abs(body.v) < STANDING and body.stood >= least
        case "EndOfRoadCondition":
            longest = number(node, "duration") - 1e-9
            return lambda: body.is_at_end and body.beyond >= longest
        case "TraveledDistanceCondition":
            way_driven = number(node, "value") - 1e-9
            return lambda: body.driven >= way_driven
        case "CollisionCondition" if node.find(xml.EntityRef) is not None:
            other = world.bodies[node.one(xml.EntityRef).entityRef]
            return lambda: between_boxes(body, other) == 0.0
    raise Unplayable(f"<{node.tag}> is not played", node.place)


def _relative_speed(body: Body, node: Element, world: World) -> Measure:
    """Return the difference of two speeds; with a direction, on an axis of the first entity."""
    other = world.bodies[node.said("entityRef")]
    if not node.get("direction"):
        return lambda: body.v - other.v

    def along() -> float:
        turn = other.here.h - body.here.h
        return body.v - other.v * math.cos(turn) + other.rate * math.sin(turn)

    def across() -> float:
        turn = other.here.h - body.here.h
        return body.rate - other.v * math.sin(turn) - other.rate * math.cos(turn)

    return _part(node, along, across)


def _test_of_place(body: Body, node: Element, world: World) -> Test:
    """Return the test of the distance to a place, which may move with an entity."""
    position, ruler = node.one(xml.Position).inner, world.ruler

    def distance() -> float:
        return ruler.to_place(body, target_of(position, world.bodies, ruler.map), node)

    if node.tag != "ReachPositionCondition":
        return compared(node, distance)
    tolerance = number(node, "tolerance")
    return lambda: distance() <= tolerance


def _test_of_time(body: Body, other: Body, node: Element, world: World, speed: Measure) -> Test:
    """Return the test of a time to come; one that cannot be predicted does not compare."""
    holds, value, relative = RULES[node.said("rule")], number(node, "value"), world.ruler.relative

    def test() -> bool:
        distance, now = relative(body, other, node), speed()
        return now > 0.0 and holds(distance / now, value)

    return test


def _test_of_time_to_place(body: Body, node: Element, world: World) -> Test:
    """Return the test of the time to a place that does not move."""
    holds, value, ruler = RULES[node.said("rule")], number(node, "value"), world.ruler
    position = node.one(xml.TimeToCollisionConditionTarget).one(xml.Position).inner

    def test() -> bool:
        place = target_of(position, world.bodies, ruler.map)
        return body.v > 0.0 and holds(ruler.to_place(body, place, node) / body.v, value)

    return test


def _part(node: Element, along: Measure, across: Measure) -> Measure:
    """Return the part of a speed or acceleration that a condition is about."""
    match node.get("direction"):
        case "longitudinal":
            return along
        case "lateral":
            return across
        case "vertical":
            return lambda: 0.0
    return lambda: math.hypot(along(), across())

"""Triggers: an OR of groups, each an AND of conditions with edges and delays."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import field

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.agenda import Awaited
from osc2tx.xosc.player.courses import RULES, number
from osc2tx.xosc.player.entity_conditions import Test, World, compared, test_of_entities
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.reading import Reading
from osc2tx_shared.classes import dataclass

KINDS = {
    "Act": "act",
    "Action": "action",
    "Event": "event",
    "Maneuver": "maneuver",
    "ManeuverGroup": "maneuverGroup",
    "Story": "story",
}
"""The names of elements of a storyboard in conditions, by tag."""


LATER = ("greaterThan", "greaterOrEqual")


class Past:
    """The values of a condition at its evaluations; there may be several in a step."""

    def __init__(self) -> None:
        self.steps: list[int] = []
        self.values: list[bool] = []

    def note(self, step: int, value: bool) -> None:
        """Record a value; a true value of a step stays true in it."""
        if self.steps and self.steps[-1] == step:
            self.values[-1] = self.values[-1] or value
        else:
            self.steps.append(step)
            self.values.append(value)

    def at(self, step: int) -> bool:
        """Return the value of a step; false before the first look."""
        index = bisect_right(self.steps, step) - 1
        return index >= 0 and self.values[index]


@dataclass
class Looked:
    """An evaluated condition.

    Attributes:
        test: Whether it is met now.
        edge: The change of the value that it waits for.
        is_delayed: A past value counts, not the present one.
        steps: Delay in steps.
        before: The previous value.
        latched: It was true once.
        past: The values at all evaluations.
    """

    test: Test
    edge: str
    is_delayed: bool
    steps: int
    before: bool | None = None
    latched: bool = False
    past: Past = field(default_factory=Past)


def _named(node: Element, around: tuple[str, ...]) -> Iterator[tuple[tuple[str, str], Element]]:
    """Yield the elements of the storyboard by kind and name, also with names of those around."""
    if node.tag in KINDS:
        around = (*around, node.said("name"))
        for index in range(len(around)):
            yield (KINDS[node.tag], "::".join(around[index:])), node
    for each in node.children:
        yield from _named(each, around)


class Conditions:
    """Evaluates the triggers of a document."""

    def __init__(self, world: World, dt: float, reading: Reading) -> None:
        self.world, self.dt, self.reading = world, dt, reading
        self.looked: dict[int, Looked] = {}
        self.tests: dict[int, Test] = {}
        self.triggers: dict[int, tuple[Sequence[Element], bool]] = {}
        self.last_false: dict[int, int] = {}  # of each group
        self.named = dict(_named(world.root, ()))

    def fires(self, trigger: Element | None) -> bool:
        """Whether a trigger fires; all its conditions are looked at in each step."""
        if trigger is None:
            return False
        groups, may_wait = self._groups_of(trigger)
        if may_wait:
            return any([self._false_condition(group) is None for group in groups])
        return any([self._all_hold(group.children) for group in groups])

    def forget(self, trigger: Element) -> None:
        """Forget the past of the conditions of a trigger, which are looked at anew."""
        for condition in trigger.below(xml.Condition):
            self.looked.pop(id(condition), None)

    def awaited(self, trigger: Element) -> Awaited | None:
        """Return the causes of a trigger that does not fire; None if it is evaluated at each step.

        This is one false condition of each group: until it is true, the others do not matter.
        """
        groups, may_wait = self._groups_of(trigger)
        if not may_wait:
            return None
        times: list[float] = []
        changes: list[int | str] = []
        for group in groups:
            condition = self._false_condition(group)
            assert condition is not None, "asked of triggers that do not fire"
            node = condition.inner.inner
            if node.tag == "SimulationTimeCondition":
                times.append(number(node, "value"))
            elif node.tag == "StoryboardElementStateCondition":
                changes.append(id(self._element(node)))
            else:
                changes.append(_variable(node))
        return Awaited(tuple(times), tuple(changes))

    def _false_condition(self, group: Element) -> Element | None:
        """Return a false condition of a group, if there is one.

        The one of the last evaluation comes first, and those before it last: the conditions of a
        group mostly become true in their order.
        """
        conditions, start = group.children, self.last_false.get(id(group), 0)
        for index in (*range(start, len(conditions)), *range(start)):
            if not self._test_of(conditions[index].inner)():
                self.last_false[id(group)] = index
                found: Element = conditions[index]
                return found
        return None

    def _groups_of(self, trigger: Element) -> tuple[Sequence[Element], bool]:
        """Return the groups of a trigger, and whether it can wait until something changes."""
        known = self.triggers.get(id(trigger))
        if known is None:
            groups = tuple(trigger.all(xml.ConditionGroup))
            may_wait = all(self._can_wait(each) for group in groups for each in group.children)
            known = self.triggers[id(trigger)] = groups, may_wait
        return known

    def _can_wait(self, condition: Element) -> bool:
        """Whether a condition has no past, and turns true with a time, an element or a variable."""
        reading = self.reading
        if condition.said("conditionEdge") != "none" or number(condition, "delay") != 0.0:
            return False
        if reading.latches or reading.counts_from_looking:
            return False
        if condition.inner.tag != "ByValueCondition":
            return False
        node = condition.inner.inner
        if node.tag == "SimulationTimeCondition":
            return node.said("rule") in LATER
        if node.tag in ("VariableCondition", "ParameterCondition"):
            return True
        is_state = node.tag == "StoryboardElementStateCondition"
        return is_state and isinstance(self._element(node), xml.Event | xml.Act)

    def _element(self, node: Element) -> Element:
        """Return the element of the storyboard that a condition is about."""
        return self.named[node.said("storyboardElementType"), node.said("storyboardElementRef")]

    def _all_hold(self, conditions: Sequence[Element]) -> bool:
        result = True
        for condition in conditions:
            looked = self.looked.get(id(condition)) or self._looked_at(condition)
            if result or not self.reading.is_lazy or looked.is_delayed:
                held = self._holds(looked)
                if self.reading.latches:
                    held = looked.latched = held or looked.latched
                result = result and held
        return result

    def _looked_at(self, condition: Element) -> Looked:
        """Take a condition up: from now on it is looked at."""
        delay = number(condition, "delay")
        made = Looked(
            test=self._test_of(condition.inner),
            edge=condition.said("conditionEdge"),
            is_delayed=delay > 0.0,
            steps=math.ceil(delay / self.dt - 1e-6),
        )
        self.looked[id(condition)] = made
        return made

    def _holds(self, looked: Looked) -> bool:
        value, before = looked.test(), looked.before
        looked.before = value
        if looked.edge == "none" and not looked.is_delayed:
            return value
        if looked.edge != "none":
            rises, falls = value and before is False, not value and before is True
            value = {"rising": rises, "falling": falls, "risingOrFalling": rises or falls}[
                looked.edge
            ]
        looked.past.note(self.world.step, value)
        return looked.past.at(self.world.step - looked.steps)

    def _test_of(self, node: Element) -> Test:
        """Return the test of a condition, which is made when it is looked at first."""
        if id(node) not in self.tests:
            self.tests[id(node)] = self._made(node)
        return self.tests[id(node)]

    def _made(self, node: Element) -> Test:
        if node.tag == "ByEntityCondition":
            return test_of_entities(node, self.world)
        if node.tag != "ByValueCondition":
            raise Unplayable(f"<{node.tag}> is not played", node.place)
        node, world = node.inner, self.world
        match node.tag:
            case "SimulationTimeCondition":
                since = world.time if self.reading.counts_from_looking else 0.0
                return compared(node, lambda: world.time - since)
            case "VariableCondition" | "ParameterCondition":
                return _test_of_variable(node, world)
            case "StoryboardElementStateCondition":
                element, state = self._element(node), node.said("state")
                return lambda: world.is_in(element, state)
            case "TrafficSignalCondition":
                name, state = node.said("name"), node.said("state")
                return lambda: world.globals.lights.get(name) == state
            case "UserDefinedValueCondition":
                return lambda: False  # no action sets such a value
        raise Unplayable(f"<{node.tag}> is not played", node.place)


def _test_of_variable(node: Element, world: World) -> Test:
    """Return the test of a variable: texts are equal or not, numbers compare."""
    name, rule, value = _variable(node), node.said("rule"), node.said("value")
    if name not in world.globals.variables:  # third-party documents name missing entities
        return lambda: False
    if rule in ("equalTo", "notEqualTo"):
        return lambda: (world.globals.variables[name] == value) is (rule == "equalTo")
    holds, bound = RULES[rule], float(value)
    return lambda: holds(float(world.globals.variables[name]), bound)


def _variable(node: Element) -> str:
    """Return the name of the variable or parameter that a condition or an action is about."""
    return node.get("variableRef") or node.said("parameterRef")

"""Conditions as expressions, and triggers as what has to be waited for.

A trigger is an OR of groups, a group an AND of conditions. What stays true once it is (times, ends
of events) is waited for first; then what may change.
"""

from __future__ import annotations

from dataclasses import field

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import TIME, Quantity
from osc2tx.importing.effects import Reader, Readings
from osc2tx.importing.entity_conditions import EntityConditions
from osc2tx.importing.expressions import joined_by
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.player.courses import RULES
from osc2tx_shared.classes import dataclass


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
        lasting: How long (s) it has to be met.
        kept: The expression that tells whether its event has come.
        is_once: It is met at a single instant of the run.
    """

    kind: str
    node: Node = field(compare=False)
    text: str = ""
    edge: str = "none"
    delay: Quantity | None = None
    quantity: Quantity | None = None
    element: tuple[str, str] = ("", "")
    state: str = ""
    lasting: float = 0.0
    kept: str = ""
    is_once: bool = field(default=False, compare=False)


@dataclass
class Trigger:
    """A trigger: one of its groups has to be met.

    Attributes:
        groups: Conditions that count together.
        node: Where it stands.
        after: How much later than it is met it counts.
    """

    groups: list[list[Condition]] = field(default_factory=list)
    node: Node | None = None
    after: Quantity | None = None

    @property
    def is_immediate(self) -> bool:
        """Whether nothing is waited for."""
        return not self.groups or any(not group for group in self.groups)

    @property
    def time(self) -> float:
        """The time (s) up to which it waits, as far as times say it; nominal."""
        return max(
            (
                each.quantity.value
                for group in self.groups
                for each in group
                if each.quantity is not None
            ),
            default=0.0,
        )


class Conditions(Reader):
    """Reads the triggers of a document.

    Parameters that the storyboard sets are variables.
    """

    def __init__(self, readings: Readings) -> None:
        super().__init__(readings)
        self._of_entity = EntityConditions(readings)
        setting = self._document.tagged("ParameterAction")
        self._set = {node.said("parameterRef") for node in setting}

    def trigger(self, node: Node | None) -> Trigger:
        """Read a trigger; groups that cannot be met here are left out, with a finding."""
        if node is None:
            return Trigger()
        found = Trigger(node=node)
        groups = list(node.children("ConditionGroup"))
        for group in groups:
            nodes = list(group.children("Condition"))
            self._of_entity.begin_group(nodes)
            conditions = [self._condition(each) for each in nodes]
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
                return self._of_time(node, edge, delay)
            case "StoryboardElementStateCondition":
                element = node.said("storyboardElementType"), node.said("storyboardElementRef")
                state = node.said("state")
                return Condition("state", node, element=element, state=state, delay=delay)
            case "VariableCondition":
                return self._of_mark(node, self._values.text(node, "variableRef"), delay)
            case "ParameterCondition":
                return self._of_parameter(node, delay)
            case "TrafficSignalCondition":
                return Condition("expression", node, self._lights.shows(node), edge, delay)
            case "UserDefinedValueCondition":
                name, value = self._values.text(node, "name"), self._values.text(node, "value")
                node.text("rule")
                return Condition("event", node, self._marks.event(name, value), delay=delay)
        node.leave_out("the language has no condition for it; it is never met here")
        return Condition("never", node)

    def _of_time(self, node: Node, edge: str, delay: Quantity | None) -> Condition:
        rule = node.said("rule")
        time = self._values.quantity(node, "value", TIME)
        if rule.startswith("greater"):
            if not time.is_open and time.value <= 0.0 and delay is None:
                return Condition("always", node)
            once = edge != "none"
            return Condition("time", node, quantity=time, delay=delay, is_once=once)
        if rule == "equalTo" or (edge == "falling" and time.value > 0.0):
            return Condition("time", node, quantity=time, delay=delay, is_once=True)
        if time.value > 0.0:
            node.approximate("it is met from the start, and taken to be met always")
            return Condition("always", node)
        return Condition("never", node)

    def _of_mark(self, node: Node, name: str, delay: Quantity | None) -> Condition:
        """Return the condition on a variable, or on a parameter that is set in the run."""
        value, rule = self._values.text(node, "value"), node.said("rule")
        left = self._marks.change_from(name, value) if rule in ("equalTo", "notEqualTo") else None
        if left is not None and rule == "equalTo" and delay is None:
            return Condition("expression", node, f"not {self._marks.kept(left)}")
        if rule != "equalTo":
            node.approximate(f"a variable is an event here: `{rule} {value}` is met when it is set")
            value = ""
        event = self._marks.event(name, value)
        return Condition("event", node, event, delay=delay, kept=self._marks.kept(event))

    def _of_parameter(self, node: Node, delay: Quantity | None) -> Condition:
        said = node.said("parameterRef")
        rule, value = node.said("rule"), self._values.text(node, "value")
        given = self._document.parameters.get(said)
        if given is None:
            node.leave_out(f"there is no parameter `{said}`; it is never met here")
            return Condition("never", node)
        if rule not in RULES:
            raise Unresolved(f"rule has no value {rule!r}", node.place)
        holds = _holds(given, rule, value)
        if said in self._set and not holds:
            return self._of_mark(node, said, delay)
        node.approximate(f"{said} keeps its nominal value {given}")
        return Condition("always" if holds else "never", node)

    # --- by entity --------------------------------------------------------------------------------

    def _by_entity(self, node: Node, edge: str, delay: Quantity | None) -> Condition:
        triggering = node.one("TriggeringEntities")
        rule = triggering.text("triggeringEntitiesRule") or "any"
        condition = node.one("EntityCondition").inner
        texts, lasting = [], 0.0
        for ref in triggering.children("EntityRef"):
            text = self._of_entity.expression(condition, self._actor(ref))
            if text is None:
                return Condition("never", condition)
            texts.append(text)
        if condition.tag == "StandStillCondition":
            lasting = self._values.fixed(condition, "duration")
        if not texts:
            raise Unresolved("a condition of no entity", triggering.place)
        if all(text == "true" for text in texts):
            return Condition("always", condition)
        joined = joined_by("or" if rule == "any" else "and", texts)
        return Condition("expression", condition, joined, edge, delay, lasting=lasting)


def _holds(given: str, rule: str, value: str) -> bool:
    """Whether a value of a parameter meets a rule."""
    try:
        return RULES[rule](float(given), float(value))
    except ValueError:
        return (given == value) == (rule == "equalTo")

"""The storyboard while it is being made: acts with events, each with the flow that starts it.

    Story > Act > ManeuverGroup > Maneuver > Event > Action

There is one maneuver group with one maneuver for each actor of an act, and one without actors for
events that concern nobody: marks, and actions on the whole world. Names of stories, acts and events
are unique, for conditions refer to them; the others only have to differ from those beside them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import field
from typing import TypeVar

from osc2tx.backends.xosc.conditions.flow import NEVER, Flow, Group, Test
from osc2tx.diagnostics import Span
from osc2tx.options import XmlVersion
from osc2tx.xosc import elements as xml
from osc2tx.xosc.names import Names
from osc2tx_shared.classes import dataclass

ACTION = "action"
"""Name of an action in its event. Readers may look for what is referred to among all elements: no
event is called so."""


SHORTLY = 1e-6
"""Seconds by which a time is over where a version only knows later ones: less than any step, more
than tools are off that sum up steps."""


@dataclass(slots=True)
class Event:
    """An event.

    Attributes:
        name: Its name.
        actions: `PrivateAction`, `GlobalAction` or `UserDefinedAction` elements.
        start: When it starts.
        place: Where the member stands that it belongs to.
        repeats: How often it may start.
        is_step: It is one step of a change that is reported as a whole.
    """

    name: str
    actions: tuple[xml.ActionPart, ...]
    start: Flow
    place: Span
    repeats: int | None = None
    is_step: bool = False


@dataclass(slots=True)
class Act:
    """An act, the part of the story that can be stopped as a whole.

    Attributes:
        name: Its name.
        start: When it starts.
        stops: Variables that stop it when they are set.
        around: The act that holds it in the tree; what stops that one stops this one.
        stop: The same as a flow, when all is known.
        events: Its events by actor; `None` for those without actor.
    """

    name: str
    start: Flow
    stops: list[str] = field(default_factory=list)
    around: Act | None = None
    stop: Flow = NEVER
    events: dict[str | None, list[Event]] = field(default_factory=dict)

    def stops_around(self) -> list[str]:
        """Return the variables that stop the acts around it."""
        around = self.around
        return [] if around is None else [*around.stops, *around.stops_around()]

    def all_events(self) -> Iterator[Event]:
        """Yield its events, those of one actor after the other."""
        for events in self.events.values():
            yield from events

    def add(self, actor: str | None, event: Event) -> None:
        """Add an event."""
        self.events.setdefault(actor, []).append(event)


def _in_order(group: Group, *, is_lazy: bool) -> Group:
    """Put a group in the order in which tools look at it: they stop at the first that is false.

    What stays true comes first: it says from when on the others count. Edges come next, so that
    they are looked at in each step; else they would miss what they wait for. For tools that do not
    take the first look for a change, events come before all: one may occur when the others begin
    to count. That the run has begun is left out where there is more to say.
    """
    telling = tuple(test for test in group if test.reached != 0.0) or group[:1]

    def rank(test: Test) -> tuple[bool, bool, bool]:
        is_event = test.edge != "none" and any(test.condition.below(xml.VariableCondition))
        return not (is_lazy and is_event), not test.latched, test.edge == "none"

    return tuple(sorted(telling, key=rank))


Trigger = TypeVar("Trigger", xml.StartTrigger, xml.StopTrigger)


class StoryboardWriter:
    """Writes acts as elements."""

    def __init__(self, version: XmlVersion, *, is_lazy: bool = False) -> None:
        """Take the version of the document; whether the tool is lazy, as in `ToolProfile`."""
        self._version, self._is_lazy = version, is_lazy

    def story(self, name: str, acts: Iterable[Act]) -> xml.Story:
        """Return the story of all acts."""
        return xml.Story(*(self._act(act) for act in acts), name=name)

    def trigger(self, kind: type[Trigger], flow: Flow, name: str) -> Trigger:
        """Return a trigger of a kind; its conditions have a name and numbers."""
        names = Names()
        groups = [
            xml.ConditionGroup(
                *(
                    xml.Condition(
                        self._condition(test),
                        name=names.new(name),
                        delay=test.delay,
                        conditionEdge=test.edge,
                    )
                    for test in _in_order(group, is_lazy=self._is_lazy)
                )
            )
            for group in flow.groups
        ]
        return kind(*groups)

    def _condition(self, test: Test) -> xml.ConditionPart:
        if test.reached is not None and self._version == "1.0":
            value = max(test.reached - SHORTLY, 0.0)
            condition = xml.SimulationTimeCondition(value=value, rule="greaterThan")
            return xml.ByValueCondition(condition)
        return test.condition

    def _act(self, act: Act) -> xml.Act:
        stop = None if act.stop.is_never else self.trigger(xml.StopTrigger, act.stop, "stop")
        return xml.Act(
            *(self._group(actor, events) for actor, events in act.events.items()),
            self.trigger(xml.StartTrigger, act.start, "start"),
            stop,
            name=act.name,
        )

    def _group(self, actor: str | None, events: Sequence[Event]) -> xml.ManeuverGroup:
        name = actor or "scenario"
        reference = None if actor is None else xml.EntityRef(entityRef=actor)
        return xml.ManeuverGroup(
            xml.Actors(reference, selectTriggeringEntities=False),
            xml.Maneuver(*(self._event(event) for event in events), name=name),
            name=name,
            maximumExecutionCount=1,
        )

    def _event(self, event: Event) -> xml.Event:
        names = Names()
        return xml.Event(
            *(xml.Action(action, name=names.new(ACTION)) for action in event.actions),
            self.trigger(xml.StartTrigger, event.start, "start"),
            name=event.name,
            priority="parallel",
            maximumExecutionCount=event.repeats,
        )

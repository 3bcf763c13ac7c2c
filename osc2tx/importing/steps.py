"""Events of a storyboard as steps: what happens, and what starts it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import field

from osc2tx.importing.actions import Actions
from osc2tx.importing.conditions import Conditions, Trigger
from osc2tx.importing.cursor import Node
from osc2tx.importing.effects import Effect
from osc2tx.importing.names import Names, short
from osc2tx.importing.statements import Statement, composed
from osc2tx.importing.values import Values
from osc2tx.xosc.element import Element, Unresolved
from osc2tx_shared.classes import dataclass

MOST_REPEATS = 20
STARTS = ("startTransition", "runningState")
ENDS = ("endTransition", "completeState", "stopTransition")


@dataclass(eq=False)
class Step:
    """An event.

    Attributes:
        label: Its name in the scenario.
        effects: What its actions do.
        triggers: What starts the act, then what starts the event.
        act: Number of the act.
        maneuver: Number of the maneuver.
        overrides: Whether it ends the events of its maneuver that are going on.
        node: Where it stands.
        comments: Those of the document in it.
        successors: Events that start at its end.
    """

    label: str
    effects: list[Effect]
    triggers: tuple[Trigger, Trigger]
    act: int
    maneuver: int
    overrides: bool
    node: Node
    comments: list[str] = field(default_factory=list)
    successors: list[Step] = field(default_factory=list)

    @property
    def trigger(self) -> Trigger:
        """The trigger that comes last: of the event, else of the act."""
        return self.triggers[0] if self.triggers[1].is_immediate else self.triggers[1]

    @property
    def slots(self) -> set[tuple[str, str]]:
        """The motions that it controls."""
        return {(each.actor, slot) for each in self.effects for slot in each.slots}

    @property
    def moved(self) -> set[str]:
        """The actors that it moves, and those whose motions it controls."""
        return self.actors | {actor for actor, _ in self.slots}

    @property
    def actors(self) -> set[str]:
        """The actors that it moves."""
        return {each.actor for each in self.effects if each.actor}

    @property
    def statement(self) -> Statement:
        """What happens in it."""
        members = [each.statement for each in self.effects]
        instant = [each for each in members if each.length == 0.0]
        lasting = [each for each in members if each.length != 0.0]
        found = composed(
            "serial", [*instant, *([composed("parallel", lasting)] if lasting else [])]
        )
        found.label = self.label if self.label else found.label
        found.comments = [*self.comments, *found.comments]
        return found


@dataclass(eq=False)
class Block(Step):
    """An act that is stopped, as one event.

    Attributes:
        inner: Its events.
        stop: What stops it.
    """

    inner: list[Step] = field(default_factory=list)
    stop: Trigger = field(default_factory=Trigger)


@dataclass(eq=False)
class Branch:
    """What happens one after the other, from the start of the scenario on.

    Attributes:
        steps: The events in it.
        members: Its statements.
    """

    steps: list[Step] = field(default_factory=list)
    members: list[Statement] = field(default_factory=list)

    @property
    def actors(self) -> set[str]:
        """The actors that it moves."""
        return {actor for step in self.steps for actor in step.actors}

    @property
    def slots(self) -> set[tuple[str, str]]:
        """The motions that it controls."""
        return {slot for step in self.steps for slot in step.slots}


@dataclass
class Board:
    """The storyboard.

    Attributes:
        steps: Its events in their order.
        elements: The events of each element, by its kind and name.
        stops: What stops acts, by their numbers.
        end: What ends it.
    """

    steps: list[Step] = field(default_factory=list)
    elements: dict[tuple[str, str], list[Step]] = field(default_factory=dict)
    stops: dict[int, Trigger] = field(default_factory=dict)
    end: Trigger = field(default_factory=Trigger)


class BoardReader:
    """Reads the stories of a document."""

    def __init__(
        self,
        values: Values,
        names: Names,
        actions: Actions,
        conditions: Conditions,
        comments_of: Callable[[Element], list[str]],
    ) -> None:
        self._values, self._names = values, names
        self._actions, self._conditions = actions, conditions
        self._comments_of = comments_of
        self._maneuvers = 0
        self._around: list[str] = []
        self.board = Board()

    def read(self, storyboard: Node) -> Board:
        """Return the storyboard."""
        number = 0
        for story in storyboard.children("Story"):
            for act in story.children("Act"):
                number += 1
                first = len(self.board.steps)
                with self._within(story):
                    with self._within(act):
                        self._act(act, number)
                    self._know("act", act, self.board.steps[first:])
                self._know("story", story, self.board.steps[first:])
            for each in story.children("ParameterDeclarations"):
                if each.element.children:
                    each.leave_out("parameters of a story are not imported")
        self.board.end = self._conditions.trigger(storyboard.find("StopTrigger"))
        return self.board

    def _know(self, kind: str, node: Node, steps: Sequence[Step]) -> None:
        """Note the steps of an element, by its name and by that with names of those around it."""
        name = node.element.get("name") or ""
        for index in range(len(self._around), -1, -1):
            key = "::".join((*self._around[index:], name))
            self.board.elements.setdefault((kind, key), []).extend(steps)

    @contextmanager
    def _within(self, node: Node) -> Iterator[None]:
        """Let what is read be known as a part of an element."""
        self._around.append(node.element.get("name") or "")
        yield
        self._around.pop()

    def _act(self, act: Node, number: int) -> None:
        trigger = self._conditions.trigger(act.find("StartTrigger"))
        stop = act.find("StopTrigger")
        if stop is not None and stop.element.children:
            self.board.stops[number] = self._conditions.trigger(stop)
        for group in act.children("ManeuverGroup"):
            first = len(self.board.steps)
            actors = list(self._actors(group))
            repeats = self._repeats(group)
            for maneuver in self._maneuvers_of(group):
                self._maneuvers += 1
                start = len(self.board.steps)
                with self._within(group):
                    with self._within(maneuver):
                        for event in maneuver.children("Event"):
                            self._event(event, actors, trigger, number, repeats)
                    self._know("maneuver", maneuver, self.board.steps[start:])
            self._know("maneuverGroup", group, self.board.steps[first:])

    def _actors(self, group: Node) -> Iterator[str]:
        holder = group.find("Actors")
        if holder is None:
            return
        if (holder.text("selectTriggeringEntities") or "false").lower() in ("true", "1"):
            holder.approximate("actors are those that are named, not those that trigger")
        for ref in holder.children("EntityRef"):
            yield self._values.text(ref, "entityRef")

    def _maneuvers_of(self, group: Node) -> Iterator[Node]:
        yield from group.children("Maneuver")
        for reference in group.children("CatalogReference"):
            entry = self._values.entry(reference)
            if entry is not None:
                yield entry

    def _repeats(self, node: Node) -> int:
        count = self._values.fixed(node, "maximumExecutionCount", 1.0)
        if count > MOST_REPEATS:
            node.approximate(f"of {count:g} executions only the first is here")
            return 1
        return max(int(count), 1)

    def _event(
        self, event: Node, actors: Sequence[str], act: Trigger, number: int, repeats: int
    ) -> None:
        said = event.text("name") or ""
        priority = event.text("priority") or "parallel"
        if priority == "skip":
            event.approximate("it starts even if another event of its maneuver is going on")
        try:
            repeats = max(repeats, self._repeats(event))
        except Unresolved as error:
            event.leave_out(error.reason)
        trigger = self._conditions.trigger(event.find("StartTrigger"))
        never = any(each.kind == "never" for group in trigger.groups for each in group)
        never = never or any(each.kind == "never" for group in act.groups for each in group)
        if never:
            event.leave_out("its trigger is never met here")
            return
        label = self._names.new(said, kind="event", base=short(said))
        effects: list[Effect] = []
        self._actions.readings.begin = max(act.time, trigger.time)
        for action in event.children("Action"):
            for each in action.children():
                effects += self._actions.effects(each, actors)
        if repeats > 1:
            event.approximate(f"of {repeats} executions only the first is here")
        overrides = priority in ("override", "overwrite")
        step = Step(label, effects, (act, trigger), number, self._maneuvers, overrides, event)
        step.comments = self._comments_of(event.element)
        self.board.steps.append(step)
        self._know("event", event, [step])
        with self._within(event):
            for action in event.children("Action"):
                self._know("action", action, [step])

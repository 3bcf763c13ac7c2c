"""Reads the stories of a document as steps.

Events and groups that are executed several times are steps of their own each time. An execution
starts when the one before it is over. A condition that is met at one instant is not met again; a
time or an end that has come is not waited for again.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager

from osc2tx.importing.actions import Actions
from osc2tx.importing.conditions import Condition, Conditions, Trigger
from osc2tx.importing.cursor import Node
from osc2tx.importing.effects import Effect
from osc2tx.importing.names import Names, short
from osc2tx.importing.steps import Board, Step
from osc2tx.importing.values import Values
from osc2tx.xosc.element import Element, Unresolved
from osc2tx_shared.classes import replace

MOST_EXECUTIONS = 5
"""Of events and groups with more there is only the first one."""
ONLY_FIRST = "of {:g} executions only the first is here"


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
            self._group(group, trigger, number)

    def _group(self, group: Node, act: Trigger, number: int) -> None:
        """Read the executions of a group of maneuvers."""
        first, actors = len(self.board.steps), list(self._actors(group))
        maneuvers, times = list(self._maneuvers_of(group)), self._executions(group)
        before: list[Step] = []
        for execution in range(times):
            start = len(self.board.steps)
            is_whole = all([self._maneuver(each, group, actors, act, number) for each in maneuvers])
            steps = self.board.steps[start:]
            if times > 1:
                _name_within(steps, self.board, execution)
            if before:
                _put_behind(steps, before, self.board)
            if execution + 1 < times and not self._repeats(steps, group, is_whole):
                break
            before = steps
        self._know("maneuverGroup", group, self.board.steps[first:])

    def _repeats(self, steps: Sequence[Step], node: Node, is_whole: bool) -> bool:
        """Whether what has been executed comes again as a whole; a finding says if parts do."""
        if not is_whole or not steps:
            return False
        comes = [each for each in steps if _may_start_again(each, steps, self.board)]
        if len(comes) == len(steps):
            return True
        if any(_is_first(each, steps, self.board) for each in comes):
            count = self._values.fixed(node, "maximumExecutionCount", 1.0)
            node.approximate(ONLY_FIRST.format(count))
        return False

    def _maneuver(
        self, maneuver: Node, group: Node, actors: Sequence[str], act: Trigger, number: int
    ) -> bool:
        """Read a maneuver; return whether all of its events may come."""
        self._maneuvers += 1
        start = len(self.board.steps)
        with self._within(group):
            with self._within(maneuver):
                events = list(maneuver.children("Event"))
                found = [self._event(event, actors, act, number) for event in events]
            self._know("maneuver", maneuver, self.board.steps[start:])
        return all(found)

    def _actors(self, group: Node) -> Iterator[str]:
        holder = group.find("Actors")
        if holder is None:
            return
        if holder.is_true("selectTriggeringEntities"):
            holder.approximate("actors are those that are named, not those that trigger")
        for ref in holder.children("EntityRef"):
            yield self._values.text(ref, "entityRef")

    def _maneuvers_of(self, group: Node) -> Iterator[Node]:
        yield from group.children("Maneuver")
        for reference in group.children("CatalogReference"):
            if (found := self._values.entry(reference)) is not None:
                yield found[0]

    def _executions(self, node: Node) -> int:
        """Return how often an event or a group is executed at most."""
        count = self._values.fixed(node, "maximumExecutionCount", 1.0)
        if count > MOST_EXECUTIONS:
            node.approximate(ONLY_FIRST.format(count))
            return 1
        return max(int(count), 1)

    def _event(self, event: Node, actors: Sequence[str], act: Trigger, number: int) -> bool:
        """Read the executions of an event; return whether it may come."""
        said = event.text("name") or ""
        priority = event.text("priority") or "parallel"
        if priority == "skip":
            event.approximate("it starts even if another event of its maneuver is going on")
        times = 1
        try:
            times = self._executions(event)
        except Unresolved as error:
            event.leave_out(error.reason)
        steps: list[Step] = []
        for _ in range(times):
            trigger = self._conditions.trigger(event.find("StartTrigger"))
            if any(each.kind == "never" for on in (act, trigger) for g in on.groups for each in g):
                event.leave_out("its trigger is never met here")
                return False
            label = self._names.new("" if steps else said, kind="event", base=short(said))
            self._actions.readings.begin = max(act.time, trigger.time)
            effects = list(self._effects(event, actors))
            overrides = priority in ("override", "overwrite")
            step = Step(label, effects, (act, trigger), number, self._maneuvers, overrides, event)
            step.comments = self._comments_of(event.element)
            if steps:
                _put_behind([step], steps[-1:], self.board)
            steps.append(step)
            if len(steps) == times or not self._repeats([step], event, True):
                break
            if not effects:  # what comes again does nothing
                event.approximate(ONLY_FIRST.format(times))
                break
        self.board.steps += steps
        self._know("event", event, steps)
        with self._within(event):
            for action in event.children("Action"):
                self._know("action", action, steps)
        return True

    def _effects(self, event: Node, actors: Sequence[str]) -> Iterator[Effect]:
        for action in event.children("Action"):
            for each in action.children():
                yield from self._actions.effects(each, actors)


def _may_start_again(step: Step, group: Collection[Step], board: Board) -> bool:
    """Whether an event starts another time, if the events of its group do."""
    return _again(step.triggers[1], group, board) is not None


def _is_first(step: Step, group: Collection[Step], board: Board) -> bool:
    """Whether an event waits for none of its group."""
    conditions = (each for group_ in step.triggers[1].groups for each in group_)
    return not any(_is_inside(each, group, board) for each in conditions)


def _put_behind(steps: Sequence[Step], before: Sequence[Step], board: Board) -> None:
    """Let the steps of an execution start when those of the one before it are over."""
    for step in steps:
        trigger = _again(step.triggers[1], steps, board)
        assert trigger is not None, "only what may start again is executed again"
        if _is_first(step, steps, board):
            step.before = tuple(before)
        step.triggers = Trigger(), trigger


def _name_within(steps: Sequence[Step], board: Board, execution: int) -> None:
    """Let conditions in an execution of a group be about the events of that execution."""
    for step in steps:
        act, event = step.triggers
        groups = [[_named(each, steps, board, execution) for each in g] for g in event.groups]
        step.triggers = act, Trigger(groups, event.node, event.after)


def _named(condition: Condition, steps: Sequence[Step], board: Board, execution: int) -> Condition:
    inside = _inside(condition, steps, board)
    if not inside:
        return condition
    kind, name = condition.element
    element = kind, f"{name} ({inside[0].label}, {execution})"
    board.elements[element] = inside
    return replace(condition, element=element)


def _inside(condition: Condition, steps: Collection[Step], board: Board) -> list[Step]:
    if condition.kind != "state":
        return []
    return [each for each in board.elements.get(condition.element, ()) if each in steps]


def _is_inside(condition: Condition, steps: Collection[Step], board: Board) -> bool:
    return bool(_inside(condition, steps, board))


def _again(trigger: Trigger, steps: Collection[Step], board: Board) -> Trigger | None:
    """Return what is waited for in another execution; `None`: it does not come again."""
    groups = []
    for group in trigger.groups:
        found = [(each, _is_inside(each, steps, board)) for each in group]
        if any(not inside and _is_momentary(each) for each, inside in found):
            continue
        groups.append([_lasting(each) for each, inside in found if inside or not _stays(each)])
    return Trigger(groups, trigger.node, trigger.after) if groups or not trigger.groups else None


def _is_momentary(condition: Condition) -> bool:
    """Whether a condition is met at a single instant."""
    return condition.is_once or condition.state.endswith("Transition")


def _stays(condition: Condition) -> bool:
    """Whether a condition is met for good once it is met."""
    return condition.kind == "time" or condition.state == "completeState"


def _lasting(condition: Condition) -> Condition:
    """Return a condition on an event that has come as one on what it leaves behind."""
    if condition.kind != "event" or not condition.kept:
        return condition
    return replace(condition, kind="expression", text=condition.kept)

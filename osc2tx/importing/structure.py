"""The order of events as compositions.

An event that starts at the end of another one comes after it. Events that start at times come one
after the other where they move the same; what is then still going on ends. Only where the order
of two events is not known before the run, one overrides the other.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field
from functools import cached_property

from osc2tx.importing.conditions import Condition, Trigger
from osc2tx.importing.dimensions import TIME, Quantity, literal
from osc2tx.importing.program import Statement, composed, wait
from osc2tx.importing.steps import ENDS, Board, Step
from osc2tx.importing.waiting import STARTS, Waiting, minus, nominal_start, start_of
from osc2tx_shared.classes import dataclass


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


class Structure:
    """Finds the order of the events of a storyboard.

    Attributes:
        lines: Declarations that the order needs: events, overrides.
        references: How often the scenario refers to statements, by their labels.
    """

    def __init__(
        self, board: Board, name_event: Callable[[str], str], going_on: Mapping[str, str]
    ) -> None:
        """Take the storyboard.

        Args:
            board: The storyboard.
            name_event: Gives a name for an event of the scenario.
            going_on: The action that goes on, by actor.
        """
        self._board, self._going_on = board, going_on
        self._waiting = Waiting(board, name_event)
        self.lines = self._waiting.lines
        self.waits = self._waiting.waits
        self.references = self._waiting.references
        self._predecessor = self._waiting.predecessor
        for step in board.steps:
            step.triggers = (step.triggers[0], self._of_others(step, step.triggers[1]))
        for step in board.steps:
            self._order(step)

    def _of_others(self, step: Step, trigger: Trigger) -> Trigger:
        """Return a trigger without the start of what the step is in, which has come."""
        groups = []
        for group in trigger.groups:
            others = [each for each in group if not self._is_own_start(each, step)]
            late = [each for each in group if each not in others and each.delay is not None]
            if late and not step.triggers[0].is_immediate:
                groups.append(group)
                continue
            now = Quantity(literal(0.0, TIME), 0.0)
            times = [Condition("time", each.node, quantity=now, delay=each.delay) for each in late]
            groups.append([*others, *times])
        return Trigger(groups, trigger.node)

    def _is_own_start(self, condition: Condition, step: Step) -> bool:
        is_start = condition.kind == "state" and condition.state in STARTS
        return is_start and step in self._board.elements.get(condition.element, ())

    # --- who follows whom -------------------------------------------------------------------------

    def _order(self, step: Step) -> None:
        """Put a step behind the one whose end starts it."""
        found = [each for each in self._ends_in(step.trigger) if each is not step]
        if len(found) == 1 and not self._leads_to(step, found[0]):
            self._predecessor[step] = found[0]
            found[0].successors.append(step)

    def _leads_to(self, first: Step, last: Step) -> bool:
        if not first.successors:
            return False
        at: Step | None = last
        while at is not None:
            if at is first:
                return True
            at = self._predecessor.get(at)
        return False

    def _ends_in(self, trigger: Trigger) -> list[Step]:
        """Return the steps whose ends a trigger waits for."""
        if len(trigger.groups) != 1:
            return []
        return [
            step
            for condition in trigger.groups[0]
            if condition.kind == "state" and condition.state in ENDS
            if self._waiting.stopped_act(condition) is None
            for step in self._waiting.steps_of(condition)
        ]

    # --- compositions -----------------------------------------------------------------------------

    def branches(self) -> list[Branch]:
        """Return what runs side by side from the start on."""
        roots = [step for step in self._board.steps if step not in self._predecessor]
        found: list[Branch] = []
        for group in self._groups(roots):
            timed = [start_of(step) for step in group]
            if len(group) > 1 and all(time is not None for time in timed):
                found.append(self._timeline(group))
                continue
            made = [Branch(list(_below(step)), self._chain(step)) for step in group]
            self._override(made)
            found += made
        for condition in (each for group in self._board.end.groups for each in group):
            self._waiting.stopped_act(condition)  # the end of the scenario may wait for it
        for number, trigger in self._board.stops.items():
            found = self._stopped(number, trigger, found)
        return found

    def _groups(self, roots: Sequence[Step]) -> list[list[Step]]:
        """Return the roots in groups of those that move the same."""
        order = {step: index for index, step in enumerate(self._board.steps)}
        found: list[tuple[list[Step], set[str]]] = []  # with all that a group moves
        for root in roots:
            moved = {actor for step in _below(root) for actor in step.moved}
            group, others = [root], []
            for each, its in found:
                if moved.isdisjoint(its) or not any(_conflict(root, other) for other in each):
                    others.append((each, its))
                else:
                    group, moved = [*each, *group], moved | its
            found = [*others, (sorted(group, key=order.__getitem__), moved)]
        return sorted((group for group, _ in found), key=lambda group: order[group[0]])

    def _chain(self, step: Step, *, waits: bool = True) -> list[Statement]:
        """Return a step with what follows it, and with what waits for it unless told otherwise."""
        found: list[Statement] = []
        pending = self._waits_of(step) if waits else []
        at = step
        while True:
            if at.effects or at.label in self._referred_labels:
                found += [*pending, self._statement(at)]
                pending = []
            if len(at.successors) != 1:
                break
            at = at.successors[0]
            pending += self._waits_of(at)
        followers = [chain for each in at.successors if (chain := self._chain(each))]
        if followers:
            beside = [composed("serial", each) for each in followers]
            found += [*pending, composed("parallel", beside)]
        return found

    def _waits_of(self, step: Step) -> list[Statement]:
        act, event = step.triggers
        behind = self._predecessor.get(step)
        if behind is not None and not event.is_immediate:
            return self.waits(event, behind)
        return self.waits(act, behind) + self.waits(event, behind)

    @cached_property
    def _referred_labels(self) -> set[str]:
        """Labels of steps whose starts or ends are waited for."""
        triggers = [trigger for step in self._board.steps for trigger in step.triggers]
        return {
            step.label
            for trigger in (*triggers, self._board.end)
            for group in trigger.groups
            for condition in group
            if condition.kind == "state"
            for step in self._waiting.steps_of(condition)
        }

    def _statement(self, step: Step) -> Statement:
        if step.effects:
            return step.statement
        if f"event {step.label}" not in self.lines:
            self.lines.append(f"event {step.label}")
        return Statement(f"emit {step.label}", comments=step.comments, length=0.0)

    def _timeline(self, group: Sequence[Step]) -> Branch:
        """Return steps at times, one after the other; what is still going on ends."""
        ordered = sorted(group, key=lambda step: nominal_start(step).value)
        branch = Branch([each for step in ordered for each in _below(step)])
        for index, step in enumerate(ordered):
            start = nominal_start(step)
            if index == 0 and start.value > 0.0:
                branch.members.append(wait(f"elapsed({start.text})"))
            content = self._chain(step, waits=False)
            if index + 1 == len(ordered):
                branch.members += content
                break
            gap = minus(nominal_start(ordered[index + 1]), start)
            if gap.value <= 0.0:
                at_once = [each for each in content if each.length == 0.0]
                branch.members += at_once if len(at_once) == len(content) else []
                if len(at_once) < len(content):
                    step.node.leave_out("an event of the same time replaces it at once")
                continue
            branch.members += self._for_a_time(content, gap, step)
        return branch

    def _for_a_time(
        self, content: Sequence[Statement], gap: Quantity, step: Step
    ) -> list[Statement]:
        """Return statements that are over after a time, and last until then."""
        if not content:
            return [wait(f"elapsed({gap.text})")]
        lengths = [each.length for each in content]
        total = sum(each for each in lengths if each is not None)
        if None not in lengths and total <= gap.value + 1e-9:
            if abs(total - gap.value) < 1e-9:
                return list(content)
            left = gap.text if total == 0.0 else literal(round(gap.value - total, 6), TIME)
            if total > 0.0 and gap.is_open:
                left = f"{gap.text} - {literal(total, TIME)}"
            return [*content, wait(f"elapsed({left})")]
        actors = {actor for each in _below(step) for actor in each.actors}
        last = composed("serial", [*content, *self.go_on(sorted(actors))])
        last.modifiers.append(f"until elapsed({gap.text})")
        last.length = gap.value
        return [last]

    def go_on(self, actors: Sequence[str]) -> list[Statement]:
        """Return what lets actors go on as they do."""
        each = [Statement(self._going_on[actor], length=math.inf) for actor in actors]
        return [composed("parallel", each)] if each else []

    def _override(self, branches: Sequence[Branch]) -> None:
        """Let steps of different branches end each other, the later ones the earlier."""
        for index, one in enumerate(branches):
            for other in branches[index + 1 :]:
                for a in one.steps:
                    for b in other.steps:
                        pairs = ((a, b), (b, a)) if a.effects and b.effects else ()
                        for ended, by in pairs:
                            if _ends(by, ended):
                                self.lines.append(f"override({ended.label}, {by.label})")
                                self.references.update((ended.label, by.label))

    def _stopped(self, number: int, trigger: Trigger, branches: list[Branch]) -> list[Branch]:
        """Return the branches with those of an act up to what stops it."""
        mine = [each for each in branches if any(step.act == number for step in each.steps)]
        waits = self.waits(trigger)
        is_alone = all(step.act == number for each in mine for step in each.steps)
        until = waits[0] if len(waits) == 1 and waits[0].text.startswith("wait ") else None
        beside = [composed("serial", each.members) for each in mine if each.members]
        label = self._waiting.stopped.get(number, "")
        if not beside or (not label and (until is None or not is_alone)):
            _leave_out(trigger)
            return branches
        whole = beside[0] if len(beside) == 1 else Statement("parallel", members=beside)
        if whole.members is None or whole.label or whole.modifiers:
            whole = Statement("serial", members=[whole])
        whole.label, whole.length = label, None
        if until is None or not is_alone:
            _leave_out(trigger)
        else:
            whole.modifiers.append(f"until {until.text.removeprefix('wait ')}")
        merged = Branch([step for each in mine for step in each.steps], [whole])
        at = branches.index(mine[0])
        others = [each for each in branches if each not in mine]
        return [*others[:at], merged, *others[at:]]


def _leave_out(trigger: Trigger) -> None:
    if trigger.node is not None:
        trigger.node.leave_out("an act that is stopped goes on here")


def _below(step: Step) -> Iterator[Step]:
    """Yield a step and those that follow it."""
    left = [step]
    while left:
        at = left.pop()
        yield at
        left += reversed(at.successors)


def _conflict(one: Step, other: Step) -> bool:
    return any(_conflict_of(a, b) for a in _below(one) for b in _below(other))


def _conflict_of(a: Step, b: Step) -> bool:
    return _ends(a, b) or _ends(b, a)


def _ends(later: Step, earlier: Step) -> bool:
    """Whether a step that starts ends one that has started before, if that still runs."""
    if later.slots & earlier.slots:
        return True
    is_beside = later.overrides and later.maneuver == earlier.maneuver
    return is_beside and bool(later.actors & earlier.actors)

"""The order of events as compositions.

An event that starts at the end of another one comes after it. Events that start at times come one
after the other where they move the same; what is then still going on ends. Only where the order
of two events is not known before the run, one overrides the other.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Collection, Hashable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations

from osc2tx.importing.acts import blocks_of, without_own_start
from osc2tx.importing.cast import Actor
from osc2tx.importing.conditions import Trigger
from osc2tx.importing.dimensions import TIME, Quantity, literal
from osc2tx.importing.joining import Join, joined
from osc2tx.importing.program import EVENT, Declared
from osc2tx.importing.statements import Emit, Statement, When, composed, elapsed, wait
from osc2tx.importing.steps import (
    ENDS,
    Block,
    Board,
    Branch,
    Step,
    below,
    breaks_off,
    conflict,
    moment,
    replaces_at_once,
)
from osc2tx.importing.waiting import Waiting, lateness, minus, nominal_start, start_of

AT_ONCE = elapsed("0s")


class Structure(Waiting):
    """Finds the order of the events of a storyboard."""

    def __init__(
        self, board: Board, name_event: Callable[[str], str], going_on: Mapping[str, Actor]
    ) -> None:
        """Take the storyboard.

        Args:
            board: The storyboard.
            name_event: Gives a name for an event of the scenario.
            going_on: How actors go on, by actor.
        """
        super().__init__(board, name_event)
        self._going_on = going_on
        blocks = blocks_of(board, name_event)
        self._scopes = [board.steps, *(block.inner for block in blocks)]
        for step in (each for scope in self._scopes for each in scope):
            step.triggers = without_own_start(step, board)
        for scope in self._scopes:
            members, at_once = set(scope), defaultdict[Hashable, list[Step]](list)
            for step in scope:
                alike = at_once[moment(step)]
                self._order(step, members, alike)
                alike.append(step)

    # --- who follows whom -------------------------------------------------------------------------

    def _order(self, step: Step, scope: Collection[Step], alike: Sequence[Step]) -> None:
        """Put a step behind the one whose end starts it, or that it replaces at once.

        Args:
            step: The step.
            scope: The steps of its act, or of the document.
            alike: Those before it that start when it does.
        """
        found = self._last_of(step.before) if step.before else []
        if len(found) > 1:
            step.triggers = step.triggers[0], self._behind(step.triggers[1], step)
        found = found or [each for each in self._ends_in(step.trigger) if each is not step]
        if not found:
            found = [each for each in alike if replaces_at_once(step, each)][-1:]
        if len(found) == 1 and found[0] in scope and not self._leads_to(step, found[0]):
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
            for step in self._steps_of(condition)
        ]

    # --- compositions -----------------------------------------------------------------------------

    def branches(self, scope: Sequence[Step] | None = None) -> list[Branch]:
        """Return what runs side by side from the start on, of the scenario or of an act."""
        scope = self._board.steps if scope is None else scope
        roots = [step for step in scope if step not in self._predecessor]
        found: list[Branch] = []
        joins: list[Join] = []
        for group in self._groups(roots):
            timed = [start_of(step) for step in group]
            if len(group) > 1 and all(time is not None for time in timed):
                found.append(self._timeline(group))
                continue
            for step in group:
                branch = Branch(list(below(step)), self._chain(step))
                found.append(branch)
                joins += self._joins(step, branch)
        held = {name: each.goes_on for name, each in self._going_on.items() if not each.is_free}
        found = joined(found, joins, held)
        for join in joins:
            if join.branch not in found:  # nothing waits for the events by their names
                self.references.subtract(list(join.delays))
        self._override(found)
        return found

    def _joins(self, step: Step, branch: Branch) -> Iterator[Join]:
        """Yield a branch as one behind others, if it waits for the ends of several events."""
        trigger = step.trigger
        if len(trigger.groups) != 1 or (
            trigger is step.triggers[1] and not step.triggers[0].is_immediate
        ):
            return
        ends = [each for each in trigger.groups[0] if each.kind == "state" and each.state in ENDS]
        rest = [each for each in trigger.groups[0] if each not in ends]
        delays = {
            each.label: "" if end.delay is None else end.delay.text
            for end in ends
            for each in self._steps_of(end)
        }
        is_plain = all(each.kind == "expression" and lateness(each) == 0.0 for each in rest)
        if len(delays) > 1 and is_plain:
            waits = self.waits(Trigger([rest], trigger.node, trigger.after))
            yield Join(branch, delays, [*waits, *self._chain(step, waits=False)])

    def _groups(self, roots: Sequence[Step]) -> list[list[Step]]:
        """Return the roots in groups of those that move the same."""
        order = {root: index for index, root in enumerate(roots)}
        found: list[tuple[list[Step], set[str]]] = []  # with all that a group moves
        for root in roots:
            moved = {actor for step in below(root) for actor in step.moved}
            group, others = [root], []
            for each, its in found:
                if moved.isdisjoint(its) or not any(conflict(root, other) for other in each):
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
            if at.effects or isinstance(at, Block) or at.label in self._referred_labels:
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
        if behind is not None and replaces_at_once(step, behind):
            return []
        found = self.waits(event, behind)
        if behind is None or event.is_immediate:
            found = self.waits(act, behind) + found
        return [each for each in found if each.does != AT_ONCE]

    @property
    def events(self) -> list[Step]:
        """The events of the document."""
        return [step for scope in self._scopes for step in scope if not isinstance(step, Block)]

    @cached_property
    def _referred_labels(self) -> set[str]:
        """Labels of steps whose starts or ends are waited for."""
        steps = [step for scope in self._scopes for step in scope]
        triggers = [trigger for step in steps for trigger in step.triggers]
        stops = [step.stop for step in steps if isinstance(step, Block)]
        return {
            step.label
            for trigger in (*triggers, *stops, self._board.end)
            for group in trigger.groups
            for condition in group
            if condition.kind == "state"
            for step in self._steps_of(condition)
        }

    def _statement(self, step: Step) -> Statement:
        if isinstance(step, Block):
            return self._block(step)
        if step.effects:
            return step.statement
        if all(step.label != each.name for each in self.declared):
            self.declared.append(Declared(step.label, EVENT))
        return Statement(Emit(step.label), comments=step.comments, length=0.0)

    def _timeline(self, group: Sequence[Step]) -> Branch:
        """Return steps at times, one after the other; what is still going on ends."""
        ordered = sorted(group, key=lambda step: nominal_start(step).value)
        branch = Branch([each for step in ordered for each in below(step)])
        for index, step in enumerate(ordered):
            start = nominal_start(step)
            if index == 0 and start.value > 0.0:
                branch.members.append(wait(elapsed(start.text)))
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
            return [wait(elapsed(gap.text))]
        lengths = [each.length for each in content]
        total = sum(each for each in lengths if each is not None)
        if None not in lengths and total <= gap.value + 1e-9:
            if abs(total - gap.value) < 1e-9:
                return list(content)
            left = gap.text if total == 0.0 else literal(round(gap.value - total, 6), TIME)
            if total > 0.0 and gap.is_open:
                left = f"{gap.text} - {literal(total, TIME)}"
            return [*content, wait(elapsed(left))]
        actors = {actor for each in below(step) for actor in each.actors}
        last = composed("serial", [*content, *self.go_on(sorted(actors))])
        last.until.append(elapsed(gap.text))
        last.length = gap.value
        return [last]

    def go_on(self, actors: Sequence[str]) -> list[Statement]:
        """Return what lets actors go on as they do."""
        each = [Statement(self._going_on[actor].goes_on, length=math.inf) for actor in actors]
        return [composed("parallel", each)] if each else []

    def _override(self, branches: Sequence[Branch]) -> None:
        """Let steps of different branches end each other, the later ones the earlier."""
        moving: dict[str, list[int]] = {}
        for index, branch in enumerate(branches):
            for actor in {actor for step in branch.steps for actor in step.moved}:
                moving.setdefault(actor, []).append(index)
        pairs = sorted({pair for indices in moving.values() for pair in combinations(indices, 2)})
        for one, other in pairs:
            for a in branches[one].steps:
                for b in branches[other].steps:
                    both = ((a, b), (b, a)) if a.effects and b.effects else ()
                    for ended, by in both:
                        if breaks_off(by, ended):
                            self.declared.append(
                                Declared("", f"override({ended.label}, {by.label})")
                            )
                            self.references.update((ended.label, by.label))

    # --- acts that are stopped --------------------------------------------------------------------

    def _block(self, block: Block) -> Statement:
        """Return an act up to what stops it."""
        beside = [composed("serial", each.members) for each in self.branches(block.inner)]
        whole = composed("parallel", [e for e in beside if e.members or not e.is_composed])
        ways = [self.waits(Trigger([group])) for group in block.stop.groups]
        ends = [each.does for way in ways for each in way if isinstance(each.does, When)]
        if len(ends) == len(ways) and all(len(way) == 1 for way in ways):
            if not (whole.is_composed and whole.is_plain):
                whole = Statement("serial", members=[whole])
            whole.until += ends
        else:
            whole = composed("one_of", [whole, *(composed("serial", way) for way in ways)])
        whole.label = block.label if block.label in self._referred_labels else ""
        whole.length = None
        return whole

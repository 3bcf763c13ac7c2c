"""The behavior of a scenario: how it begins, its branches, how it ends."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from osc2tx.importing.cast import Cast
from osc2tx.importing.conditions import Trigger
from osc2tx.importing.document import Document
from osc2tx.importing.effects import LONGITUDINAL
from osc2tx.importing.endings import (
    Waits,
    ends_of,
    ends_with,
    first_of,
    go_on_behind,
    held_for,
    is_open,
    is_over,
    may_end,
    single,
    up_to_end,
    without_events,
)
from osc2tx.importing.libraries import STARTS, Shared
from osc2tx.importing.names import Names
from osc2tx.importing.report import Finding, ImportReport
from osc2tx.importing.starts import Starts
from osc2tx.importing.statements import (
    Statement,
    When,
    composed,
    elapsed,
    ended,
    happens,
    seconds,
    wait,
    without_labels,
)
from osc2tx.importing.steps import Branch
from osc2tx.importing.structure import Structure
from osc2tx.importing.wording import with_starts, worded

LONGEST = "60s"
"""How long a scenario runs whose document has no end."""


class Whole:
    """Composes the behavior."""

    def __init__(
        self, document: Document, cast: Cast, names: Names, report: ImportReport, shared: Shared
    ) -> None:
        self._document, self._cast, self._names, self._report = document, cast, names, report
        self._shared = shared

    def behavior(
        self, structure: Structure, branches: Sequence[Branch], inits: Starts, end: Trigger
    ) -> Statement:
        """Return the behavior of branches, with their starts and what ends it."""
        endings = self._endings(structure, end)
        branches, endings = without_events(branches, endings)
        members = _Members(self._cast, inits, branches)
        begun = [*members.begin(), *inits.ways()]
        course = self._composed(structure, begun, members, endings)
        kept = {label for label, count in structure.references.items() if count > 0}
        told = without_labels(_behind(members.leading, course), kept)
        told = worded(told)
        if self._shared.is_used:
            told = with_starts(told)
            for name in sorted({each.action for each in told.calls} & STARTS.keys()):
                self._shared.add_start(name)
        return told

    def _endings(self, structure: Structure, end: Trigger) -> list[Waits]:
        """Return what ends the scenario, each way of it as what is waited for."""
        if not is_endless(end):
            groups = (structure.waits(Trigger([group])) for group in end.groups)
            return [waits or [wait(elapsed("0s"))] for waits in groups]
        reason = f"nothing ends the document; the scenario ends after {LONGEST}"
        place = self._document.root.place
        self._report.add(Finding("approximated", "<StopTrigger>", reason, place))
        return [[wait(elapsed(LONGEST))]]

    def _composed(
        self,
        structure: Structure,
        begun: list[Statement],
        members: _Members,
        endings: Sequence[Waits],
    ) -> list[Statement]:
        """Return all that goes on side by side, up to the end."""
        waits = first_of(endings)
        branches = [each for each in members.branches if members.content(each)]
        if not begun and not branches:
            return waits
        end = seconds(waits)
        lasting = {id(each): members.lasting(each, end) for each in branches}
        may_go_on = all(is_open(each) and may_end(each, end) for each in begun)
        for branch in branches if may_go_on else ():
            rest = ends_with(branch, waits)
            others = [lasting[id(each)] for each in branches if each is not branch]
            if rest is None or any(each is None or not may_end(each, end) for each in others):
                continue
            structure.references.subtract(ends_of(branch.members))
            content = [*members.content(branch), *held_for(members.going(branch), rest)]
            lasting[id(branch)] = composed("serial", content)
            return [composed("parallel", [*begun, *filter(None, lasting.values())])]
        are_held = all(is_open(each) or may_end(each, end) for each in begun)
        if are_held and None not in lasting.values():
            side_by_side = [*begun, *filter(None, lasting.values())]
            if all(may_end(each, end) for each in side_by_side):
                return [composed("parallel", [*side_by_side, composed("serial", waits)])]
            ends = [each for each in map(single, endings) if each is not None]
            if all(map(is_open, side_by_side)) and len(ends) == len(endings):
                return [_until(side_by_side, ends)]
            found = (members.held(each) or lasting[id(each)] for each in branches)
        else:
            found = (members.done(each) for each in branches)
        done = [each for each in found if each is not None]
        return [self._up_to(structure, [*begun, *done], endings)]

    def _up_to(
        self, structure: Structure, members: Sequence[Statement], endings: Sequence[Waits]
    ) -> Statement:
        """Return members side by side that may be over before the end, which is waited for."""
        plain = [does for each in endings if (does := single(each)) is not None]
        chains = [each for each in endings if single(each) is None]
        if not chains:
            timed = next((each for each in plain if each.time), plain[0])
            return _until([*members, Statement(timed)], plain)
        if len(chains) > 1:
            plain, chains = [], list(endings)
        end = composed("serial", first_of(chains))
        end.label = self._names.new("", kind="event", base="finished")
        structure.references[end.label] += 1
        return _until([*members, end], [happens(f"{end.label}.end"), *plain])


def _behind(leading: Sequence[Statement], course: Sequence[Statement]) -> Statement:
    """Return what happens behind what takes no time; what ends it ends all."""
    *before, last = course
    is_plain = not (before or last.label or last.modifiers or last.comments or last.duration)
    if leading and is_plain and last.does == "serial" and all(e.length == 0.0 for e in leading):
        members = [*leading, *last.members]
        return Statement("serial", members=members, until=last.until, length=last.length)
    return composed("serial", [*leading, *course])


def _until(members: Sequence[Statement], ends: Sequence[When]) -> Statement:
    """Return members side by side up to the first of some ends."""
    whole = composed("parallel", members)
    if len(ends) == 1 and not whole.is_composed:
        return ended(whole, ends[0])
    if not whole.is_plain:
        whole = Statement("parallel", members=[whole])
    return replace(whole, until=list(ends), length=None)


class _Members:
    """What the actors of a scenario do side by side.

    Attributes:
        branches: What happens, one branch beside the other.
        leading: What comes before all that.
    """

    def __init__(self, cast: Cast, inits: Starts, branches: Sequence[Branch]) -> None:
        self._inits, self.branches = inits, branches
        self._actors = cast.actors
        self._said = {actor.name: said for said, actor in cast.actors.items()}
        self._at = {said: index for index, said in enumerate(cast.actors)}.__getitem__
        self._of: dict[str, list[Branch]] = {each.name: [] for each in cast.actors.values()}
        for branch in branches:
            for name in sorted(branch.actors & self._of.keys()):
                self._of[name].append(branch)
        self._order = inits.order(list(cast.actors))
        self._placed: set[str] = set()
        self.leading: list[Statement] = list(inits.world)
        self._lead()

    def _lead(self) -> None:
        """Put the actors in their places, but those that turn by themselves."""
        single = {id(b) for b in self.branches if len(b.actors) == 1}
        for said in self._order:
            actor = self._actors[said]
            mine = self._of[actor.name]
            is_alone = not mine or (len(mine) == 1 and id(mine[0]) in single)
            stays = is_alone and not self._inits.of[said].has_way and self._inits.turns_alone(said)
            if actor.kind == "movable_object" or not stays:
                self.leading += self._inits.statements(said)
                self._placed.add(said)

    def begin(self) -> list[Statement]:
        """Return what actors do that no branch moves."""
        found: list[Statement] = []
        for said in self._order:
            actor = self._actors[said]
            if branches := self._of[actor.name]:
                slots = {slot for each in branches for slot in each.slots}
                if len(branches) > 1 and (actor.name, LONGITUDINAL) not in slots:
                    found += self._inits.going(said)  # none of them is behind the others
                continue
            if actor.kind == "movable_object":  # without a course of its own it stays where it is
                found += self._inits.lasting(said)
                continue
            if not self._inits.of[said].is_placed:
                continue
            if said in self._placed:
                found += self._inits.lasting(said)
                if not self._inits.lasting(said) and self._inits.of[said].moves:
                    found += self._inits.going(said)
            elif going_on := self._inits.going_on(said):
                if all(each.length == 0.0 for each in going_on):
                    self.leading += going_on
                else:
                    found.append(composed("serial", going_on))
        return found

    def _only_in(self, branch: Branch) -> list[str]:
        return [said for said in self._in(branch) if self._of[self._actors[said].name] == [branch]]

    def _in(self, branch: Branch) -> list[str]:
        """Return the entities that a branch moves, in the order of the document."""
        return sorted(
            (self._said[name] for name in branch.actors if name in self._said), key=self._at
        )

    def content(self, branch: Branch) -> list[Statement]:
        """Return a branch with the starts of its actors, up to its last event."""
        own = [said for said in self._in(branch) if said not in self._placed]
        alone = self._only_in(branch)
        before = [each for said in own for each in self._inits.statements(said, branch.members)]
        content = [*before, *branch.members]
        beside = [each for said in alone for each in self._inits.lasting(said)]
        first = branch.members[0] if branch.members else None
        if first is not None and isinstance(first.does, When):
            content = [*before, *beside, *branch.members]
        elif first is not None and first.is_composed:
            # what is waited for in several ways goes on beside what is done up to then
            up_to = self._first_of([said for said in alone if self._inits.lasting(said)], branch)
            later = composed("serial", branch.members[:up_to])
            held = [up_to_end(each, seconds([later])) for each in beside]
            content = [*before, composed("parallel", [*held, later]), *branch.members[up_to:]]
        return self._held(
            content, [each for each in alone if self._inits.of[each].path is not None]
        )

    def _first_of(self, said: Sequence[str], branch: Branch) -> int:
        """Return how many members of a branch come before the first action of some entities."""
        actors = {self._actors[each].name for each in said}
        for index, member in enumerate(branch.members):
            if index > 0 and any(each.actor in actors for each in member.calls):
                return index
        return len(branch.members)

    def _held(self, content: list[Statement], said: Sequence[str]) -> list[Statement]:
        """Return statements with a first wait during which actors hold their speeds."""
        by = content[0].does if content else None
        if not said or not isinstance(by, When):
            return content
        held = [ended(Statement(self._actors[each].goes_on), by) for each in said]
        return [composed("parallel", held), *content[1:]]

    def going(self, branch: Branch) -> list[Statement]:
        """Return what the actors of a branch go on with that would not do so by themselves."""
        return [each for said in self._only_in(branch) for each in self._inits.going(said)]

    def done(self, branch: Branch) -> Statement | None:
        """Return a branch to its end; `None`: it is empty."""
        content, last = self.content(branch), self.going(branch)
        if content and content[-1].length != math.inf and last:
            content.append(composed("parallel", last))
        return composed("serial", content) if content else None

    def held(self, branch: Branch) -> Statement | None:
        """Return a branch to its end, behind which its actors hold their speeds by themselves.

        `None`: it is empty, or they would not do so.
        """
        is_free = all(self._actors[said].is_free for said in self._in(branch))
        return self.done(branch) if is_free else None

    def lasting(self, branch: Branch, up_to: float | None) -> Statement | None:
        """Return a branch that is over before the end or goes on behind its own; `None`: neither.

        Args:
            branch: The branch.
            up_to: When the scenario ends (s); `None`: not known.
        """
        found = self.done(branch)
        if found is None or is_open(found):
            return found
        if is_over(found, up_to):
            return found
        vehicles = {each.name for each in self._actors.values() if each.kind == "vehicle"}
        last = go_on_behind(branch, self.branches, vehicles)
        return composed("serial", [found, composed("parallel", last)]) if last else None


def is_endless(end: Trigger) -> bool:
    """Whether a trigger of the end is never met."""
    return all(any(each.kind == "never" for each in group) for group in end.groups)

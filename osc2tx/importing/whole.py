"""The behavior of a scenario: how it begins, its branches, how it ends."""

from __future__ import annotations

import math
from collections.abc import Sequence

from osc2tx.importing.cast import Cast
from osc2tx.importing.conditions import Trigger
from osc2tx.importing.document import Document
from osc2tx.importing.names import Names
from osc2tx.importing.program import Statement, composed, wait
from osc2tx.importing.report import ImportReport
from osc2tx.importing.starts import Starts
from osc2tx.importing.structure import Branch, Structure

LONGEST = "60s"
"""How long a scenario runs whose document has no end."""


class Whole:
    """Composes the behavior."""

    def __init__(self, document: Document, cast: Cast, names: Names, report: ImportReport) -> None:
        self._document, self._cast, self._names, self._report = document, cast, names, report

    def behavior(
        self, structure: Structure, branches: Sequence[Branch], inits: Starts, end: Trigger
    ) -> Statement:
        """Return the behavior of branches, with their starts and what ends it."""
        actors = list(self._cast.actors.items())
        leading: list[Statement] = list(inits.world)
        by_name = {
            actor.name: [b for b in branches if actor.name in b.actors] for _, actor in actors
        }
        single = {id(b) for b in branches if len(b.actors) == 1}
        shared = [actor.name for _, actor in actors if len(by_name[actor.name]) > 1]
        members: list[Statement] = []
        placed: set[str] = set()
        is_open = True
        order = inits.order([said for said, _ in actors])
        together = bool(shared) or inits.has_relations
        for said in order:
            actor = self._cast.actors[said]
            mine = by_name[actor.name]
            is_alone = not mine or (len(mine) == 1 and id(mine[0]) in single)
            stays = (
                is_alone and not inits.has_way(said) and (not together or inits.turns_alone(said))
            )
            if actor.kind != "movable_object" and stays:
                continue
            leading += inits.statements(said)
            placed.add(said)
        for said in order:
            actor = self._cast.actors[said]
            if by_name[actor.name] or actor.kind == "movable_object" or not inits.places(said):
                continue
            if said in placed:
                members += inits.lasting(said) or inits.going(said)
            elif going_on := inits.going_on(said):
                if all(each.length == 0.0 for each in going_on):
                    leading += going_on
                else:
                    members.append(composed("serial", going_on))
        ways = inits.ways()
        members += ways
        is_open = not ways
        for branch in branches:
            branch_said = [said for said, actor in actors if by_name[actor.name] == [branch]]
            own = [
                said for said, actor in actors if actor.name in branch.actors and said not in placed
            ]
            before = [each for said in own for each in inits.statements(said, branch.members)]
            content = [*before, *branch.members]
            if branch.members and branch.members[0].text.startswith("wait "):
                lasting = [each for said in branch_said for each in inits.lasting(said)]
                content = [*before, *lasting, *branch.members]
            elif branch.members and branch.members[0].members is not None:
                # what is waited for in several ways goes on beside what is done up to then
                beside = [each for said in branch_said for each in inits.lasting(said)]
                later = composed("serial", branch.members)
                content = [*before, composed("parallel", [*beside, later])]
            content = self._held(content, [s for s in branch_said if inits.has_path(s)])
            last = [
                each
                for said, actor in actors
                if by_name[actor.name] == [branch]
                for each in inits.going(said)
            ]
            if content and content[-1].length != math.inf and last:
                content.append(composed("parallel", last))
            is_open = is_open and content[-1:] != [] and content[-1].length == math.inf
            if content:
                members.append(composed("serial", content))
        if not members and not leading:
            members = [wait(f"elapsed({LONGEST})")]
        return self._ended(structure, leading, members, end, is_open=is_open, branches=branches)

    def _held(self, content: list[Statement], said: Sequence[str]) -> list[Statement]:
        """Return statements with a first wait during which actors hold their speeds."""
        if not said or not content or not content[0].text.startswith("wait "):
            return content
        until = f"until {content[0].text.removeprefix('wait ')}"
        holds = [Statement(self._cast.actors[each].goes_on) for each in said]
        held = composed("parallel", holds)
        held.modifiers.append(until)
        return [held, *content[1:]]

    def _ended(
        self,
        structure: Structure,
        leading: list[Statement],
        members: list[Statement],
        end: Trigger,
        *,
        is_open: bool,
        branches: Sequence[Branch],
    ) -> Statement:
        endings: list[str] = []
        if is_endless(end):
            self._report.add(
                "approximated",
                "<StopTrigger>",
                f"nothing ends the document; the scenario ends after {LONGEST}",
                self._document.root.place,
            )
            endings.append(f"elapsed({LONGEST})")
        for group in () if is_endless(end) else end.groups:
            waits = structure.waits(Trigger([group]))
            if not waits:
                endings.append("elapsed(0s)")
            elif len(waits) == 1 and waits[0].text.startswith("wait "):
                endings.append(waits[0].text.removeprefix("wait "))
            else:
                name = self._names.new("", kind="event", base="finished")
                structure.lines.append(f"event {name}")
                members.append(composed("serial", [*waits, Statement(f"emit {name}")]))
                endings.append(f"@{name}")
        if members and not is_open and len(endings) > 1:
            structure.lines.append("event forever")
            members.append(wait("@forever"))
            is_open = True
        whole = _until(members, endings, is_open=is_open)
        return composed("serial", [*leading, whole]) if leading else whole


def is_endless(end: Trigger) -> bool:
    """Whether a trigger of the end is never met."""
    return all(any(each.kind == "never" for each in group) for group in end.groups)


def _until(members: list[Statement], endings: Sequence[str], *, is_open: bool) -> Statement:
    """Return members side by side that end when one of some conditions is met.

    Args:
        members: What happens.
        endings: The conditions.
        is_open: Whether the members go on until then by themselves.
    """
    if not members:
        return composed("one_of", [wait(each) for each in endings])
    if not is_open:
        members = [*members, wait(endings[0])]
    whole = Statement("parallel", members=members)
    whole.modifiers = [f"until {each}" for each in endings]
    return whole

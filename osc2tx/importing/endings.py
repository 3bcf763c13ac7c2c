"""The end of a scenario as a part of its composition.

What ends the scenario is waited for beside what goes on by itself: the last member of a `parallel`
that ends by itself ends all. What may not have happened by then is ended by an `until`.
"""

from __future__ import annotations

import math
from collections.abc import Container, Sequence

from osc2tx.importing.dimensions import TIME, literal
from osc2tx.importing.effects import LATERAL, LONGITUDINAL
from osc2tx.importing.statements import (
    Call,
    Emit,
    Statement,
    When,
    call,
    composed,
    elapsed,
    ended,
    seconds,
    wait,
)
from osc2tx.importing.steps import Branch
from osc2tx_shared.classes import replace

Waits = list[Statement]
"""What is waited for, one after the other."""


def is_open(statement: Statement) -> bool:
    """Whether only what is around a statement ends it."""
    if statement.until:
        return False
    if statement.does == "serial":
        return is_open(statement.members[-1])
    if statement.does == "parallel":
        return all(is_open(each) for each in statement.members)
    return not statement.is_composed and statement.length == math.inf


def is_over(statement: Statement, at: float | None) -> bool:
    """Whether a statement is over before a time (s) after its start; `None`: not known."""
    length = seconds([statement])
    return length is not None and at is not None and length < at


def may_end(statement: Statement, at: float | None) -> bool:
    """Whether what is around a statement may end it at a time (s) after its start.

    It is over by then, or open-ended and surely so far; `None`: the time is not known.
    """
    if not is_open(statement):
        return is_over(statement, at)
    found = _opening(statement)
    return found == 0.0 or (found is not None and at is not None and found < at)


def _opening(statement: Statement) -> float | None:
    """Return the seconds before the open-ended last members of a statement; `None`: unknown."""
    if statement.does == "serial":
        *before, last = statement.members
        lengths = [seconds(before), _opening(last)]
        return None if None in lengths else sum(filter(None, lengths))
    if statement.does == "parallel":
        lengths = [_opening(each) for each in statement.members]
        return None if None in lengths else max(filter(None, lengths), default=0.0)
    return 0.0


def up_to_end(statement: Statement, at: float | None) -> Statement:
    """Return what goes on, up to a time (s) at which it may not have come as far; `None`: unknown.

    What is around it would wait for its last member.
    """
    if at is None or not is_open(statement) or may_end(statement, at):
        return statement
    by = elapsed(literal(round(at, 9), TIME))
    return replace(statement, until=[*statement.until, by], length=at)


def label_of(statement: Statement) -> str:
    """Return the name of what happens in a statement; `""`: it has none."""
    emitted = statement.does.event if isinstance(statement.does, Emit) else ""
    return statement.label or emitted


def ends_of(members: Sequence[Statement]) -> frozenset[str]:
    """Return the events with the last of which members end; none: that is not known."""
    if not members:
        return frozenset()
    last = members[-1]
    if not last.is_composed or last.is_qualified:
        return frozenset((label_of(last),))
    if last.does == "serial":
        return ends_of(last.members)
    if last.does != "parallel":
        return frozenset()
    inner = [ends_of([each]) for each in last.members if not is_open(each)]
    return frozenset(label for each in inner for label in each) if all(inner) else frozenset()


def without_events(
    branches: Sequence[Branch], endings: Sequence[Waits]
) -> tuple[list[Branch], list[Waits]]:
    """Return branches and ends without the events that only ends wait for.

    A branch that only emits such an event is what an end waits for first.

    Args:
        branches: What happens.
        endings: What ends the scenario, each in another way.
    """
    left, found = list(branches), [list(each) for each in endings]
    for branch in branches:
        event = _emitted_by(branch)
        if event is None:
            continue
        begins = [each for each in found if each and is_event(each[0], event)]
        rest = [each[1:] if each in begins else each for each in found]
        others = [*rest, *(each.members for each in left)]
        own = {event, *(each.label for each in branch.members if each.label)}
        if not begins or any(own & each.names for members in others for each in members):
            continue
        first = branch.members[:-1] or [wait(elapsed("0s"))]
        if comments := branch.members[-1].comments:
            first[0].comments = [*first[0].comments, *comments]
        left.remove(branch)
        found = [[*first, *each[1:]] if each in begins else each for each in found]
    return left, found


def is_event(statement: Statement, event: str) -> bool:
    """Whether a statement waits for an event."""
    return isinstance(statement.does, When) and statement.does.event == event


def _emitted_by(branch: Branch) -> str | None:
    """Return the event that a branch emits when something has happened, if it does no more."""
    if not branch.members or branch.actors:
        return None
    *waits, last = branch.members
    is_waited = all(isinstance(each.does, When) for each in waits)
    return last.does.event if isinstance(last.does, Emit) and is_waited else None


def placed_beside(statement: Statement) -> set[str]:
    """Return the actors that a statement puts beside others."""
    does = statement.does
    found = {name for each in statement.members for name in placed_beside(each)}
    if isinstance(does, Call) and does.action == "assign_position" and statement.modifiers:
        found.add(does.actor)
    return found


def single(waits: Waits) -> When | None:
    """Return the only condition that is waited for; `None`: there are others, or notes."""
    if len(waits) != 1 or not waits[0].is_bare:
        return None
    return waits[0].does if isinstance(waits[0].does, When) else None


def first_of(endings: Sequence[Waits]) -> Waits:
    """Return what waits for the first of several ends; what they begin with alike stands once."""
    if any(not each for each in endings):
        return []
    groups: list[list[Waits]] = []
    for each in endings:
        group = next((other for other in groups if _is_same(other[0][0], each[0])), None)
        if group is None:
            groups.append([each])
        else:
            group.append(each)
    chains = [
        group[0] if len(group) == 1 else [group[0][0], *first_of([each[1:] for each in group])]
        for group in groups
    ]
    if len(chains) == 1:
        return chains[0]
    return [composed("one_of", [composed("serial", each) for each in chains])]


def _is_same(one: Statement, other: Statement) -> bool:
    """Whether statements are the same, comments and labels of plain ones apart."""
    return one.does == other.does if not one.is_composed else one == other


def ends_with(branch: Branch, waits: Sequence[Statement]) -> Waits | None:
    """Return what is waited for behind the last event of a branch; `None`: for another event."""
    if not waits:
        return None
    first, rest = waits[0], list(waits[1:])
    marks = [
        each.members if each.does == "serial" else [each]
        for each in (first.members if first.does == "parallel" else [first])
    ]
    delays = {tuple(each.does for each in mark[1:]) for mark in marks}
    if len(delays) != 1:
        return None
    rest = [*map(Statement, delays.pop()), *rest]
    ends = {f"{label}.end" for label in ends_of(branch.members)}
    is_behind = all(any(is_event(mark[0], end) for end in ends) for mark in marks)
    is_all = all(any(is_event(mark[0], end) for mark in marks) for end in ends)
    is_time = all(isinstance(each.does, When) and each.does.time for each in rest)
    return rest if is_behind and is_all and len(rest) <= 1 and is_time else None


def go_on_behind(branch: Branch, branches: Sequence[Branch], vehicles: Container[str]) -> Waits:
    """Return what the actors of a branch go on with behind it, as they do by themselves.

    Args:
        branch: The branch.
        branches: All of them: what another one moves is its matter.
        vehicles: The actors that hold their lanes.
    """
    found: Waits = []
    others = {slot for each in branches if each is not branch for slot in each.slots}
    for actor in sorted(branch.actors):
        calls = [each for member in branch.members for each in member.calls if each.actor == actor]
        slot = (actor, LONGITUDINAL)
        first = next(each for each in branches if actor in each.actors)
        if slot not in others and (first is branch or slot in branch.slots):
            found.append(Statement(call(actor, "keep_speed"), length=math.inf))
        elif (
            actor in vehicles
            and (actor, LATERAL) not in others
            and all(each.action == "change_lane" and not each.get("offset") for each in calls)
        ):
            found.append(Statement(call(actor, "follow_lane"), length=math.inf))
        else:
            return []
    return found


def held_for(going: Sequence[Statement], rest: Sequence[Statement]) -> Waits:
    """Return what actors go on with for the rest of the scenario; a wait if that is nothing."""
    by = rest[0].does if rest else None
    if not going or not isinstance(by, When):
        return list(rest)
    return [composed("parallel", [ended(each, by) for each in going])]

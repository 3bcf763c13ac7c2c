"""The behavior in fewer words, with the same course.

Times that follow each other are one, a time beside what goes on by itself is its duration, and
what goes on as it did is not said again.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from osc2tx.importing.dimensions import TIME, literal
from osc2tx.importing.endings import is_open
from osc2tx.importing.statements import (
    Call,
    Statement,
    When,
    elapsed,
    keeps_speed,
    seconds,
    wait,
)
from osc2tx_shared.classes import replace


def worded(statement: Statement) -> Statement:
    """Return a statement in fewer words."""
    if not isinstance(statement.does, str):
        return statement
    members = [worded(each) for each in statement.members]
    if statement.does == "serial":
        members = _without_repetition(_with_sums(_flat(members)))
    found = replace(statement, members=members)
    return _with_duration(found) if statement.does == "parallel" else found


def _flat(members: Sequence[Statement]) -> list[Statement]:
    """Return members of a `serial`, with those of plain ones in it."""
    parts = (
        [*each.members] if each.does == "serial" and _is_plain(each) else [each] for each in members
    )
    return [each for part in parts for each in part]


def _time(statement: Statement) -> str:
    """Return the time that a plain wait lasts; `""`: it is none."""
    does = statement.does
    if not isinstance(does, When) or statement.label or statement.is_qualified:
        return ""
    return does.time


def _with_sums(members: Sequence[Statement]) -> list[Statement]:
    """Return members of a `serial`, waits for numbers of seconds that follow each other as one."""
    found: list[Statement] = []
    for each in members:
        pair = [*found[-1:], each]
        added = seconds(pair) if len(pair) == 2 and all(map(_time, pair)) else None
        if added is not None and not each.comments:
            both = wait(elapsed(literal(round(added, 9), TIME)))
            found[-1] = replace(both, comments=found[-1].comments)
        else:
            found.append(each)
    return found


def _without_repetition(members: Sequence[Statement]) -> list[Statement]:
    """Return members of a `serial`, of which the last follows its lane without an end.

    Behind such a change for a time an actor would keep its speed, which it does then anyway.
    """
    *rest, last = members
    if not rest or not _is_plain(last) or not keeps_speed(last):
        return list(members)
    before = _endless(rest[-1])
    is_same = [each.actor for each in before.calls] == [each.actor for each in last.calls]
    return [*rest[:-1], before] if is_same and is_open(before) else list(members)


def _endless(statement: Statement) -> Statement:
    """Return a statement, which follows its lane without an end if it does so at its end."""
    does = statement.does
    if not _is_plain(statement):
        return statement
    if does == "serial":
        *rest, last = statement.members
        return replace(statement, members=[*rest, _endless(last)])
    if not isinstance(does, Call) or does.action != "follow_lane":
        return statement
    arguments = tuple(each for each in does.arguments if each[0] != "duration")
    return replace(statement, does=replace(does, arguments=arguments), length=math.inf)


def _is_plain(statement: Statement) -> bool:
    return not (statement.label or statement.is_qualified or statement.comments)


def _with_duration(statement: Statement) -> Statement:
    """Return a `parallel`, a wait in which is the time that other actions go on for."""
    times = [each for each in statement.members if _time(each) and not each.comments]
    others = [each for each in statement.members if each not in times]
    if len(times) != 1 or statement.label or statement.is_qualified:
        return statement
    time = _time(times[0])
    if len(others) == 1 and others[0].does == "serial":
        only = _filled(others[0], seconds(times))
        return statement if only is None else _beneath(statement, only)
    if not all(isinstance(each.does, Call) and is_open(each) for each in others):
        return statement
    if len(others) > 1:
        return replace(statement, members=others, duration=time)
    return _beneath(statement, _lasting(others[0], time))


def _beneath(statement: Statement, only: Statement) -> Statement:
    """Return what stands for a composition."""
    return replace(only, comments=[*statement.comments, *only.comments])


def _lasting(statement: Statement, time: str) -> Statement:
    """Return an invocation that has no end as one for a time."""
    assert isinstance(statement.does, Call)
    told = replace(statement.does, arguments=(*statement.does.arguments, ("duration", time)))
    return replace(statement, does=told, length=None)


def _filled(statement: Statement, end: float | None) -> Statement | None:
    """Return a `serial` that lasts up to a time (s) after its start; `None`: not known."""
    *rest, last = statement.members
    goes_on = is_open(last)
    length = seconds(rest if goes_on else statement.members)
    if not _is_plain(statement) or end is None or length is None or length >= end:
        return None
    left = literal(round(end - length, 9), TIME)
    if not goes_on:
        return replace(statement, members=[*statement.members, wait(elapsed(left))])
    if not isinstance(last.does, Call) or last.label:
        return None
    return replace(statement, members=[*rest, _lasting(last, left)], length=None)

"""The behavior in fewer words, with the same course.

Times that follow each other are one, a time beside what goes on by itself is its duration, and
what goes on as it did is not said again.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from osc2tx.importing.dimensions import TIME, literal
from osc2tx.importing.endings import is_open, is_over
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

_SECONDS = re.compile(r"(\d+\.?\d*)s")


def worded(statement: Statement) -> Statement:
    """Return a statement in fewer words."""
    if not isinstance(statement.does, str):
        return statement
    members = [worded(each) for each in statement.members]
    if statement.does == "serial":
        members = _without_repetition(_with_sums(members))
    found = replace(statement, members=members)
    return _with_duration(found) if statement.does == "parallel" else found


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
        pair = [_SECONDS.fullmatch(_time(one)) for one in (*found[-1:], each)]
        if len(pair) == 2 and pair[0] and pair[1] and not each.comments:
            added = sum(float(one[1]) for one in pair if one)
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
    """Return a `parallel`, a wait in which is the time that the other members go on for."""
    times = [each for each in statement.members if _time(each) and not each.comments]
    others = [_endless(each) for each in statement.members if each not in times]
    if len(times) != 1 or statement.duration or not any(map(is_open, others)):
        return statement
    time, end = _time(times[0]), seconds(times)
    if not all(is_open(now) or is_over(now, end) for now in others):
        return statement
    if len(others) > 1:
        return replace(statement, members=others, duration=time)
    only = others[0]
    if statement.label or statement.is_qualified:
        return statement
    if isinstance(only.does, Call):
        told = replace(only.does, arguments=(*only.does.arguments, ("duration", time)))
        only = replace(only, does=told, length=None)
    elif only.does in ("serial", "parallel") and not only.duration:
        only = replace(only, duration=time, length=None)
    else:
        return statement
    return replace(only, comments=[*statement.comments, *only.comments])

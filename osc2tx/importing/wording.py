"""The behavior in fewer words, with the same course.

Times that follow each other are one, a time beside what goes on by itself is its duration, and
what goes on as it did is not said again.

Starts of actors are the behaviors that the library has for them: a position and a speed at once are
`begin`. With what keeps that speed from then on, for a time or up to the end, they are `cruise`,
unless something else refers to the actor: at the first instant it would not be there yet.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import takewhile

from osc2tx.importing.dimensions import TIME, literal
from osc2tx.importing.endings import is_open
from osc2tx.importing.libraries import BEGIN, CRUISE
from osc2tx.importing.statements import (
    INDENT,
    LINE,
    Call,
    Statement,
    When,
    call,
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
        [*each.members] if each.does == "serial" and each.is_bare else [each] for each in members
    )
    return [each for part in parts for each in part]


def _time(statement: Statement) -> str:
    """Return the time that a plain wait lasts; `""`: it is none."""
    does = statement.does
    return does.time if isinstance(does, When) and statement.is_plain else ""


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
    if not rest or not last.is_bare or not keeps_speed(last):
        return list(members)
    before = _endless(rest[-1])
    is_same = [each.actor for each in before.calls] == [each.actor for each in last.calls]
    return [*rest[:-1], before] if is_same and is_open(before) else list(members)


def _endless(statement: Statement) -> Statement:
    """Return a statement, which follows its lane without an end if it does so at its end."""
    does = statement.does
    if not statement.is_bare:
        return statement
    if does == "serial":
        *rest, last = statement.members
        return replace(statement, members=[*rest, _endless(last)])
    if not isinstance(does, Call) or does.action != "follow_lane":
        return statement
    arguments = tuple(each for each in does.arguments if each[0] != "duration")
    return replace(statement, does=replace(does, arguments=arguments), length=math.inf)


def _with_duration(statement: Statement) -> Statement:
    """Return a `parallel`, a wait in which is the time that other actions go on for."""
    times = [each for each in statement.members if _time(each) and not each.comments]
    others = [each for each in statement.members if each not in times]
    if len(times) != 1 or not statement.is_plain:
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
    if not statement.is_bare or end is None or length is None or length >= end:
        return None
    left = literal(round(end - length, 9), TIME)
    if not goes_on:
        return replace(statement, members=[*statement.members, wait(elapsed(left))])
    if not isinstance(last.does, Call) or last.label:
        return None
    return replace(statement, members=[*rest, _lasting(last, left)], length=None)


SHORT = LINE - 3 * len(INDENT)
"""Characters of a cruise, which is a member of a `parallel` at most."""


def with_starts(statement: Statement) -> Statement:
    """Return the behavior of a scenario with the starts of the library."""
    return _cruising(_beginning(statement, 1))


def _beginning(statement: Statement, depth: int) -> Statement:
    """Return a statement in which a position and a speed that an actor has at once are one action.

    Args:
        statement: The statement.
        depth: How far its line is indented.
    """
    if not statement.is_composed:
        return statement
    found: list[Statement] = []
    for each in statement.members:
        last = found[-1] if found and statement.does == "serial" else None
        both = None if last is None else _begin(last, each)
        if both is not None and len(INDENT * (depth + 1) + both.text) <= LINE:
            found[-1] = both
        else:
            found.append(_beginning(each, depth + 1))
    return replace(statement, members=found)


def _begin(last: Statement, each: Statement) -> Statement | None:
    """Return two statements as the begin of an actor; `None`: they are none."""
    put, sped = last.does, each.does
    if not (isinstance(put, Call) and isinstance(sped, Call) and put.actor == sped.actor):
        return None
    if (put.action, sped.action) != ("assign_position", "assign_speed") or each.comments:
        return None
    at, speed = put.get("odr_point"), sped.get("")
    if at is None or speed is None or not (last.is_plain and each.is_plain):
        return None
    return replace(last, does=call(put.actor, BEGIN, at, speed))


def _cruising(statement: Statement) -> Statement:
    """Return a behavior in which actors that begin and keep their speeds cruise."""
    members = list(statement.members)
    first = list(takewhile(lambda each: each.length == 0.0, members))
    begins = {does.actor: each for each in first if (does := _call(each, BEGIN)) is not None}
    if statement.does != "serial" or not begins or len(first) == len(members):
        return statement
    at, rest = members[len(first)], members[len(first) + 1 :]
    if at.does == "parallel" and not at.label:
        free = {a: each for a, each in begins.items() if not _is_seen(a, first, at, at.members)}
        beside = [_cruise(free, each) or each for each in at.members]
        now: Statement | None = replace(at, members=beside)
    elif isinstance(at.does, When) and at.does.time and at.is_bare:
        free = {a: each for a, each in begins.items() if not _is_seen(a, first, at, ())}
        now = _for_a_time(free, at.does.time, is_all=free.keys() == begins.keys() and not rest)
    else:
        free = {a: each for a, each in begins.items() if not _is_seen(a, first, at, ())}
        now = _cruise(free, at)
    gone = {each.actor for each in now.calls if each.action == CRUISE} if now else set()
    if now is None or not gone:
        return statement
    first = [each for each in first if each not in [begins[actor] for actor in gone]]
    if first or rest:
        return replace(statement, members=[*first, now, *rest])
    if statement.until and now.until:
        return replace(statement, members=[now])
    return replace(
        now, until=[*now.until, *statement.until], comments=[*statement.comments, *now.comments]
    )


def _call(statement: Statement, action: str) -> Call | None:
    """Return the invocation of an action, if it is no more than that."""
    does = statement.does
    is_it = isinstance(does, Call) and does.action == action and statement.is_plain
    return does if isinstance(does, Call) and is_it else None


def _is_seen(
    actor: str, first: Sequence[Statement], course: Statement, members: Iterable[Statement]
) -> bool:
    """Whether anything at the first instant refers to an actor, but how it begins and goes on."""
    told = [each for each in (*first, *members) if actor not in {c.actor for c in each.calls}]
    texts = [line for each in told if not _waits(each) for line in each.lines(0)]
    texts += [each.text for each in course.until]
    own = [each for each in (*first, *members) if each not in told]
    is_all = all(_call(each, BEGIN) or _call(each, "keep_speed") for each in own)
    return not is_all or any(re.search(rf"\b{actor}\b", text) for text in texts)


def _waits(statement: Statement) -> bool:
    """Whether some time passes before anything else in a statement."""
    first = statement.members[0] if statement.does == "serial" else statement
    return isinstance(first.does, When) and bool(first.does.time)


def _cruise(begins: Mapping[str, Statement], goes_on: Statement) -> Statement | None:
    """Return how an actor goes on as its cruise; `None`: it is none of those that begin."""
    does = _call(goes_on, "keep_speed")
    begin = None if does is None else begins.get(does.actor)
    if does is None or begin is None or not isinstance(begin.does, Call):
        return None
    arguments = (*begin.does.arguments, *does.arguments)
    cruise = replace(begin.does, action=CRUISE, arguments=arguments)
    if len(cruise.text) > SHORT:
        return None
    return replace(goes_on, does=cruise, comments=[*begin.comments, *goes_on.comments])


def _for_a_time(begins: Mapping[str, Statement], time: str, *, is_all: bool) -> Statement | None:
    """Return the cruises of actors for a time, of a single one or of all together."""
    if len(begins) == 1:
        (actor,) = begins
        return _cruise(begins, Statement(call(actor, "keep_speed", duration=time)))
    keeps = [Statement(call(actor, "keep_speed")) for actor in begins]
    cruises = [each for keep in keeps if (each := _cruise(begins, keep)) is not None]
    is_all = is_all and len(cruises) == len(begins)
    return Statement("parallel", members=cruises, duration=time) if is_all else None

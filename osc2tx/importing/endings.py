"""The end of a scenario as a part of its composition.

What ends the scenario is waited for beside what goes on by itself: the last member of a `parallel`
that ends by itself ends all. Where something else may last longer, events end it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Container, Iterable, Iterator, Sequence

from osc2tx.importing.effects import LATERAL, LONGITUDINAL
from osc2tx.importing.program import Statement, composed, ended, wait
from osc2tx.importing.steps import Branch

Waits = list[Statement]
"""What is waited for, one after the other."""


def is_open(statement: Statement) -> bool:
    """Whether only what is around a statement ends it."""
    if any(each.startswith("until ") for each in statement.modifiers):
        return False
    if statement.members is None:
        return statement.length == math.inf
    if statement.text == "serial":
        return is_open(statement.members[-1])
    return statement.text == "parallel" and all(is_open(each) for each in statement.members)


def label_of(statement: Statement) -> str:
    """Return the name of what happens in a statement."""
    return statement.label or statement.text.removeprefix("emit ")


def ends_of(members: Sequence[Statement]) -> frozenset[str]:
    """Return the events with the last of which members end; none: that is not known."""
    if not members:
        return frozenset()
    last = members[-1]
    if last.members is None or last.modifiers:
        return frozenset((label_of(last),))
    if last.text == "serial":
        return ends_of(last.members)
    if last.text != "parallel":
        return frozenset()
    inner = [ends_of([each]) for each in last.members if not is_open(each)]
    return frozenset(label for each in inner for label in each) if all(inner) else frozenset()


_SECONDS = re.compile(r"(?:wait elapsed\(|\bduration: )(\d+\.?\d*)s\)$")


def seconds(statements: Sequence[Statement]) -> float | None:
    """Return how long statements take one after the other, if their texts say it as numbers."""
    times = [_seconds_of(each) for each in statements]
    return None if None in times else sum(filter(None, times))


def _seconds_of(statement: Statement) -> float | None:
    if statement.members is not None:
        if statement.text != "serial" or statement.modifiers:
            return None
        return seconds(statement.members)
    found = _SECONDS.search(statement.text)
    if statement.modifiers or found is None:
        return statement.length if statement.length == 0.0 else None
    return float(found[1])


def without_events(
    branches: Sequence[Branch], endings: Sequence[Waits], others: Iterable[str]
) -> tuple[list[Branch], list[Waits]]:
    """Return branches and ends without the events that only ends wait for.

    A branch that only emits such an event is what an end waits for first.

    Args:
        branches: What happens.
        endings: What ends the scenario, each in another way.
        others: Other texts in which events may be named.
    """
    left, found = list(branches), [list(each) for each in endings]
    texts = list(others)
    for branch in branches:
        event = _emitted_by(branch)
        if event is None:
            continue
        waited = re.compile(rf"@{event}\b")
        elsewhere = [text for each in left for text in texts_of(each.members)] + texts
        begins = [each for each in found if each and each[0].text == f"wait @{event}"]
        rest = [text for each in found for text in texts_of(each[1:] if each in begins else each)]
        labels = {each.label for each in branch.members if each.label}
        named = re.compile("|".join(rf"@{label}\b" for label in labels) or r"(?!)")
        if not begins or any(waited.search(text) or named.search(text) for text in elsewhere):
            continue
        if any(waited.search(text) or named.search(text) for text in rest):
            continue
        first = branch.members[:-1] or [wait("elapsed(0s)")]
        if comments := branch.members[-1].comments:
            first[0].comments = [*first[0].comments, *comments]
        left.remove(branch)
        found = [[*first, *each[1:]] if each in begins else each for each in found]
    return left, found


def _emitted_by(branch: Branch) -> str | None:
    """Return the event that a branch emits when something has happened, if it does no more."""
    *waits, last = branch.members or [Statement("")]
    if not last.text.startswith("emit ") or branch.actors:
        return None
    if any(each.members is not None or not each.text.startswith("wait ") for each in waits):
        return None
    return last.text.removeprefix("emit ")


def texts_of(statements: Iterable[Statement]) -> Iterator[str]:
    """Yield the texts of statements and of all in them, with their modifiers."""
    for each in statements:
        yield from (each.text, *each.modifiers)
        yield from texts_of(each.members or ())


def placed_beside(statement: Statement) -> set[str]:
    """Return the actors that a statement puts beside others."""
    inner = (name for each in statement.members or () for name in placed_beside(each))
    actor = statement.text.removesuffix(".assign_position()")
    return {*inner, *([actor] if statement.modifiers and actor != statement.text else [])}


def first_of(endings: Sequence[Waits]) -> Waits:
    """Return what waits for the first of several ends; what they begin with alike stands once."""
    if any(not each for each in endings):
        return []
    groups: dict[str, list[Waits]] = {}
    for each in endings:
        head = each[0]
        groups.setdefault(head.text if head.members is None else repr(head), []).append(each)
    chains = [
        group[0] if len(group) == 1 else [group[0][0], *first_of([each[1:] for each in group])]
        for group in groups.values()
    ]
    if len(chains) == 1:
        return chains[0]
    return [composed("one_of", [composed("serial", each) for each in chains])]


def ends_with(branch: Branch, waits: Sequence[Statement]) -> Waits | None:
    """Return what is waited for behind the last event of a branch; `None`: for another event."""
    if not waits:
        return None
    first, rest = waits[0], list(waits[1:])
    ends, delays = set(), set()
    for each in first.members or () if first.text == "parallel" else [first]:
        marks = each.members if each.text == "serial" and each.members is not None else [each]
        ends.add(marks[0].text)
        delays.add(tuple(mark.text for mark in marks[1:]))
    if len(delays) != 1:
        return None
    rest = [*map(Statement, delays.pop()), *rest]
    is_behind = ends == {f"wait @{label}.end" for label in ends_of(branch.members)}
    is_time = all(each.text.startswith("wait elapsed(") for each in rest)
    return rest if is_behind and len(rest) <= 1 and is_time else None


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
        told = [text for text in texts_of(branch.members) if text.startswith(f"{actor}.")]
        slot = (actor, LONGITUDINAL)
        first = next(each for each in branches if actor in each.actors)
        if slot not in others and (first is branch or slot in branch.slots):
            found.append(Statement(f"{actor}.keep_speed()", length=math.inf))
        elif (
            actor in vehicles
            and (actor, LATERAL) not in others
            and all(".change_lane(" in text and "offset" not in text for text in told)
        ):
            found.append(Statement(f"{actor}.follow_lane()", length=math.inf))
        else:
            return []
    return found


def held_for(going: Sequence[Statement], rest: Sequence[Statement]) -> Waits:
    """Return what actors go on with for the rest of the scenario; a wait if that is nothing."""
    if not rest or not going:
        return list(rest)
    return [composed("parallel", [ended(each, rest[0]) for each in going])]

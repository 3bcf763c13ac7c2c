"""Events that start when several others have ended.

What they wait for stands side by side, they stand behind it: a `parallel` ends with its last
member.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from osc2tx.importing.effects import LONGITUDINAL
from osc2tx.importing.endings import ends_of, is_open, label_of
from osc2tx.importing.statements import Call, Statement, composed, elapsed, seconds, wait
from osc2tx.importing.steps import Branch
from osc2tx_shared.classes import dataclass

Delays = dict[str, str]
"""How much later than the end of each event something starts, as texts by labels; `""`: at once."""


@dataclass(eq=False)
class Join:
    """A branch that begins when several events have ended.

    Attributes:
        branch: The branch, with its wait for them.
        delays: How much later than the end of each of them it begins.
        content: The branch without its wait for them.
    """

    branch: Branch
    delays: Delays
    content: list[Statement]

    @property
    def delay(self) -> str | None:
        """The delay behind all events; `None`: it is not the same one."""
        return min(self.delays.values()) if len(set(self.delays.values())) == 1 else None


def joined(
    branches: Sequence[Branch], joins: Sequence[Join], going_on: Mapping[str, Call]
) -> list[Branch]:
    """Return branches of which those that wait for the ends of others stand behind them.

    Args:
        branches: All branches.
        joins: Those of them that wait for the ends of several events.
        going_on: What actors go on with that would not do so by themselves.
    """
    found, left = list(branches), list(joins)
    while left:
        alike = [each for each in left if each.delays.keys() == left[0].delays.keys()]
        left = [each for each in left if each not in alike]
        merged = _merged(found, alike, going_on)
        if merged is None:
            continue
        branch, before = merged
        gone = [*before, *(each.branch for each in alike)]
        at = found.index(before[0])
        found = [branch if each is found[at] else each for each in found]
        found = [each for each in found if each not in gone]
    return found


def _merged(
    branches: Sequence[Branch], joins: Sequence[Join], going_on: Mapping[str, Call]
) -> tuple[Branch, list[Branch]] | None:
    """Return branches as one in which the joins stand behind the others, and those others."""
    labels = joins[0].delays.keys()
    waiting = [each.branch for each in joins]
    before = [each for each in branches if labels & {step.label for step in each.steps}]
    delay = joins[0].delay
    if any(each in waiting for each in before) or (delay is None and len(joins) > 1):
        return None
    delays = joins[0].delays if delay is None else dict.fromkeys(labels, "")
    members = []
    for branch in before:
        mine = {step.label: delays[step.label] for step in branch.steps if step.label in labels}
        followed = _followed(branch.members, mine)
        if followed is None:
            return None
        members.append(composed("serial", followed))
    later = [composed("serial", [*_waits(each.delay or ""), *each.content]) for each in joins]
    held = _held([*before, *waiting], branches, going_on)
    first = _side_by_side(before, members, held)
    if first is None:
        return None
    behind = {actor for each in waiting for actor in each.actors}
    beside = [statement for actor, statement in held.items() if actor not in behind]
    steps = [step for each in (*before, *waiting) for step in each.steps]
    return Branch(steps, [first, composed("parallel", [*later, *beside])]), before


def _held(
    mine: Sequence[Branch], branches: Sequence[Branch], going_on: Mapping[str, Call]
) -> dict[str, Statement]:
    """Return what the actors that only some branches move go on with, by actor."""
    others = {actor for each in branches if each not in mine for actor in each.actors}
    actors = sorted({actor for each in mine for actor in each.actors} - others)
    return {
        actor: Statement(going_on[actor], length=math.inf) for actor in actors if actor in going_on
    }


def _side_by_side(
    branches: Sequence[Branch], members: Sequence[Statement], held: Mapping[str, Statement]
) -> Statement | None:
    """Return branches side by side; in those that are over first their actors go on.

    `None`: which of them that are is not known before the run.
    """
    lengths = [seconds([each]) for each in members]
    longest = max(filter(None, lengths), default=0.0)
    found = []
    for branch, member, length in zip(branches, members, lengths, strict=True):
        others = {slot for each in branches if each is not branch for slot in each.slots}
        last = [
            held[actor]
            for actor in sorted(branch.actors & held.keys())
            if (actor, LONGITUDINAL) not in others
        ]
        if len(members) > 1 and last and None in lengths:
            return None
        is_short = last and length is not None and length < longest
        tail = [composed("parallel", last)] if is_short else []
        found.append(composed("serial", [member, *tail]))
    return composed("parallel", found)


def _waits(delay: str) -> list[Statement]:
    return [wait(elapsed(delay))] if delay else []


def _followed(members: Sequence[Statement], delays: Delays) -> list[Statement] | None:
    """Return members that are over when events in them are, with their delays.

    `None`: something else in them lasts longer.
    """
    for index, member in enumerate(members):
        label = label_of(member)
        rest = members[index + 1 :]
        if rest and any(delays.get(each) for each in _labels_in(member.members)):
            return None
        if label in delays:
            waits = _waits(delays[label])
            if not rest:
                return [*members, *waits]
            tail = _followed(rest, {key: text for key, text in delays.items() if key != label})
            if tail is None:
                return None
            behind = composed("parallel", [composed("serial", tail), *waits])
            return [*members[: index + 1], *([behind] if waits else tail)]
        if not rest and member.is_composed:
            return _followed_inside(members, member, delays)
    return None


def _followed_inside(
    members: Sequence[Statement], last: Statement, delays: Delays
) -> list[Statement] | None:
    """Return members of which the last is a composition with the events."""
    ends = ends_of([last])
    if ends and ends <= delays.keys() and not any(delays.values()):
        return list(members)
    timed = [each for each in last.members if not is_open(each)]
    if last.does != "parallel" or not last.is_plain or len(timed) != 1:
        return None
    inner = _followed(timed[0].members or [timed[0]], delays)
    if inner is None:
        return None
    again = [composed("serial", inner) if each is timed[0] else each for each in last.members]
    return [*members[:-1], replace(last, members=again, length=None)]


def _labels_in(members: Sequence[Statement]) -> Iterator[str]:
    for each in members:
        yield label_of(each)
        yield from _labels_in(each.members)

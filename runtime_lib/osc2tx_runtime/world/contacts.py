"""Contacts between actors over the steps, each reported once.

Looked at are those who move, with those who are near them. Who is near is sought anew only when
somebody may have come near since: when one has gone as far as the margin of the last search. And
two are looked at closely only when the axis that separated them may have ceased to do so.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import compress, count
from operator import is_not
from typing import NamedTuple

from .actor_dimensions import Shape
from .collision import apart, box_of, swept, touch
from .state import ActorState

__all__ = ["Contacts"]

_STEPS = 10  # with the ways of the present one, for which a search holds
_NARROW = 1.0  # m: the least margin of a search


class _Apart(NamedTuple):
    """How two actors stood to each other who did not touch.

    Attributes:
        x: Of the axis that separated them, a unit vector.
        y: Likewise.
        along: From the one to the other along it (m).
        one: Heading of the one (rad).
        other: That of the other.
        room: Metres between them along it.
    """

    x: float
    y: float
    along: float
    one: float
    other: float
    room: float

    def holds(self, x: float, y: float, headings: tuple[float, float], reach: float) -> bool:
        """Whether it still separates them, with no corner farther away than some reach (m)."""
        turned = abs(headings[0] - self.one) + abs(headings[1] - self.other)
        return abs(x * self.x + y * self.y - self.along) + 2.0 * reach * turned < self.room


_Pair = tuple[int, int, float]
"""Two actors by their numbers, the lower first, and the sum (m) of how far their corners are."""


class Contacts:
    """Who touches whom.

    Attributes:
        new: Pairs of actors (ids sorted) whose contact began during the last step, sorted.
    """

    def __init__(self) -> None:
        self.new: tuple[tuple[str, str], ...] = ()
        self._touching: frozenset[tuple[int, int]] = frozenset()
        self.begin()

    def begin(self) -> None:
        """Start anew where the actors are before the next step."""
        self._states: list[ActorState] = []
        self._reach: list[float] = []  # m from the reference points to the farthest corners
        self._moved: set[int] = set()  # who moved in the last step
        self._near: list[_Pair] = []
        self._sought: set[int] = set()  # whose neighbours were sought
        self._room = -1.0  # m that one may go until others are near
        self._apart: dict[tuple[int, int], _Apart] = {}

    def put(self, index: int, state: ActorState) -> None:
        """Take a new place of an actor, by its number in the cast, between two steps."""
        if self._states:
            self._states[index] = state
            self._apart = {}
            self._moved.add(index)
            self._room = -1.0

    def step(
        self,
        before: Mapping[str, ActorState],
        states: Sequence[ActorState],
        jumped: Collection[str],
        coupled: Sequence[tuple[str, str]],
    ) -> None:
        """Find the contacts of one step.

        Two who have not moved again touch if they did before.

        Args:
            before: States at its begin, by the ids of the actors.
            states: Those at its end, in the same order.
            jumped: Who was put somewhere, and touches nothing on its way.
            coupled: Pairs that may touch.
        """
        if not self._states:
            self._states = list(before.values())
            self._reach = [_reach_of(state.shape) for state in states]
            self._moved = set(range(len(states)))
        begin, self._states = self._states, list(states)
        moved = set(compress(count(), map(is_not, states, begin)))
        looked_at, self._moved = moved | self._moved, moved
        self.new = ()
        if not looked_at:
            return
        if jumped:
            begin = [states[i] if actor in jumped else begin[i] for i, actor in enumerate(before)]
        way = 0.0
        for i in moved:
            one, other = begin[i], states[i]
            x, y = other.x - one.x, other.y - one.y
            if x > way or -x > way or y > way or -y > way:
                way = max(abs(x), abs(y))
        if way > self._room or jumped or not looked_at <= self._sought:
            margin = max(_STEPS * way, _NARROW)
            self._near = _neighbours(states, self._reach, looked_at, margin)
            self._sought, self._room = looked_at, margin
        self._room -= way
        touching = list(self._found(begin, way))
        if touching or self._touching:
            stay = [pair for pair in self._touching if looked_at.isdisjoint(pair)]
            self._compare(tuple(before), [*touching, *stay], coupled)

    def _found(self, begin: Sequence[ActorState], way: float) -> Iterator[tuple[int, int]]:
        """Yield the pairs that touch on their ways of at most so many metres."""
        end = self._states
        last, self._apart = self._apart, {}
        for i, j, reach in self._near:
            one, other, far = end[i], end[j], reach + 2.0 * way
            x, y = other.x - one.x, other.y - one.y
            if x > far or -x > far or y > far or -y > far:
                continue
            found = last.get((i, j))
            if found is None or not found.holds(x, y, (one.h, other.h), far):
                ways = [swept(box_of(begin[each]), box_of(end[each])) for each in (i, j)]
                if touch(*ways):
                    yield i, j
                    continue
                room, ux, uy = apart(ways[0].end, ways[1].end)
                found = _Apart(ux, uy, x * ux + y * uy, one.h, other.h, room)
            self._apart[i, j] = found

    def _compare(
        self,
        ids: tuple[str, ...],
        touching: Sequence[tuple[int, int]],
        coupled: Sequence[tuple[str, str]],
    ) -> None:
        known = {(ids[i], ids[j]) for i, j in self._touching}
        known.update(coupled)
        known.update((two, one) for one, two in coupled)
        pairs = ((ids[i], ids[j]) for i, j in touching)
        self.new = tuple(sorted((min(p), max(p)) for p in pairs if p not in known))
        self._touching = frozenset(touching)


def _reach_of(shape: Shape) -> float:
    return math.hypot(max(shape.rear, shape.front), 0.5 * shape.width)


def _neighbours(
    states: Sequence[ActorState], reach: Sequence[float], who: Collection[int], margin: float
) -> list[_Pair]:
    """Return who may touch whom of some actors if none goes farther than the margin (m)."""
    found: list[_Pair] = []
    spans = sorted(
        (state.x - far - margin, state.x + far + margin, i)
        for i, (state, far) in enumerate(zip(states, reach, strict=True))
    )
    active: list[tuple[float, int]] = []
    for left, right, i in spans:
        active = [other for other in active if other[0] >= left]
        y, far, is_one = states[i].y, reach[i] + 2.0 * margin, i in who
        for _, j in active:
            if (is_one or j in who) and abs(states[j].y - y) <= far + reach[j]:
                found.append((min(i, j), max(i, j), reach[i] + reach[j]))
        active.append((right, i))
    return found

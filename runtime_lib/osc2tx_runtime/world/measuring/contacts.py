"""Contacts between actors over the steps, each reported once.

Moving actors are tested against actors near them. Neighbours are searched again only when an actor
may have come near: when one has moved by the margin of the last search. A pair is tested only when
both may have met since the last test: with uniform motion when they will have closed the distance,
else when the largest distance moved by any actor is half of it.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from heapq import heapify, heappop, heappush
from typing import NamedTuple

from osc2tx_runtime.world.state import ActorState

from .collision import apart, box_of, swept, touch

_STEPS = 10  # for which a search is valid, at the present speeds
_NARROW = 1.0  # m: the least margin of a search
_ROUNDING = 1e-3  # m: nearer pairs are tested in each step
_CREEP = 1e-6  # m per step: a slower approach is rounding


class _Apart(NamedTuple):
    """The relative pose of two actors that did not touch.

    Attributes:
        x: X of the separating axis, a unit vector.
        y: Likewise.
        along: Distance along it (m).
        one: Heading of the first (rad).
        other: Heading of the second (rad).
        room: Gap between them along it (m).
    """

    x: float
    y: float
    along: float
    one: float
    other: float
    room: float

    def left(self, x: float, y: float, one: float, other: float, reach: float) -> float:
        """Lower bound of the present gap (m), for corners within a reach (m)."""
        turned = abs(one - self.one) + abs(other - self.other)
        return self.room - abs(x * self.x + y * self.y - self.along) - 2.0 * reach * turned

    def distance(self, one: ActorState, other: ActorState) -> float:
        """Metres between two reference points along the axis."""
        return abs((other.x - one.x) * self.x + (other.y - one.y) * self.y)


_Pair = tuple[float, int, int, float]
"""A pair: when it is due, the numbers of the actors, the lower first, and the sum of their reaches
(m)."""


class Contacts:
    """The contacts between actors.

    Attributes:
        new: Pairs of actors (ids sorted) whose contact began during the last step, sorted.
    """

    def __init__(self) -> None:
        self.new: tuple[tuple[str, str], ...] = ()
        self._touching: frozenset[tuple[int, int]] = frozenset()
        self.begin()

    def begin(self) -> None:
        """Restart from the positions before the next step."""
        self._states: Sequence[ActorState] = ()
        self._reach: list[float] = []  # m from the reference points to the farthest corners
        self._ways: Sequence[float] = ()  # of the last step
        self._way = 0.0  # the longest of them
        self._moved: set[int] = set()  # moved in the last step
        self._uneven: set[int] = set()  # with another motion than in the step before
        self._sought: set[int] = set()  # with known neighbours
        self._gone = self._room = 0.0  # m moved since the search, and its margin
        self._steps = 0
        self._apart: dict[tuple[int, int], _Apart] = {}
        self._due: list[_Pair] = []  # a heap, by the distance moved
        self._due_evenly: list[_Pair] = []  # a heap, by steps, of evenly moving pairs
        self._close: list[_Pair] = []  # tested in each step

    def put(self, index: int, state: ActorState) -> None:
        """Note a new position of an actor, by its number in the cast, between two steps."""
        if self._states:
            self._states = [*self._states[:index], state, *self._states[index + 1 :]]
            self._moved.add(index)
            self._ways, self._room, self._apart = (), -1.0, {}

    def turn(self) -> None:
        """Note that an actor was turned between two steps."""
        self._ways = ()

    def step(
        self,
        ids: Sequence[str],
        before: Sequence[ActorState],
        states: Sequence[ActorState],
        ways: Sequence[float],
        jumped: Collection[str],
        coupled: Sequence[tuple[str, str]],
    ) -> None:
        """Find the contacts of one step.

        Two actors that have not moved touch if they touched before.

        Args:
            ids: The actors.
            before: States at its start, in the same order.
            states: States at its end.
            ways: Upper bounds of the distance (m) moved by their corners; negative: unknown.
            jumped: Teleported actors, which touch nothing in between.
            coupled: Pairs that may touch.
        """
        if not self._states:
            self._states, self._room = before, -1.0
            self._reach = [state.shape.reach for state in states]
            self._moved = set(range(len(states)))
        begin, self._states = self._states, states
        self._steps += 1
        looked_at = self._look_for_ways(begin, ways)
        if jumped:
            begin = [states[i] if actor in jumped else begin[i] for i, actor in enumerate(ids)]
            self._room, self._apart = -1.0, {}
        self.new = ()
        if not looked_at:
            return
        if self._gone + self._way > self._room or not looked_at <= self._sought:
            self._seek(looked_at)
        self._gone += self._way
        touching = list(self._found(begin)) if self._is_any_pair_due() else ()
        if touching or self._touching:
            stay = [pair for pair in self._touching if self._sought.isdisjoint(pair)]
            self._compare(ids, [*touching, *stay], coupled)

    def _look_for_ways(self, begin: Sequence[ActorState], ways: Sequence[float]) -> set[int]:
        """Add the distances moved; return the actors that moved in this step or the last."""
        if ways == self._ways:
            return self._moved
        before, self._uneven = self._uneven, set()
        moved, self._way = set(), 0.0
        for i, way in enumerate(ways):
            one, other = begin[i], self._states[i]
            if one is other:
                continue
            moved.add(i)
            if way <= 0.0:
                self._uneven.add(i)
                turn = abs(math.remainder(other.h - one.h, math.tau))
                way = math.hypot(other.x - one.x, other.y - one.y) + self._reach[i] * turn
            if way > self._way:
                self._way = way
        if not self._uneven <= before:
            self._upset(self._uneven - before)
        looked_at, self._moved = moved | self._moved, moved
        self._ways = ways if min(ways, default=0.0) >= 0.0 else ()
        return looked_at

    def _upset(self, who: set[int]) -> None:
        """Test pairs again whose motion is no longer uniform."""
        pairs, self._due_evenly = self._due_evenly, []
        for pair in pairs:
            is_even = who.isdisjoint(pair[1:3])
            (self._due_evenly if is_even else self._close).append(pair)
        heapify(self._due_evenly)

    def _seek(self, who: set[int]) -> None:
        """Find the neighbours of some actors."""
        margin = max(_STEPS * self._way, _NARROW)
        self._due = _neighbours(self._states, self._reach, who, margin)
        heapify(self._due)
        self._sought, self._close, self._due_evenly = who, [], []
        pairs = [(i, j) for _, i, j, _ in self._due]
        self._apart = {pair: self._apart[pair] for pair in pairs if pair in self._apart}
        self._gone, self._room = 0.0, margin

    def _is_any_pair_due(self) -> bool:
        """Whether a pair is due in this step."""
        due, evenly = self._due, self._due_evenly
        if self._close or (due and due[0][0] <= self._gone):
            return True
        return bool(evenly) and evenly[0][0] <= self._steps

    def _found(self, begin: Sequence[ActorState]) -> Iterator[tuple[int, int]]:
        """Yield the pairs that touch in a step."""
        pairs, self._close = self._close, []
        for heap, now in ((self._due, self._gone), (self._due_evenly, self._steps)):
            while heap and heap[0][0] <= now:
                pairs.append(heappop(heap))
        end, both = self._states, 2.0 * self._way
        for _, i, j, reach in pairs:
            one, other = end[i], end[j]
            x, y, found = other.x - one.x, other.y - one.y, self._apart.get((i, j))
            room = 0.0 if found is None else found.left(x, y, one.h, other.h, reach + both)
            if room <= _ROUNDING:
                room, found = math.hypot(x, y) - reach, None
            if found is None and room <= both + _ROUNDING:
                ways = [swept(box_of(begin[each]), box_of(end[each])) for each in (i, j)]
                if touch(*ways):
                    yield i, j
                    room = 0.0
                else:
                    room, ux, uy = apart(ways[0].end, ways[1].end)
                    found = _Apart(ux, uy, x * ux + y * uy, one.h, other.h, room)
                    self._apart[i, j] = found
            if room <= _ROUNDING:
                self._close.append((0.0, i, j, reach))
            elif found is not None and self._move_uniformly(begin, i, j):
                nearer = found.distance(begin[i], begin[j]) - found.distance(one, other)
                steps = (room - _ROUNDING) // max(nearer, _CREEP)
                heappush(self._due_evenly, (self._steps + max(steps, 1.0), i, j, reach))
            else:
                heappush(self._due, (self._gone + 0.5 * (room - _ROUNDING), i, j, reach))

    def _move_uniformly(self, begin: Sequence[ActorState], i: int, j: int) -> bool:
        """Whether both move uniformly, or stand still."""
        end = self._states
        is_told = i in self._uneven or j in self._uneven
        return not is_told and begin[i].h == end[i].h and begin[j].h == end[j].h

    def _compare(
        self,
        ids: Sequence[str],
        touching: Sequence[tuple[int, int]],
        coupled: Sequence[tuple[str, str]],
    ) -> None:
        known = {(ids[i], ids[j]) for i, j in self._touching}
        known.update(coupled)
        known.update((two, one) for one, two in coupled)
        pairs = ((ids[i], ids[j]) for i, j in touching)
        self.new = tuple(sorted((min(p), max(p)) for p in pairs if p not in known))
        self._touching = frozenset(touching)


def _neighbours(
    states: Sequence[ActorState], reach: Sequence[float], who: Collection[int], margin: float
) -> list[_Pair]:
    """Return pairs of actors that may touch if none moves farther than the margin (m)."""
    found: list[_Pair] = []
    spans = sorted(
        (state.x - far - margin, state.x + far + margin, i)
        for i, (state, far) in enumerate(zip(states, reach, strict=True))
    )
    active: list[tuple[float, int]] = []
    for left, right, i in spans:
        active = [other for other in active if other[0] >= left]
        one, far, is_one = states[i], reach[i] + 2.0 * margin, i in who
        for _, j in active:
            if (is_one or j in who) and abs(states[j].y - one.y) <= far + reach[j]:
                both = reach[i] + reach[j]
                room = math.hypot(states[j].x - one.x, states[j].y - one.y) - both
                found.append((0.5 * room, min(i, j), max(i, j), both))
        active.append((right, i))
    return found

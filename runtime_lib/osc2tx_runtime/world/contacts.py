"""Contacts between actors over the steps, each reported once."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from itertools import compress, count
from operator import is_not

from .collision import Box, Standing, box_of, swept_contacts
from .state import ActorState

__all__ = ["Contacts"]


class Contacts:
    """Who touches whom.

    Attributes:
        new: Pairs of actors (ids sorted) whose contact began during the last step, sorted.
    """

    def __init__(self) -> None:
        self.new: tuple[tuple[str, str], ...] = ()
        self._boxes: list[Box] = []
        self._states: list[ActorState] = []  # to which the boxes belong
        self._touching: frozenset[tuple[int, int]] = frozenset()
        self._moved: set[int] = set()  # who moved in the last step
        self._looked_at: set[int] = set()  # all but those who stand
        self._standing: Standing | None = None

    def begin(self, states: Mapping[str, ActorState]) -> None:
        """Take the places before step 0."""
        self._states = list(states.values())
        self._boxes = [box_of(state) for state in self._states]
        self._moved = self._looked_at = set(range(len(self._states)))
        self._standing = None

    def put(self, index: int, state: ActorState) -> None:
        """Take a new place of an actor, by its number in the cast, between two steps."""
        self._boxes[index], self._states[index] = box_of(state), state
        self._moved.add(index)

    def step(
        self,
        before: Mapping[str, ActorState],
        states: Sequence[ActorState],
        jumped: Collection[str],
        coupled: Sequence[tuple[str, str]],
    ) -> None:
        """Find the contacts of one step.

        Two who have not moved again touch if they did before, so only the others are looked at.

        Args:
            before: States at its begin, by the ids of the actors.
            states: Those at its end, in the same order.
            jumped: Who was put somewhere, and touches nothing on its way.
            coupled: Pairs that may touch.
        """
        moved = set(compress(count(), map(is_not, states, self._states)))
        looked_at, self._moved = moved | self._moved, moved
        self.new = ()
        if not looked_at:
            return
        ids, boxes = tuple(before), self._boxes.copy()
        for i in moved:
            boxes[i] = box_of(states[i])
            if ids[i] in jumped:
                self._boxes[i] = boxes[i]
        if looked_at != self._looked_at:
            self._looked_at = looked_at
            standing = [i for i in range(len(boxes)) if i not in looked_at]
            self._standing = Standing(boxes, standing) if standing else None
        touching = swept_contacts(self._boxes, boxes, looked_at, self._standing)
        self._boxes, self._states = boxes, list(states)
        if touching or self._touching:
            stay = [pair for pair in self._touching if looked_at.isdisjoint(pair)]
            self._compare(ids, [*touching, *stay], coupled)

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

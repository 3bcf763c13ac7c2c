"""Contacts between actors over the steps, each reported once."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from operator import is_

from .collision import Box, box_of, swept_contacts
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
        self._stand = False  # nobody moved in the last step

    def begin(self, states: Mapping[str, ActorState]) -> None:
        """Take the places before step 0."""
        self._states = list(states.values())
        self._boxes = [box_of(state) for state in self._states]
        self._stand = False

    def put(self, index: int, state: ActorState) -> None:
        """Take a new place of an actor, by its number in the cast, between two steps."""
        self._boxes[index], self._states[index] = box_of(state), state
        self._stand = False

    def step(
        self,
        before: Mapping[str, ActorState],
        states: Sequence[ActorState],
        jumped: Collection[str],
        coupled: Sequence[tuple[str, str]],
    ) -> None:
        """Find the contacts of one step.

        Args:
            before: States at its begin, by the ids of the actors.
            states: Those at its end, in the same order.
            jumped: Who was put somewhere, and touches nothing on its way.
            coupled: Pairs that may touch.
        """
        stood, self._stand = self._stand, not jumped and all(map(is_, states, self._states))
        if stood and self._stand:
            self.new = ()  # nobody has moved again, so the contacts are those of before
            return
        boxes = []
        for i, (actor, state) in enumerate(zip(before, states, strict=True)):
            boxes.append(self._boxes[i] if state is self._states[i] else box_of(state))
            if actor in jumped:
                self._boxes[i] = boxes[i]
        touching = swept_contacts(self._boxes, boxes)
        self._boxes, self._states = boxes, list(states)
        if touching or self._touching:
            self._compare(tuple(before), touching, coupled)
        else:
            self.new = ()

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

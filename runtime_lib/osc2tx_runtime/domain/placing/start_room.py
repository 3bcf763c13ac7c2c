"""Placement of the actors one by one: order, occupied space, and moves that make room."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from operator import attrgetter
from typing import ClassVar, Generic, NamedTuple, Protocol, TypeVar

from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.world.measuring.collision import Box, overlap_along, overlapped


class Start(Protocol):
    """An actor to place."""

    @property
    def id(self) -> str:
        """The actor."""

    @property
    def references(self) -> Sequence[str]:
        """The actors to place before."""

    @property
    def rank(self) -> int:
        """Among the actors that can be placed, the least value comes first."""

    @property
    def is_open(self) -> bool:
        """Whether the scenario leaves its position along the road or its lane open."""


class Placed(NamedTuple):
    """The position of an actor.

    Attributes:
        box: The space that it occupies; None if unknown.
        lane: Its position on the centre of its lane; None off the lanes.
    """

    box: Box | None
    lane: LanePosition | None


StartT = TypeVar("StartT", bound=Start)


class StartRoom(ABC, Generic[StartT]):
    """Places actors, references first, and records the occupied space.

    Args:
        most_tries: Number of positions to which an actor is moved to make room.
    """

    failure: ClassVar[type[Exception]]
    """Raised if there is no position for an actor."""

    def __init__(self, most_tries: int) -> None:
        self._most_tries = most_tries
        self._placed: dict[str, Placed] = {}
        # Positions that left no room for the actors that start relative to it.
        self._tried: dict[str, set[LanePosition | None]] = {}

    @abstractmethod
    def place(self, start: StartT) -> Placed:
        """Places one actor; occupied positions are known.

        Raises:
            failure: There is no position for it.
        """

    @abstractmethod
    def cycle_of(self, waiting: Sequence[StartT]) -> Exception:
        """Return the failure for starts that depend on each other."""

    def fill(self, starts: Sequence[StartT]) -> None:
        """Places all actors, by rank and in their order.

        Raises:
            failure: There is no position for an actor, or it depends on itself.
        """
        waiting = list(starts)
        placed: list[StartT] = []
        while waiting:
            ready = [s for s in waiting if self._placed.keys() >= set(s.references)]
            if not ready:
                raise self.cycle_of(waiting)
            start = min(ready, key=attrgetter("rank"))  # the first of equals: order of the cast
            waiting.remove(start)
            placed.append(start)
            try:
                self._placed[start.id] = self.place(start)
            except self.failure:
                if not self._makes_room(placed):
                    raise

    def taken_by(self, box: Box) -> str | None:
        """The blocking actor, and the overlap."""
        placed = {actor: room for actor, (room, _) in self._placed.items() if room is not None}
        return overlap_with(box, placed)

    def was_tried(self, start: StartT, place: LanePosition) -> bool:
        """Whether a position was tried without success."""
        return place in self._tried.get(start.id, ())

    def _makes_room(self, placed: Sequence[StartT]) -> bool:
        """Place the last actor by moving a reference whose position is open.

        Actors that start relative to that reference move with it.

        Args:
            placed: The placed actors, in order; the last one does not fit.

        Returns:
            Whether there is such a position.
        """
        *_, start = placed
        movable = (each for each in placed if each.is_open)
        anchor = next((each for each in movable if _is_behind(start, each, placed)), None)
        if anchor is None:
            return False
        moved = [each for each in placed if each is anchor or _is_behind(each, anchor, placed)]
        tried = self._tried.setdefault(anchor.id, set())
        lane = self._placed[anchor.id].lane
        for _ in range(self._most_tries):
            tried.add(lane)
            for each in moved:
                self._placed.pop(each.id, None)
            try:
                self._placed[anchor.id] = self.place(anchor)
            except self.failure:
                return False
            lane = self._placed[anchor.id].lane
            if lane in tried:
                return False
            try:
                for each in moved[1:]:
                    self._placed[each.id] = self.place(each)
            except self.failure:
                continue
            return True
        return False


def overlap_with(box: Box, others: Mapping[str, Box]) -> str | None:
    """Return the first of other actors that a box overlaps, with the length of the overlap."""
    found = overlapped(box, others)
    return f"{found[0]} by {overlap_along(box, others[found[0]]):.2f} m" if found else None


def _is_behind(start: StartT, anchor: StartT, placed: Sequence[StartT]) -> bool:
    """Whether a start depends on another, directly or indirectly."""
    by_id = {each.id: each for each in placed}
    waiting, seen = [start], {start.id}
    while waiting:
        for reference in waiting.pop().references:
            if reference == anchor.id:
                return True
            if reference in by_id and reference not in seen:
                seen.add(reference)
                waiting.append(by_id[reference])
    return False

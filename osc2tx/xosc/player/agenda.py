"""Which events of an act are looked at: most wait for a time, an element or a variable.

A storyboard of a thousand events has a few that can do something at an instant.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from heapq import heappop, heappush

from osc2tx_shared.classes import dataclass

EARLY = 1e-6  # s; an event that is evaluated too early continues to wait


@dataclass(frozen=True, slots=True)
class Awaited:
    """The causes of a trigger: it cannot fire before one of these.

    Attributes:
        times: Seconds since the start.
        changes: Elements, by identity, and variables, by name, that have to change.
    """

    times: tuple[float, ...]
    changes: tuple[int | str, ...]


class Agenda:
    """The events of an act, by their numbers in the order of the document.

    Args:
        count: How many there are; all are looked at in the first pass.
    """

    def __init__(self, count: int) -> None:
        self._count = count
        self._awake = set(range(count))
        self._asleep: set[int] = set()
        self._pass: list[int] = []
        self._here = count  # the present event; none between passes
        self._times: list[tuple[float, int]] = []

    @property
    def is_over(self) -> bool:
        """Whether nothing is left to look at."""
        return not self._awake and not self._asleep

    def due(self, time: float) -> Iterator[int]:
        """Yield the events to look at in one pass, also those that wake up behind the present one.

        Args:
            time: Seconds since the start.
        """
        while self._times and self._times[0][0] <= time + EARLY:
            self.wake(heappop(self._times)[1])
        self._pass = sorted(self._awake)
        while self._pass:
            self._here = heappop(self._pass)
            yield self._here
        self._here = self._count

    def wake(self, number: int) -> None:
        """Look at an event again, in this pass if it is still to come."""
        if number not in self._asleep:
            return
        self._asleep.remove(number)
        self._awake.add(number)
        if number > self._here:
            heappush(self._pass, number)

    def sleep(self, number: int, times: Iterable[float]) -> None:
        """Do not look at an event until it is woken, or one of some times has come."""
        self._awake.remove(number)
        self._asleep.add(number)
        for time in times:
            heappush(self._times, (time, number))

    def drop(self, number: int) -> None:
        """Look at an event no more."""
        self._awake.remove(number)

    def take_up(self, number: int) -> None:
        """Look at an event again that was dropped."""
        self._awake.add(number)

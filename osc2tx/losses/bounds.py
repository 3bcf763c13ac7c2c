"""How far documents are from their scenarios."""

from __future__ import annotations

from math import ceil, floor, log10
from typing import TypeAlias

from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Metres:
    """How far an actor is from its place, at most.

    Attributes:
        most: Metres.
        where: When that is, or what it depends on; empty if it is always so.
    """

    most: float
    where: str = ""

    def __str__(self) -> str:
        return " ".join(filter(None, (f"at most {self.rounded:g} m", self.where)))

    @property
    def rounded(self) -> float:
        """Metres with two digits, never less than they are."""
        return rounded_up(self.most)


@dataclass(frozen=True, slots=True)
class UpToTool:
    """A bound where each tool has a law of its own, which no played document measures.

    Attributes:
        words: What differs at most.
    """

    words: str

    def __str__(self) -> str:
        return self.words


Bound: TypeAlias = Metres | UpToTool | str
"""How far an approximation is from the original; in words it is completed by what is measured."""


UNMEASURED = "not measured"
"""The bound of what no played document has shown."""

ROUNDING = 1e-6


def rounded_up(value: float) -> float:
    """Return a number with two digits, never less than it is."""
    if value <= 0.0:
        return 0.0
    digit = 10.0 ** (floor(log10(value)) - 1)
    return round(ceil(value / digit - ROUNDING) * digit, 6)


@dataclass(frozen=True, slots=True)
class Measured:
    """How far a document is off in runs, at most.

    Attributes:
        place: Between an actor in the document and in the world (m).
        speed: Between their speeds (m/s).
        time: Between the times of an event, or of the end (s).
        events: Events that are missing, too late or in another order.
        runs: Number of runs.
        omitted: Why runs with limits of open ranges showed nothing, each reason once.
    """

    place: float
    speed: float
    time: float
    events: int = 0
    runs: int = 1
    omitted: tuple[str, ...] = ()

    def __str__(self) -> str:
        events = f", with {self.events} other event{'s' * (self.events > 1)}" * bool(self.events)
        values = self.values()
        if not any((*values.values(), events)):
            return "measured: no deviation"
        return (
            f"measured: at most {values['place']:g} m, {values['speed']:g} m/s and"
            f" {values['time']:g} s{events}"
        )

    def values(self) -> dict[str, float]:
        """Return the largest deviations, rounded up; noise of the computation counts as none."""
        found = {"place": self.place, "speed": self.speed, "time": self.time}
        return {name: rounded_up(value) if value > NOISE else 0.0 for name, value in found.items()}


NOISE = 1e-3
"""Below this, deviations in m, m/s and s are those of rounded numbers in documents."""

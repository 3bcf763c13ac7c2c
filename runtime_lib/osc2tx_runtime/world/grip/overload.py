"""What is said of a motion that no vehicle can drive."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal

from osc2tx_runtime.opendrive import LanePosition
from osc2tx_shared.classes import dataclass

from .friction import RoadCondition

__all__ = ["Excess", "Overload"]

Excess = Literal["slides", "overturns", "jumps"]
"""More than tyres transmit, than its height allows, or a lateral speed from one step to the next"""

WORDS: Mapping[RoadCondition, str] = {
    "dry": "dry",
    "wet": "wet",
    "snow": "snowy",
    "ice": "icy",
}
_STRAIGHT = 1e3  # m: radius from which on it is not the bend that asks too much


@dataclass(slots=True)
class Overload:
    """A time in which an actor was to move as it cannot, at one place.

    Attributes:
        actor: Who.
        time: When it began (s).
        end: The last instant of it (s).
        last: The last instant at which it happened there again (s).
        again: How often it came back there.
        excess: What is wrong.
        speed: m/s at its worst instant.
        along: m/s^2 along the way then.
        across: m/s^2 across it then; of a jump the change of the lateral speed (m/s).
        limit: m/s^2 that are possible.
        road: Its condition.
        place: Where that was; None off the road.
        x: World x of that place (m).
        y: World y (m).
    """

    actor: str
    time: float
    end: float
    last: float
    again: int
    excess: Excess
    speed: float
    along: float
    across: float
    limit: float
    road: RoadCondition
    place: LanePosition | None
    x: float
    y: float

    @property
    def measure(self) -> float:
        """How bad it is, among those of its kind."""
        return math.hypot(self.along, self.across)

    def __str__(self) -> str:
        """What is wrong, where and when."""
        place = self.place
        where = f"x {self.x:.1f}, y {self.y:.1f}"
        if place is not None:
            where = f"road {place.road}, lane {place.lane}, s {place.s:.1f} m"
        times = {0: "", 1: ", and once more"}.get(self.again, f", and {self.again} times more")
        return (
            f"{self.actor} cannot be driven so: {self._figures} ({where}; from"
            f" {self.time:.2f} s to {self.end:.2f} s{times})"
        )

    @property
    def _figures(self) -> str:
        if self.excess == "jumps":
            return (
                f"at {self.speed:.1f} m/s its speed across the lane changes by"
                f" {abs(self.across):.2f} m/s at once"
            )
        how = f"{abs(self.across):.1f} m/s^2 across its way"
        if abs(self.along) > 0.5 * self.limit:
            how = f"{self.measure:.1f} m/s^2, {abs(self.across):.1f} of them across its way,"
        radius = self.speed * self.speed / max(abs(self.across), 1e-9)
        bend = f" and a radius of {radius:.1f} m" if 0.0 < radius < _STRAIGHT else ""
        bound = f"that the {WORDS[self.road]} road holds"
        if self.excess == "overturns":
            bound = "at which it tips over"
        return (
            f"{how} at {self.speed:.1f} m/s{bend} are more than the {self.limit:.1f} m/s^2 {bound}"
        )

"""What is said of a motion that no tyre can transmit."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from osc2tx_runtime.opendrive import LanePosition

from .friction import RoadCondition

__all__ = ["Overload"]

WORDS: Mapping[RoadCondition, str] = {
    "dry": "dry",
    "wet": "wet",
    "snow": "snowy",
    "ice": "icy",
}


@dataclass(slots=True)
class Overload:
    """A time in which an actor was to move as no tyre can.

    Attributes:
        actor: Who.
        time: When it began (s).
        end: The last instant of it (s).
        speed: m/s at its worst instant.
        along: m/s^2 along the way then.
        across: m/s^2 across it then.
        limit: m/s^2 that the road holds.
        road: Its condition.
        place: Where that was; None off the road.
        x: World x of that place (m).
        y: World y (m).
    """

    actor: str
    time: float
    end: float
    speed: float
    along: float
    across: float
    limit: float
    road: RoadCondition
    place: LanePosition | None
    x: float
    y: float

    def __str__(self) -> str:
        """What is wrong, where and when."""
        place, many = self.place, math.hypot(self.along, self.across)
        where = f"x {self.x:.1f}, y {self.y:.1f}"
        if place is not None:
            where = f"road {place.road}, lane {place.lane}, s {place.s:.1f} m"
        how = f"{abs(self.across):.1f} m/s^2 across its way"
        if abs(self.along) > 0.5 * self.limit:
            how = f"{many:.1f} m/s^2, {abs(self.across):.1f} of them across its way,"
        return (
            f"{self.actor} cannot be driven so: {how} at {self.speed:.1f} m/s are more than the"
            f" {self.limit:.1f} m/s^2 that the {WORDS[self.road]} road holds ({where}; from"
            f" {self.time:.2f} s to {self.end:.2f} s)"
        )

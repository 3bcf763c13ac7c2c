"""Motions beyond the grip or rollover limit of a vehicle, for warnings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal

from osc2tx_runtime.opendrive import LanePosition
from osc2tx_shared.classes import dataclass

from .friction import RoadCondition

Excess = Literal["slides", "overturns", "jumps"]
"""Beyond the grip limit, beyond the rollover limit, or a jump of the lateral speed."""

WORDS: Mapping[RoadCondition, str] = {
    "dry": "dry",
    "wet": "wet",
    "snow": "snowy",
    "ice": "icy",
}
_STRAIGHT = 1e3  # m: at larger radii the bend does not cause the acceleration


@dataclass(slots=True)
class Overload:
    """A time in which the motion of an actor exceeds a limit, at one position.

    Attributes:
        actor: Its id.
        time: Its first instant (s).
        end: Its last instant (s).
        last: The last instant of a later excess at the same position (s).
        again: Number of later excesses at the same position.
        excess: The exceeded limit.
        speed: Speed at the largest excess (m/s).
        along: Longitudinal acceleration at the largest excess (m/s^2).
        across: Lateral acceleration at the largest excess (m/s^2); of a jump, the change of the
            lateral speed (m/s).
        limit: The limit (m/s^2).
        road: Condition of the road.
        place: Position on the road; None off the road.
        x: World x of that position (m).
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
        """The total acceleration (m/s^2), which orders excesses of one kind."""
        return math.hypot(self.along, self.across)

    def __str__(self) -> str:
        """The excess with position and time."""
        place = self.place
        where = f"x {self.x:.1f}, y {self.y:.1f}"
        if place is not None:
            where = f"road {place.road}, lane {place.lane}, s {place.s:.1f} m"
        times = {0: "", 1: ", and once more"}.get(self.again, f", and {self.again} times more")
        return (
            f"{self.actor}: {self._figures} ({where}; from {self.time:.2f} s to"
            f" {self.end:.2f} s{times})"
        )

    @property
    def _figures(self) -> str:
        if self.excess == "jumps":
            return (
                f"lateral speed changes by {abs(self.across):.2f} m/s within a step, at"
                f" {self.speed:.1f} m/s"
            )
        lateral = f"{abs(self.across):.1f} m/s^2"
        found = f"lateral acceleration {lateral}"
        if abs(self.along) > 0.5 * self.limit:
            found = f"acceleration {self.measure:.1f} m/s^2 (lateral {lateral})"
        radius = self.speed * self.speed / max(abs(self.across), 1e-9)
        bend = f" and a radius of {radius:.1f} m" if 0.0 < radius < _STRAIGHT else ""
        bound = f"grip limit of {self.limit:.1f} m/s^2 on the {WORDS[self.road]} road"
        if self.excess == "overturns":
            bound = f"rollover limit of {self.limit:.1f} m/s^2"
        return f"{found} exceeds the {bound}, at {self.speed:.1f} m/s{bend}"

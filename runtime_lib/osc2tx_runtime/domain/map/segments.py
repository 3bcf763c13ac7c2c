"""Segments of a map that declared roads, lanes and crossings stand for."""

from __future__ import annotations

import math
from typing import Literal

from osc2tx_shared.classes import dataclass

PartKind = Literal[
    "road",
    "lane_section",
    "lane",
    "compound_lane",
    "compound_route",
    "crossing",
    "junction",
    "path",
    "route",
]


@dataclass(frozen=True, slots=True)
class CrossingLine:
    """The straight path of a crossing, from the centre of a lane to that of another.

    Attributes:
        x: Its start (m).
        y: Likewise.
        z: Likewise.
        heading: Its direction (rad).
        length: Its length (m).
        climb: Height of its end above its start (m).
        start_s: Metres along the start lane, from the start of that lane.
        end_s: Likewise of the lane at which it ends.
        crosswalk: Id of the crosswalk of the map that lies there; None without one.
        width: Width of that crosswalk (m).
    """

    x: float
    y: float
    z: float
    heading: float
    length: float
    climb: float
    start_s: float
    end_s: float
    crosswalk: str | None = None
    width: float | None = None

    def at(self, s: float, t: float = 0.0) -> tuple[float, float, float]:
        """Point (m) at a distance along it and a distance to the left of it."""
        c, n = math.cos(self.heading), math.sin(self.heading)
        climbed = self.climb * s / self.length
        return self.x + s * c - t * n, self.y + s * n + t * c, self.z + climbed

    def place_of(self, x: float, y: float) -> tuple[float, float]:
        """Distances (m) of a point along it and to the left of it."""
        c, n = math.cos(self.heading), math.sin(self.heading)
        dx, dy = x - self.x, y - self.y
        return dx * c + dy * n, dy * c - dx * n


@dataclass(frozen=True, slots=True)
class MapSegment:
    """A segment of a map.

    Attributes:
        kind: Its kind.
        road: Road id; the junction's for junctions.
        section: Number of the lane section; None for a whole road.
        lane: Lane id; None for whole cross-sections.
        forwards: Traffic on it runs with s; roads are seen in the direction of s.
        parts: The parts of a compound one, in order; the lanes that a crossing joins.
        line: The line of a crossing.
    """

    kind: PartKind
    road: str
    section: int | None = None
    lane: int | None = None
    forwards: bool = True
    parts: tuple[MapSegment, ...] = ()
    line: CrossingLine | None = None

    def __str__(self) -> str:
        if self.kind == "compound_route":
            return " then ".join(str(part) for part in self.parts)
        if self.kind == "junction":
            return f"junction {self.road}"
        if self.kind == "crossing":
            return f"the crossing of road {self.road}"
        lane = "" if self.lane is None else f"lane {self.lane} of "
        return f"{lane}road {self.road}"

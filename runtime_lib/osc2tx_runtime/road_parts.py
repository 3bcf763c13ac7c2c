"""Roads, lanes and junctions as scenarios declare them (DSL 8.12): unknowns that a map fills in.

A scenario says what its roads are like (`number_of_lanes`, `lane_side`, ...); before the start the
`MapSolver` chooses for each of them a stretch of the map for which all that holds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.traffic_lights import MapObject

__all__ = [
    "CompoundLane",
    "CompoundRoute",
    "Junction",
    "Lane",
    "LaneSection",
    "PartKind",
    "Road",
    "RoadPart",
    "RoadPath",
    "Stretch",
]

PartKind = Literal[
    "road", "lane_section", "lane", "compound_lane", "compound_route", "junction", "path"
]


@dataclass(frozen=True, slots=True)
class Stretch:
    """A part of a map.

    Attributes:
        kind: What it is.
        road: Road id; the junction's for junctions.
        section: Number of the lane section; None for a whole road.
        lane: Lane id; None for whole cross-sections.
        forwards: Traffic on it runs with s; roads are seen in the direction of s.
        parts: What a compound one consists of, in order.
    """

    kind: PartKind
    road: str
    section: int | None = None
    lane: int | None = None
    forwards: bool = True
    parts: tuple[Stretch, ...] = ()

    def __str__(self) -> str:
        if self.kind == "compound_route":
            return " then ".join(str(part) for part in self.parts)
        if self.kind == "junction":
            return f"junction {self.road}"
        lane = "" if self.lane is None else f"lane {self.lane} of "
        return f"{lane}road {self.road}"


class RoadPart(MapObject):
    """Something of the road network that a scenario declares.

    Args:
        anchors: Where it is in the map file: the id or the name of its road, or `road:lane`.
        min_lanes: Least number of drivable lanes.
        max_lanes: Largest number of drivable lanes.
        min_length: Least length (m).
        within: A longer part that it belongs to.
    """

    word = "route"
    kind: ClassVar[PartKind]

    def __init__(
        self,
        *,
        anchors: Sequence[str] = (),
        min_lanes: int | None = None,
        max_lanes: int | None = None,
        min_length: float = 0.0,
        within: RoadPart | None = None,
    ) -> None:
        super().__init__(None)
        self.anchors = tuple(anchors)
        self.min_lanes, self.max_lanes, self.min_length = min_lanes, max_lanes, min_length
        self.within = within
        self._found: Stretch | None = None

    @property
    def found(self) -> Stretch:
        """The stretch of the map that was chosen."""
        if self._found is None:
            raise ScenarioError(f"a {self.kind} is used before the map is known")
        return self._found

    def choose(self, stretch: Stretch) -> None:
        """Takes the stretch of the map that was chosen."""
        self._found = stretch


class Road(RoadPart):
    """A road outside of junctions."""

    kind = "road"

    def __init__(
        self,
        *,
        anchors: Sequence[str] = (),
        min_lanes: int | None = None,
        max_lanes: int | None = None,
    ) -> None:
        super().__init__(anchors=anchors, min_lanes=min_lanes, max_lanes=max_lanes)


class LaneSection(RoadPart):
    """The lanes of one direction, side by side, as long as their number stays the same."""

    kind = "lane_section"

    def __init__(
        self,
        *,
        road: Road | None = None,
        anchors: Sequence[str] = (),
        min_lanes: int | None = None,
        max_lanes: int | None = None,
    ) -> None:
        super().__init__(anchors=anchors, min_lanes=min_lanes, max_lanes=max_lanes, within=road)


class Lane(RoadPart):
    """A drivable lane of a lane section."""

    kind = "lane"

    def __init__(
        self, *, lane_section: LaneSection | None = None, anchors: Sequence[str] = ()
    ) -> None:
        super().__init__(anchors=anchors, within=lane_section)


class CompoundLane(RoadPart):
    """Lanes that follow each other, over all lane sections of a road."""

    kind = "compound_lane"

    def __init__(self, *, anchors: Sequence[str] = ()) -> None:
        super().__init__(anchors=anchors)


class CompoundRoute(RoadPart):
    """Roads that follow each other through junctions."""

    kind = "compound_route"

    def __init__(self, *, anchors: Sequence[str] = ()) -> None:
        super().__init__(anchors=anchors)


class Junction(RoadPart):
    """A junction."""

    kind = "junction"

    def __init__(self) -> None:
        super().__init__()


class RoadPath(RoadPart):
    """A piece of road for the scenario to begin on, as ScenarioRunner's `Path` asks for one.

    It is the longest lane section that has everything asked of it.
    """

    kind = "path"

    def __init__(
        self,
        *,
        min_lanes: int | None = None,
        max_lanes: int | None = None,
        min_length: float = 0.0,
    ) -> None:
        super().__init__(min_lanes=min_lanes, max_lanes=max_lanes, min_length=min_length)

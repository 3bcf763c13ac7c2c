"""Map modifiers about lanes: their number and order (DSL 8.12.2.2)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from osc2tx_runtime.domain.map.lane_types import kind_of_lane
from osc2tx_runtime.domain.map.road_graph import RoadGraph
from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.modifiers.registry import modifier
from osc2tx_runtime.enums import Directionality, LaneType, LaneUse, SideLeftRight
from osc2tx_shared.classes import dataclass

from .base import Known, MapModifier, Row, fits

__all__ = ["CompoundLaneSide", "EndLane", "LaneSide", "NumberOfLanes", "StartLane"]


@modifier("number_of_lanes", needs=("map",))
@dataclass(frozen=True, slots=True)
class NumberOfLanes(MapModifier):
    """A route has a number of lanes: both directions of a road, one of a lane section.

    Attributes:
        route: The route; with several sections the number holds in each of them.
        num_of_lanes: Number of lanes.
        lane_type: The type of the counted lanes; `driving` if neither type nor use is given.
        lane_use: Their use.
        directionality: Their directions.
    """

    route: RoadPart
    num_of_lanes: int
    lane_type: LaneType | None = None
    lane_use: LaneUse | None = None
    directionality: Directionality | None = None

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Routes with this number."""
        for route in self.candidates(graph, known, "route"):
            numbers = {self._count(graph, section) for section in graph.sections_of(route)}
            if numbers == {self.num_of_lanes}:
                yield {"route": route}

    def _count(self, graph: RoadGraph, segment: MapSegment) -> int:
        road = graph.map.roads[segment.road]
        section = road.sections[segment.section or 0]
        both = segment.kind == "road"
        direction = 1 if segment.forwards else -1
        return sum(
            self._counts(lane.type)
            for lane in section.lanes.values()
            if (both or lane.direction == direction)
            and (segment.lane is None or lane.id == segment.lane)
        )

    def _counts(self, type_: str) -> bool:
        kind = kind_of_lane(type_)
        wanted = self.lane_type or ("driving" if self.lane_use is None else kind.type)
        return (
            kind.type == wanted
            and self.lane_use in (None, kind.use)
            and self.directionality in (None, kind.directionality)
        )


@modifier("lane_side", needs=("map",))
@dataclass(frozen=True, slots=True)
class LaneSide(MapModifier):
    """A lane is `count` lanes beside another, in the same direction.

    Attributes:
        lane1: The lane.
        side: Side of `lane2` on which it is.
        lane2: The other lane.
        count: 1 for neighbours.
        lane_section: The section that both belong to.
    """

    lane1: RoadPart
    side: SideLeftRight
    lane2: RoadPart
    count: int = 1
    lane_section: RoadPart | None = None

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Pairs of lanes of one section."""
        for section in graph.sections:
            lanes = graph.lanes_of(section)
            for first, second in _beside(lanes, self.side, self.count):
                row = {"lane1": first, "lane2": second}
                if self.lane_section is not None:
                    row["lane_section"] = section
                if fits(row, known):
                    yield row


def _beside(
    lanes: tuple[MapSegment, ...], side: SideLeftRight, count: int
) -> Iterator[tuple[MapSegment, MapSegment]]:
    """Pairs of lanes, from the right, that are `count` lanes apart."""
    step = count if side == "left" else -count
    for index, second in enumerate(lanes):
        if 0 <= index + step < len(lanes):
            yield lanes[index + step], second


@modifier("compound_lane_side", needs=("map",))
@dataclass(frozen=True, slots=True)
class CompoundLaneSide(MapModifier):
    """A compound lane is `count` lanes beside another, over its whole length.

    Attributes:
        lane1: The compound lane.
        side: Side of `lane2` on which it is.
        lane2: The other one.
        count: 1 for neighbours.
        route: The road that both belong to.
    """

    lane1: RoadPart
    side: SideLeftRight
    lane2: RoadPart
    count: int = 1
    route: RoadPart | None = None

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Pairs of compound lanes of one road."""
        for first in self.candidates(graph, known, "lane1"):
            for second in self.candidates(graph, known, "lane2"):
                if first.road != second.road or len(first.parts) != len(second.parts):
                    continue
                pairs = zip(first.parts, second.parts, strict=True)
                if not all(self._is_beside(graph, one, other) for one, other in pairs):
                    continue
                row = {"lane1": first, "lane2": second}
                if self.route is not None:
                    row["route"] = MapSegment("road", first.road)
                if fits(row, known):
                    yield row

    def _is_beside(self, graph: RoadGraph, one: MapSegment, other: MapSegment) -> bool:
        section = MapSegment("lane_section", one.road, one.section, forwards=one.forwards)
        return (one, other) in _beside(graph.lanes_of(section), self.side, self.count)


@modifier("start_lane", needs=("map",))
@dataclass(frozen=True, slots=True)
class StartLane(MapModifier):
    """A lane that begins in its section: no lane of the section before leads to it."""

    lane: RoadPart
    forwards: ClassVar[bool] = False

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Lanes without predecessor."""
        for lane in self.candidates(graph, known, "lane"):
            beside = graph.after(lane) if self.forwards else graph.before(lane)
            if not beside:
                yield {"lane": lane}


@modifier("end_lane", needs=("map",))
@dataclass(frozen=True, slots=True)
class EndLane(StartLane):
    """A lane that ends in its section: it leads to no lane of the section after."""

    forwards: ClassVar[bool] = True

"""Declared roads, lanes and junctions, bound to segments of the map (DSL 8.12).

Values of the map can be read once it is known: `length`, `lanes`, `start_point()`.
"""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx_runtime.domain.map.road_graph import RoadGraph
from osc2tx_runtime.domain.map.route_elements import (
    SAME,
    PartT,
    Required,
    RoadPart,
    Route,
    fulfils,
    stated,
)
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.enums import Directionality, LaneType, LaneUse

__all__ = [
    "CompoundLane",
    "CompoundRoute",
    "Junction",
    "Lane",
    "LaneSection",
    "PartT",
    "Road",
    "RoadPart",
    "RoadPath",
    "Route",
]


class Road(Route):
    """A road outside of junctions."""

    kind = "road"

    def __init__(
        self,
        *,
        anchors: Sequence[str] = (),
        min_lanes: Required | None = None,
        max_lanes: Required | None = None,
        length: Required | None = None,
        directionality: Directionality | None = None,
        s_positive: Sequence[LaneSection] | None = None,
        s_negative: Sequence[LaneSection] | None = None,
    ) -> None:
        super().__init__(
            anchors=anchors,
            min_lanes=min_lanes,
            max_lanes=max_lanes,
            length=length,
            directionality=directionality,
            listed={"s_positive": s_positive, "s_negative": s_negative},
        )

    @property
    def s_positive(self) -> tuple[LaneSection, ...]:
        """Sections whose traffic runs with s, in order of s."""
        return self._sections(forwards=True)

    @property
    def s_negative(self) -> tuple[LaneSection, ...]:
        """Sections whose traffic runs against s, in order of s."""
        return self._sections(forwards=False)

    def _sections(self, *, forwards: bool) -> tuple[LaneSection, ...]:
        found = self.graph.sections_of_road(self.found.road, forwards=forwards)
        return self.seen(LaneSection, found)


class LaneSection(Route):
    """Adjacent lanes of one direction, while their number is constant."""

    kind = "lane_section"

    def __init__(
        self,
        *,
        road: Road | None = None,
        anchors: Sequence[str] = (),
        min_lanes: Required | None = None,
        max_lanes: Required | None = None,
        length: Required | None = None,
        directionality: Directionality | None = None,
        lanes: Sequence[Lane] | None = None,
        s_axis: Lane | None = None,
    ) -> None:
        super().__init__(
            anchors=anchors,
            min_lanes=min_lanes,
            max_lanes=max_lanes,
            length=length,
            directionality=directionality,
            within=road,
            listed={"lanes": lanes, "s_axis": None if s_axis is None else [s_axis]},
        )

    @property
    def road(self) -> Road:
        """The road that it belongs to."""
        return self._as(Road(), MapSegment("road", self.found.road))

    @property
    def lanes(self) -> tuple[Lane, ...]:
        """Its drivable lanes, from the right in direction of travel."""
        return self.seen(Lane, self.graph.lanes_of(self.found))

    @property
    def s_axis(self) -> Lane:
        """The lane along which s is measured: the rightmost one."""
        return self.lanes[0]


class Lane(Route):
    """A lane of a lane section; a drivable lane by default.

    Args:
        lane_section: The section that it belongs to.
        lane_type: Its users, roughly.
        lane_use: Its use, in more detail.
        width: Its width at its start (m) or range of widths.
        anchors: As of `RoadPart`.
        length: Likewise.
        directionality: Likewise.
    """

    kind = "lane"

    def __init__(
        self,
        *,
        lane_section: LaneSection | None = None,
        lane_type: LaneType | None = None,
        lane_use: LaneUse | None = None,
        width: Required | None = None,
        anchors: Sequence[str] = (),
        length: Required | None = None,
        directionality: Directionality | None = None,
    ) -> None:
        super().__init__(
            anchors=anchors, length=length, directionality=directionality, within=lane_section
        )
        self._type, self._use, self._width = lane_type, lane_use, width

    @property
    def requirements(self) -> str:
        """Its constraints on the map."""
        named = (("lane_type", self._type), ("lane_use", self._use))
        own = [f"{name} is {value}" for name, value in named if value is not None]
        own += [stated("width is {} m", self._width), super().requirements]
        return " and ".join(filter(None, own))

    def candidates(self, graph: RoadGraph) -> tuple[MapSegment, ...]:
        """Drivable lanes; other lanes only if their kind is required."""
        if self._type is None and self._use is None:
            return graph.lanes
        return (*graph.lanes, *graph.other_lanes)

    def suits(self, graph: RoadGraph, segment: MapSegment) -> bool:
        """Whether kind and width fit as well."""
        kind = graph.kind_of(segment)
        if self._type not in (None, kind.type) or self._use not in (None, kind.use):
            return False
        if not fulfils(self._width, graph.width_of(segment), SAME):
            return False
        return super().suits(graph, segment)

    @property
    def lane_section(self) -> LaneSection:
        """The section that it belongs to."""
        found = self.found
        section = MapSegment("lane_section", found.road, found.section, forwards=found.forwards)
        return self._as(LaneSection(), section)

    @property
    def lane_type(self) -> LaneType:
        """Its users, roughly."""
        return self.graph.kind_of(self.found).type

    @property
    def lane_use(self) -> LaneUse:
        """Its use, in more detail."""
        return self.graph.kind_of(self.found).use

    @property
    def width(self) -> float:
        """Its width at its start (m)."""
        return self.graph.width_of(self.found)


class CompoundLane(Route):
    """Lanes that follow each other, over all lane sections of a road."""

    kind = "compound_lane"

    def __init__(
        self,
        *,
        anchors: Sequence[str] = (),
        length: Required | None = None,
        lanes: Sequence[Lane] | None = None,
    ) -> None:
        super().__init__(anchors=anchors, length=length, listed={"lanes": lanes})

    @property
    def lanes(self) -> tuple[Lane, ...]:
        """The lanes, in direction of travel."""
        return self.seen(Lane, self.found.parts)


class CompoundRoute(Route):
    """Roads that follow each other through junctions."""

    kind = "compound_route"

    def __init__(
        self,
        *,
        anchors: Sequence[str] = (),
        length: Required | None = None,
        route_elements: Sequence[Route] | None = None,
    ) -> None:
        super().__init__(anchors=anchors, length=length, listed={"route_elements": route_elements})

    @property
    def route_elements(self) -> tuple[Route, ...]:
        """Its roads, in direction of travel."""
        return self.seen(Road, self.found.parts)


class Junction(RoadPart):
    """A junction."""

    kind = "junction"

    def __init__(self, *, roads: Sequence[Road] | None = None) -> None:
        super().__init__(listed={"roads": roads})

    @property
    def roads(self) -> tuple[Road, ...]:
        """The roads that meet in it, by their numbers."""
        found = self.graph.roads_at(self.found)
        return self.seen(Road, (MapSegment("road", road) for road in found))


class RoadPath(RoadPart):
    """A piece of road on which the scenario begins, as `Path` of ScenarioRunner.

    It is the longest lane section that fulfils its requirements.

    Args:
        min_lanes: As of `RoadPart`.
        max_lanes: Likewise.
        min_length: Least length (m).
        different_dest: A path with a different end.
        different_origin: A path with a different start.
    """

    kind = "path"

    def __init__(
        self,
        *,
        min_lanes: int | None = None,
        max_lanes: int | None = None,
        min_length: float = 0.0,
        different_dest: RoadPath | None = None,
        different_origin: RoadPath | None = None,
    ) -> None:
        super().__init__(min_lanes=min_lanes, max_lanes=max_lanes)
        self._min_length = min_length
        self.different_dest, self.different_origin = different_dest, different_origin

    @property
    def requirements(self) -> str:
        """Its constraints on the map."""
        own = f"there are {self._min_length:g} m" if self._min_length > 0.0 else ""
        return " and ".join(filter(None, [super().requirements, own]))

    def suits(self, graph: RoadGraph, segment: MapSegment) -> bool:
        """Whether it also has the required length."""
        return graph.length(segment) >= self._min_length and super().suits(graph, segment)

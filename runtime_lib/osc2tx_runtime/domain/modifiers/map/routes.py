"""Map modifiers: routes in sequence, overlapping, opposite (DSL 8.12.2.2)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TypeAlias

from osc2tx_runtime.domain.map.road_graph import RoadGraph
from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.modifiers.registry import modifier
from osc2tx_runtime.enums import JunctionDirection, LateralOverlapKind, RouteOverlapKind
from osc2tx_runtime.errors import UnsupportedError
from osc2tx_shared.classes import dataclass

from .base import Known, MapModifier, Row, fits

__all__ = ["RoadsFollowInJunction", "RoutesAreInSequence", "RoutesAreOpposite", "RoutesOverlap"]


_Ranges: TypeAlias = Mapping[str, tuple[float, float]]

_WITHIN = math.radians(10.0)  # of a direction at a junction (DSL 8.12.22)
_TURNS: Mapping[JunctionDirection, float] = {
    "straight": 0.0,
    "right": -0.5 * math.pi,
    "u_turn": math.pi,
    "left": 0.5 * math.pi,
}


@modifier("routes_are_in_sequence", needs=("map",))
@dataclass(frozen=True, slots=True)
class RoutesAreInSequence(MapModifier):
    """One route follows another: a lane of the first leads to a lane of the second.

    Attributes:
        preceding: The first.
        succeeding: The second; roads follow each other directly or through a junction.
        road: The road that contains both.
    """

    preceding: RoadPart
    succeeding: RoadPart
    road: RoadPart | None = None

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Pairs that follow each other."""
        for first in self.candidates(graph, known, "preceding"):
            ways = set(_onward(graph, first))
            for second in self.candidates(graph, known, "succeeding"):
                if second == first or not ways.intersection(_entries(graph, second)):
                    continue
                row = {"preceding": first, "succeeding": second}
                if self.road is None:
                    yield row
                elif first.road == second.road:
                    yield {**row, "road": MapSegment("road", first.road)}


def _exits(graph: RoadGraph, segment: MapSegment) -> tuple[MapSegment, ...]:
    """Lanes at the end of a segment, in its direction."""
    if segment.parts:
        return _exits(graph, segment.parts[-1])
    if segment.kind != "road":
        return graph.lanes_of(segment)
    last = len(graph.map.roads[segment.road].sections) - 1 if segment.forwards else 0
    return graph.lanes_of(MapSegment("lane_section", segment.road, last, forwards=segment.forwards))


def _entries(graph: RoadGraph, segment: MapSegment) -> tuple[MapSegment, ...]:
    """Lanes at the start of a segment; of a road at both ends, since it can be entered at both."""
    if segment.parts:
        return _entries(graph, segment.parts[0])
    if segment.kind != "road":
        return graph.lanes_of(segment)
    last = len(graph.map.roads[segment.road].sections) - 1
    ends = ((0, True), (last, False))
    return tuple(
        lane
        for section, forwards in ends
        for lane in graph.lanes_of(
            MapSegment("lane_section", segment.road, section, forwards=forwards)
        )
    )


def _onward(graph: RoadGraph, segment: MapSegment) -> Iterator[MapSegment]:
    """Lanes that follow the end of a segment, also through a junction."""
    for lane in _exits(graph, segment):
        for after in graph.after(lane):
            yield after
            if graph.map.roads[after.road].junction is not None:
                yield from graph.after(after)


@modifier("roads_follow_in_junction", needs=("map",))
@dataclass(frozen=True, slots=True)
class RoadsFollowInJunction(MapModifier):
    """A connection through a junction from one road to another.

    Attributes:
        junction: The junction.
        in_road: Road that enters it.
        out_road: Road that leaves it.
        direction: Direction of the turn, within 10 degrees.
        clockwise_count: Number of roads from the in-road to the out-road, clockwise.
        number_of_roads: Number of roads that meet in the junction.
        in_lane: Lane that enters it.
        out_lane: Lane that leaves it.
        junction_route: The lane in between.
        resulting_route: In-road, lane in between and out-road.
    """

    junction: RoadPart | None = None
    in_road: RoadPart | None = None
    out_road: RoadPart | None = None
    direction: JunctionDirection | None = None
    clockwise_count: int | None = None
    number_of_roads: int | None = None
    in_lane: RoadPart | None = None
    out_lane: RoadPart | None = None
    junction_route: RoadPart | None = None
    resulting_route: RoadPart | None = None

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Connections through junctions that fulfil the requirements."""
        asked = self.parts()
        for passage in graph.passages:
            if not self._turns(passage.turn):
                continue
            arms = sorted(graph.arms(passage.junction), reverse=True)  # clockwise
            roads = [road for _, road in arms]
            if self.number_of_roads not in (None, len(roads)):
                continue
            there, here = roads.index(passage.out_lane.road), roads.index(passage.in_lane.road)
            count = (there - here) % len(roads) or len(roads)
            if self.clockwise_count not in (None, count):
                continue
            row = {
                "junction": passage.junction,
                "in_road": MapSegment("road", passage.in_lane.road),
                "out_road": MapSegment("road", passage.out_lane.road),
                "in_lane": passage.in_lane,
                "out_lane": passage.out_lane,
                "junction_route": passage.via,
                "resulting_route": passage.route,
            }
            if fits(row, known):
                yield {name: row[name] for name in asked}

    def _turns(self, turn: float) -> bool:
        if self.direction is None:
            return True
        fits = {
            name: abs(math.remainder(turn - angle, math.tau)) <= _WITHIN
            for name, angle in _TURNS.items()
        }
        return fits.get(self.direction, not any(fits.values()))


@modifier("routes_overlap", needs=("map",))
@dataclass(frozen=True, slots=True)
class RoutesOverlap(MapModifier):
    """Two routes run side by side, or overlap, on a part of the same road.

    Attributes:
        route1: The first; the kinds of overlap are seen from it, in its direction.
        route2: The second.
        overlap_kind: Both share their start (`start`), their end (`end`) or both of them (`equal`);
            the first lies within the second (`inside`); otherwise `other`.
    """

    route1: RoadPart
    route2: RoadPart
    overlap_kind: RouteOverlapKind

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Pairs that overlap so."""
        for first in self.candidates(graph, known, "route1"):
            for second in self.candidates(graph, known, "route2"):
                if self.overlap_kind in _kinds_of_overlap(graph, first, second):
                    yield {"route1": first, "route2": second}


def _kinds_of_overlap(
    graph: RoadGraph, first: MapSegment, second: MapSegment
) -> set[RouteOverlapKind]:
    """The `route_overlap_kind` of two routes (DSL 8.12.23); empty if they do not overlap."""
    one, other = _ranges(graph, first), _ranges(graph, second)
    both = [(one[road], other[road]) for road in one.keys() & other.keys()]
    if not any(min(a[1], b[1]) > max(a[0], b[0]) for a, b in both):
        return set()
    found: set[RouteOverlapKind] = set()
    start, end = _ends(one, first)
    points = _ends(other, second)
    if start in points:
        found.add("start")
    if end in points:
        found.add("end")
    if len(found) == 2:
        found.add("equal")
    if len(both) == len(one) and all(b[0] <= a[0] and a[1] <= b[1] for a, b in both):
        found.add("inside")
    return {"any", *(found or ("other",))}


def _ends(ranges: _Ranges, segment: MapSegment) -> tuple[tuple[str, float], tuple[str, float]]:
    """Road and s of its start and of its end, in its direction."""
    parts = [each for each in segment.parts if each.road in ranges] or [segment]
    first, last = parts[0], parts[-1]
    start = ranges[first.road][0 if first.forwards else 1]
    end = ranges[last.road][1 if last.forwards else 0]
    return (first.road, start), (last.road, end)


def _ranges(graph: RoadGraph, segment: MapSegment) -> _Ranges:
    """Range of s by road."""
    if segment.kind == "compound_route":
        return {part.road: (0.0, graph.map.roads[part.road].length) for part in segment.parts}
    if segment.kind == "junction":
        return {}
    road = graph.map.roads[segment.road]
    if segment.parts:
        numbers = [part.section or 0 for part in segment.parts]
        begin, end = road.sections[min(numbers)].begin, road.sections[max(numbers)].end
        return {segment.road: (begin, end)}
    if segment.section is None:
        return {segment.road: (0.0, road.length)}
    section = road.sections[segment.section]
    return {segment.road: (section.begin, section.end)}


@modifier("routes_are_opposite", needs=("map",))
@dataclass(frozen=True, slots=True)
class RoutesAreOpposite(MapModifier):
    """Two routes of one road run in opposite directions.

    Attributes:
        route1: A lane section, lane or compound lane.
        route2: The other one.
        containing_road: The road.
        lateral_overlap: Whether they share lanes: `always` requires lanes for both directions.
    """

    route1: RoadPart
    route2: RoadPart
    containing_road: RoadPart | None = None
    lateral_overlap: LateralOverlapKind = "never"

    def __post_init__(self) -> None:
        """Rejects roads, which have no direction, and lanes for both directions."""
        for part in (self.route1, self.route2):
            if part.kind not in ("lane_section", "lane", "compound_lane"):
                raise UnsupportedError(f"{self.name}: a {part.kind} has no direction of its own")
        if self.lateral_overlap != "never":
            raise UnsupportedError(
                f"{self.name}: lateral_overlap `{self.lateral_overlap}` needs lanes that are"
                " driven in both directions, which this runtime does not drive on"
            )

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Pairs of routes side by side."""
        for first in self.candidates(graph, known, "route1"):
            for second in self.candidates(graph, known, "route2"):
                opposite = first.road == second.road and first.forwards != second.forwards
                if not opposite or first.section != second.section:
                    continue
                row = {"route1": first, "route2": second}
                if self.containing_road is not None:
                    row["containing_road"] = MapSegment("road", first.road)
                if fits(row, known):
                    yield row

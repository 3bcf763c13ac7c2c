"""The lane graph of a map with its crossings and junction passages."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, NamedTuple

from osc2tx_runtime.domain.map.crossing_lines import on_crosswalk
from osc2tx_runtime.domain.map.lane_graph import LaneGraph
from osc2tx_runtime.domain.map.segments import MapSegment, PartKind
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.opendrive.geometry import wrap

if TYPE_CHECKING:
    from osc2tx_runtime.domain.map.lane_graph import LaneGraph


class Passage(NamedTuple):
    """A connection through a junction, from lane to lane.

    Attributes:
        junction: The junction.
        in_lane: Lane that enters it.
        via: Lane in it.
        out_lane: Lane that leaves it.
        turn: Change of heading (rad), to the left positive, in (-pi, pi].
    """

    junction: MapSegment
    in_lane: MapSegment
    via: MapSegment
    out_lane: MapSegment
    turn: float

    @property
    def route(self) -> MapSegment:
        """In-road, junction and out-road as one route."""
        roads = (self.in_lane, self.via, self.out_lane)
        parts = tuple(MapSegment("road", r.road, forwards=r.forwards) for r in roads)
        return MapSegment("compound_route", parts[0].road, parts=parts)


def passages_of(graph: LaneGraph) -> tuple[Passage, ...]:
    """All connections through the junctions of a map, by entering lane."""
    found = []
    for lane in graph.lanes:
        for via in graph.after(lane):
            junction = graph.map.roads[via.road].junction
            if junction is None:
                continue
            inside = MapSegment("junction", junction)
            for out in graph.after(via):
                if graph.map.roads[out.road].junction is None:
                    turn = graph.heading(out, at_end=False) - graph.heading(lane, at_end=True)
                    turn = wrap(turn)
                    found.append(Passage(inside, lane, via, out, turn))
    return tuple(found)


def arms_of(
    graph: LaneGraph, passages: Sequence[Passage], junction: MapSegment
) -> Iterator[tuple[float, str]]:
    """Roads that meet in a junction: direction in which they leave it (rad), and their id."""
    seen: dict[str, float] = {}
    for passage in passages:
        if passage.junction != junction:
            continue
        entry = graph.heading(passage.in_lane, at_end=True) + math.pi
        seen.setdefault(passage.in_lane.road, entry)
        seen.setdefault(passage.out_lane.road, graph.heading(passage.out_lane, at_end=False))
    for road, heading in seen.items():
        yield heading % math.tau, road


@lru_cache(maxsize=4)
def graph_of(road_map: RoadMap) -> RoadGraph:
    """The graph of a map; the same one while it is in use."""
    return RoadGraph(road_map)


class RoadGraph(LaneGraph):
    """The lane graph of a map with derived elements: crossings, connections through junctions."""

    def all(self, kind: PartKind) -> tuple[MapSegment, ...]:
        """All segments of a kind: by numbers of road and section, lanes from the right."""
        match kind:
            case "road" | "route":
                return self.roads
            case "lane_section":
                return self.sections
            case "lane":
                return self.lanes
            case "compound_lane":
                return self.compound_lanes
            case "path":
                return self.paths
            case "junction":
                return tuple(MapSegment("junction", each) for each in self.map.junctions)
            case "crossing":
                return self.crossings
            case _:
                return tuple(dict.fromkeys(passage.route for passage in self.passages))

    @cached_property
    def crossings(self) -> tuple[MapSegment, ...]:
        """Crosswalks of the map, each in both directions."""
        return tuple(each for walk in self.map.crosswalks() for each in on_crosswalk(self, walk))

    # --- junctions ----------------------------------------------------------------------------

    @cached_property
    def passages(self) -> tuple[Passage, ...]:
        """Connections through junctions."""
        return passages_of(self)

    def arms(self, junction: MapSegment) -> Iterator[tuple[float, str]]:
        """Roads that meet in a junction: direction in which they leave it (rad), and their id."""
        return arms_of(self, self.passages, junction)

    def roads_at(self, junction: MapSegment) -> tuple[str, ...]:
        """Ids of the roads that meet in a junction, in the order of the map."""
        found = {road for _, road in self.arms(junction)}
        return tuple(road for road in self.map.roads if road in found)

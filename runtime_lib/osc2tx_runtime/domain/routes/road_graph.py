"""The lane graph of a map with its crossings and junction passages."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property, lru_cache

from osc2tx_runtime.domain.routes.crossing_lines import on_crosswalk
from osc2tx_runtime.domain.routes.junction_passages import Passage, arms_of, passages_of
from osc2tx_runtime.domain.routes.lane_graph import LaneGraph
from osc2tx_runtime.domain.routes.map_segments import MapSegment, PartKind
from osc2tx_runtime.opendrive import RoadMap

__all__ = ["RoadGraph", "graph_of"]


@lru_cache(maxsize=4)
def graph_of(road_map: RoadMap) -> RoadGraph:
    """The graph of a map; the same one as long as it is in use."""
    return RoadGraph(road_map)


class RoadGraph(LaneGraph):
    """The lane graph of a map with what is made from it: crossings, ways through junctions."""

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
        """Ways through junctions."""
        return passages_of(self)

    def arms(self, junction: MapSegment) -> Iterator[tuple[float, str]]:
        """Roads that meet in a junction: direction in which they leave it (rad), and their id."""
        return arms_of(self, self.passages, junction)

    def roads_at(self, junction: MapSegment) -> tuple[str, ...]:
        """Ids of the roads that meet in a junction, in the order of the map."""
        found = {road for _, road in self.arms(junction)}
        return tuple(road for road in self.map.roads if road in found)

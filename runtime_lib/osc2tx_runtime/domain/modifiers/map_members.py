"""Constraints on the members of roads and lanes: `keep(it.lanes == [...])`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from osc2tx_classes import dataclass
from osc2tx_runtime.domain.routes.map_segments import MapSegment
from osc2tx_runtime.domain.routes.road_graph import RoadGraph
from osc2tx_runtime.domain.routes.roads_and_lanes import RoadPart

from .map_base import Known, MapModifier, Row, fits

__all__ = ["ConsistsOf", "listed_members"]

Find = Callable[[RoadGraph, MapSegment], Sequence[MapSegment]]

_MEMBERS: Mapping[tuple[str, str], Find] = {
    ("compound_lane", "lanes"): lambda graph, part: part.parts,
    ("compound_route", "route_elements"): lambda graph, part: part.parts,
    ("junction", "roads"): lambda graph, part: [
        MapSegment("road", road) for road in graph.roads_at(part)
    ],
    ("lane_section", "lanes"): lambda graph, part: graph.lanes_of(part),
    ("lane_section", "s_axis"): lambda graph, part: graph.lanes_of(part)[:1],
    ("road", "s_positive"): lambda graph, part: graph.sections_of_road(part.road, forwards=True),
    ("road", "s_negative"): lambda graph, part: graph.sections_of_road(part.road, forwards=False),
}
"""Kind of part and name of the member -> what the map has there, in order."""


@dataclass(frozen=True, slots=True)
class ConsistsOf(MapModifier):
    """A part has these members and no others, in this order.

    Attributes:
        whole: The part.
        member: Name of the member.
        listed: What it is.
    """

    name = "the list of its members"
    whole: RoadPart
    member: str
    listed: tuple[RoadPart, ...]

    def parts(self) -> dict[str, RoadPart]:
        """The part, and its members by their numbers."""
        return {"whole": self.whole} | {str(i): part for i, part in enumerate(self.listed)}

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Parts that have so many members."""
        find = _MEMBERS[self.whole.kind, self.member]
        for whole in self.candidates(graph, known, "whole"):
            found = find(graph, whole)
            row = {"whole": whole} | {str(i): part for i, part in enumerate(found)}
            if len(found) == len(self.listed) and fits(row, known):
                yield row


def listed_members(part: RoadPart) -> Iterator[ConsistsOf]:
    """What a part says of its members."""
    for name, listed in part.listed.items():
        yield ConsistsOf(part, name, tuple(listed))

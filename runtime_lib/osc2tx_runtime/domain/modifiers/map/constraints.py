"""Constraints on the members of roads and lanes: `keep(it.lanes == [...])`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

from osc2tx_runtime.domain.map.road_graph import RoadGraph
from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart, RoadPath
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_shared.classes import dataclass

from .base import Known, MapModifier, Row, fits

__all__ = [
    "ConsistsOf",
    "PathEndsElsewhere",
    "PathStartsElsewhere",
    "differences",
    "listed_members",
]

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
"""Kind of part and name of the member -> the elements of the map, in order."""


@dataclass(frozen=True, slots=True)
class ConsistsOf(MapModifier):
    """A part has these members and no others, in this order.

    Attributes:
        whole: The part.
        member: Name of the member.
        listed: The listed elements.
    """

    name = "the list of its members"
    whole: RoadPart
    member: str
    listed: tuple[RoadPart, ...]

    def parts(self) -> dict[str, RoadPart]:
        """The part, and its members by their numbers."""
        return {"whole": self.whole} | {str(i): part for i, part in enumerate(self.listed)}

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Parts of the map whose members match the listed ones."""
        find = _MEMBERS[self.whole.kind, self.member]
        for whole in self.candidates(graph, known, "whole"):
            found = find(graph, whole)
            row = {"whole": whole} | {str(i): part for i, part in enumerate(found)}
            if len(found) == len(self.listed) and fits(row, known):
                yield row


def listed_members(part: RoadPart) -> Iterator[ConsistsOf]:
    """The constraints of a part on its members."""
    for name, listed in part.listed.items():
        yield ConsistsOf(part, name, tuple(listed))


_ELSEWHERE = 1.0  # m apart


@dataclass(frozen=True, slots=True)
class PathEndsElsewhere(MapModifier):
    """The end of a path differs from that of another."""

    name = "path_different_dest"
    path: RoadPath
    other: RoadPath

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Pairs of paths that differ."""
        for path in self.candidates(graph, known, "path"):
            here = self.place(graph, path)
            for other in self.candidates(graph, known, "other"):
                if math.dist(here, self.place(graph, other)) > _ELSEWHERE:
                    yield {"path": path, "other": other}

    def place(self, graph: RoadGraph, path: MapSegment) -> tuple[float, float]:
        """The compared point (m)."""
        at = graph.map.pose(graph.end(path))
        return at.x, at.y


@dataclass(frozen=True, slots=True)
class PathStartsElsewhere(PathEndsElsewhere):
    """The start of a path differs from that of another."""

    name = "path_different_origin"

    def place(self, graph: RoadGraph, path: MapSegment) -> tuple[float, float]:
        """The compared point (m)."""
        at = graph.map.pose(graph.begin(path))
        return at.x, at.y


def differences(path: RoadPath) -> Iterator[MapModifier]:
    """The constraints of a path on other parts."""
    if path.different_dest is not None:
        yield PathEndsElsewhere(path, path.different_dest)
    if path.different_origin is not None:
        yield PathStartsElsewhere(path, path.different_origin)

"""Constraints that paths begin or end in different places."""

from __future__ import annotations

import math
from collections.abc import Iterator

from osc2tx_classes import dataclass
from osc2tx_runtime.domain.routes.map_segments import MapSegment
from osc2tx_runtime.domain.routes.road_graph import RoadGraph
from osc2tx_runtime.domain.routes.roads_and_lanes import RoadPath

from .map_base import Known, MapModifier, Row

__all__ = ["PathEndsElsewhere", "PathStartsElsewhere", "differences"]

_ELSEWHERE = 1.0  # m apart


@dataclass(frozen=True, slots=True)
class PathEndsElsewhere(MapModifier):
    """A path ends at another place than another one."""

    name = "path_different_dest"
    path: RoadPath
    other: RoadPath

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Pairs of paths of which that is true."""
        for path in self.candidates(graph, known, "path"):
            here = self.place(graph, path)
            for other in self.candidates(graph, known, "other"):
                if math.dist(here, self.place(graph, other)) > _ELSEWHERE:
                    yield {"path": path, "other": other}

    def place(self, graph: RoadGraph, path: MapSegment) -> tuple[float, float]:
        """The place that counts (m)."""
        at = graph.map.pose(graph.end(path))
        return at.x, at.y


@dataclass(frozen=True, slots=True)
class PathStartsElsewhere(PathEndsElsewhere):
    """A path begins at another place than another one."""

    name = "path_different_origin"

    def place(self, graph: RoadGraph, path: MapSegment) -> tuple[float, float]:
        """The place that counts (m)."""
        at = graph.map.pose(graph.begin(path))
        return at.x, at.y


def differences(path: RoadPath) -> Iterator[MapModifier]:
    """What a path asks of others."""
    if path.different_dest is not None:
        yield PathEndsElsewhere(path, path.different_dest)
    if path.different_origin is not None:
        yield PathStartsElsewhere(path, path.different_origin)

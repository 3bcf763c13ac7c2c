"""Base of the map modifiers: properties of declared roads and lanes (DSL 8.12.2.2).

Each is a relation between segments of the map; `rows` lists those for which it holds, in a fixed
order. `MapSolver` chooses among them before the start.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import ClassVar

from osc2tx_runtime.domain.map.road_graph import RoadGraph
from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.modifiers.base import Modifier
from osc2tx_shared.classes import dataclass

__all__ = ["Known", "MapModifier", "Row", "fits"]

Known = Mapping[str, MapSegment]
Row = dict[str, MapSegment]


@dataclass(frozen=True, slots=True)
class MapModifier(Modifier):
    """Base of the modifiers of maps.

    Attributes:
        leads: Whether its rows also limit the part that is chosen first.
    """

    leads: ClassVar[bool] = False

    def parts(self) -> dict[str, RoadPart]:
        """Declared roads and lanes that it constrains, by parameter."""
        values = ((each.name, getattr(self, each.name)) for each in fields(self))
        return {name: value for name, value in values if isinstance(value, RoadPart)}

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Segments by parameter for which it holds, given the known ones."""
        raise NotImplementedError

    def candidates(self, graph: RoadGraph, known: Known, name: str) -> tuple[MapSegment, ...]:
        """Segments for a parameter: the known segment, or all of its kind."""
        if name in known:
            return (known[name],)
        return self.parts()[name].candidates(graph)


def fits(row: Row, known: Known) -> bool:
    """Whether a row agrees with the known segments."""
    return all(row[name] == segment for name, segment in known.items())

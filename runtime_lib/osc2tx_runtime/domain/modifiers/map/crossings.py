"""The map modifier about crossings (DSL 8.12.2.2.9)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar

from osc2tx_runtime.domain.map.crossing_lines import laid
from osc2tx_runtime.domain.map.crossings import Crossing
from osc2tx_runtime.domain.map.road_graph import RoadGraph
from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.modifiers.registry import modifier
from osc2tx_runtime.errors import ScenarioError
from osc2tx_shared.classes import dataclass

from .base import Known, MapModifier, Row, fits

__all__ = ["CrossingConnects", "implied"]

_SAME = 0.05  # m along a lane


@modifier("crossing_connects", needs=("map",))
@dataclass(frozen=True, slots=True)
class CrossingConnects(MapModifier):
    """A crossing leads straight from the middle of one lane to that of another.

    With `start_s_coord` it is at that position, with or without a crosswalk of the map; otherwise
    on one of the crosswalks of the map. Of lanes without other constraints, those for pedestrians
    come first.

    Attributes:
        crossing: The crossing.
        start_lane: Lane on whose centre line it begins.
        end_lane: Lane on whose centre line it ends.
        start_s_coord: Metres along the start lane.
        start_angle: Angle between the start lane and the crossing (rad), seen from that lane.
    """

    leads: ClassVar[bool] = True
    crossing: Crossing
    start_lane: RoadPart | None = None
    end_lane: RoadPart | None = None
    start_s_coord: float | None = None
    start_angle: float = 0.5 * math.pi

    def __post_init__(self) -> None:
        """Rejects crossings parallel to their lane."""
        if not 0.0 < self.start_angle < math.pi:
            raise ScenarioError(f"{self.name}: start_angle lies between 0 and 180 degrees")

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """Crossings with the lanes that they join."""
        for crossing in self._crossings(graph, known):
            start, end = crossing.parts
            row = {"crossing": crossing, "start_lane": start, "end_lane": end}
            if fits(row, known):
                yield {name: row[name] for name in self.parts()}

    def _crossings(self, graph: RoadGraph, known: Known) -> Iterator[MapSegment]:
        if self.start_s_coord is None:
            yield from graph.crossings
            return
        for start in self._lanes(graph, known, "start_lane"):
            for end in self._lanes(graph, known, "end_lane"):
                if start.road == end.road or len(known) > 1:
                    found = laid(graph, start, end, self.start_s_coord, self.start_angle)
                    if found is not None:
                        yield found

    def _lanes(self, graph: RoadGraph, known: Known, name: str) -> tuple[MapSegment, ...]:
        if name in known:
            return (known[name],)
        if "crossing" in known:
            return (known["crossing"].parts[name == "end_lane"],)
        lanes = (*graph.other_lanes, *graph.lanes)
        return tuple(sorted(lanes, key=lambda lane: graph.kind_of(lane).type != "pedestrian"))


def implied(crossing: Crossing) -> CrossingConnects | None:
    """The constraints of the members of a crossing on the lanes that it joins."""
    start, end = crossing.wanted_lanes
    if start is None and end is None and crossing.wanted_s[0] is None:
        return None
    return CrossingConnects(crossing, start, end, crossing.wanted_s[0])

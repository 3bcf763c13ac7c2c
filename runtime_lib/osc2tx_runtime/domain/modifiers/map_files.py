"""Map modifiers: what declared roads and lanes are like (DSL 8.12.2.2).

Each is a relation between stretches of the map; `rows` lists those for which it holds, in a fixed
order. `MapSolver` chooses among them before the start.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from osc2tx_runtime.domain.routes.road_graph import RoadGraph

from .map_base import Known, MapModifier, Row
from .map_crossings import CrossingConnects
from .map_lanes import CompoundLaneSide, EndLane, LaneSide, NumberOfLanes, StartLane
from .map_routes import (
    RoadsFollowInJunction,
    RoutesAreInSequence,
    RoutesAreOpposite,
    RoutesOverlap,
)

__all__ = [
    "MAP_MODIFIERS",
    "CompoundLaneSide",
    "CrossingConnects",
    "EndLane",
    "LaneSide",
    "MapModifier",
    "NumberOfLanes",
    "RoadsFollowInJunction",
    "RoutesAreInSequence",
    "RoutesAreOpposite",
    "RoutesOverlap",
    "SetMapFile",
    "SetTrafficLightsControlFile",
    "StartLane",
]


@dataclass(frozen=True, slots=True)
class SetMapFile(MapModifier):
    """The file of the map; says the same as the field `map_file`."""

    name = "set_map_file"
    file: str

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """One, about nothing: the file has been read when it is asked."""
        yield {}


@dataclass(frozen=True, slots=True)
class SetTrafficLightsControlFile(MapModifier):
    """The file with the cycles of the traffic lights; see `control_file` for its format."""

    name = "set_traffic_lights_control_file"
    file: str

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """One, about nothing."""
        yield {}


MAP_MODIFIERS: tuple[type[MapModifier], ...] = (
    SetMapFile,
    SetTrafficLightsControlFile,
    NumberOfLanes,
    RoutesAreInSequence,
    RoadsFollowInJunction,
    RoutesOverlap,
    LaneSide,
    CompoundLaneSide,
    StartLane,
    EndLane,
    RoutesAreOpposite,
    CrossingConnects,
)
"""Modifiers of maps that have an effect."""

"""Map modifiers that name files (DSL 8.12.2.2.11, 8.12.2.2.12)."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx_runtime.domain.map.road_graph import RoadGraph
from osc2tx_runtime.domain.modifiers.registry import modifier
from osc2tx_shared.classes import dataclass

from .base import Known, MapModifier, Row

__all__ = ["SetMapFile", "SetTrafficLightsControlFile"]


@modifier("set_map_file", needs=("map",))
@dataclass(frozen=True, slots=True)
class SetMapFile(MapModifier):
    """The file of the map; has the same meaning as the field `map_file`."""

    file: str

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """One empty row: the file has already been read."""
        yield {}


@modifier("set_traffic_lights_control_file", needs=("map",))
@dataclass(frozen=True, slots=True)
class SetTrafficLightsControlFile(MapModifier):
    """The file with the cycles of the traffic lights; see `control_file` for its format."""

    file: str

    def rows(self, graph: RoadGraph, known: Known) -> Iterator[Row]:
        """One empty row."""
        yield {}

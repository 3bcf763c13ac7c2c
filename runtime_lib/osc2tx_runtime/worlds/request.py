"""The request of a run to its world."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import field
from pathlib import Path
from typing import Any

from osc2tx_runtime.errors import InputError
from osc2tx_runtime.opendrive import MapError, RoadMap, read_map
from osc2tx_runtime.world.protocol import ControlMode
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class WorldRequest:
    """The request of a run to its world.

    Attributes:
        map_file: The map as the scenario names it; None if it leaves the map open.
        find_map: Returns the path of that map on this machine; InputError if it is not there.
        dt: Length of a step (s).
        seed: Of all random values.
        control: Control mode of an actor, by its id; `""` stands for all others.
        options: Values of the world's own options that were given, by `Option.field`.
        read: Reads the map; callers with many runs can cache it.
    """

    map_file: str | None
    find_map: Callable[[], Path]
    dt: float = 0.05
    seed: int = 0
    control: Mapping[str, ControlMode] = field(default_factory=dict)
    options: Mapping[str, Any] = field(default_factory=dict)
    read: Callable[[Path], RoadMap] = read_map

    def road_map(self) -> RoadMap:
        """Read the map of the scenario.

        Raises:
            InputError: It is not there, or no usable map.
        """
        path = self.find_map()
        try:
            return self.read(path)
        except (MapError, OSError) as error:
            raise InputError(f"the map cannot be read: {error}") from error

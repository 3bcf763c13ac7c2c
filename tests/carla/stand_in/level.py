"""The level: a map, with what a server places on it."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from functools import cache
from typing import Any

import carla

from osc2tx_runtime.opendrive import LanePosition, read_map_text

TRAFFIC_LIGHT = "1000001"
"""Type of a light for vehicles in the catalogue OpenDRIVE."""

SPAWN_HEIGHT = 0.6  # m


class Level:
    """A map.

    Attributes:
        name: Without folders.
        text: OpenDRIVE.
        spawn_points: Transforms as they travel: the default start places of our own map, so that
            scenarios start alike in both worlds. A real level has others.
    """

    def __init__(self, name: str, text: str) -> None:
        self.name, self.text = name, text
        self._map = carla.Map(name, text)
        self.spawn_points = [self._spawn_point(each) for each in start_places(text, name)]

    def _spawn_point(self, place: LanePosition) -> list[list[float]]:
        mark = self._map.get_waypoint_xodr(int(place.road), place.lane, place.s)
        return written(mark.transform, SPAWN_HEIGHT)

    def traffic_lights(self) -> Iterator[tuple[str, list[list[float]]]]:
        """Yield the OpenDRIVE id of each light, and where it stands."""
        places = {mark.id: mark.transform for mark in self._map.get_all_landmarks()}
        for signal in ElementTree.fromstring(self.text).iter("signal"):
            if signal.get("type") == TRAFFIC_LIGHT and signal.get("dynamic") == "yes":
                name = signal.get("id", "")
                yield name, written(places[name], 0.0)

    def ground(self, location: list[float], yaw: float) -> tuple[float, float] | None:
        """Return the height of the road (m) below a place, and its slope (degrees) along a yaw.

        None where the map has no lane.
        """
        mark = self._map.get_waypoint(carla.Location(*location), lane_type=carla.LaneType.Any)
        if mark is None:
            return None
        turn = mark.transform.rotation
        slope = math.tan(math.radians(turn.pitch)) * math.cos(math.radians(yaw - turn.yaw))
        return float(mark.transform.location.z), math.degrees(math.atan(slope))


@cache
def start_places(text: str, name: str) -> tuple[LanePosition, ...]:
    """Return the default start places of a map whose roads have numbers."""
    places = read_map_text(text, name).spawn_points()
    return tuple(place for place in places if place.road.isdigit())


def written(transform: Any, up: float) -> list[list[float]]:
    """Return a transform as it travels, so many metres higher."""
    at, turn = transform.location, transform.rotation
    return [[at.x, at.y, at.z + up], [turn.pitch, turn.yaw, turn.roll]]

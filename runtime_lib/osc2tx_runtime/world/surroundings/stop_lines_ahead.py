"""Search for stop lines ahead whose lights require a stop."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

from osc2tx_runtime.enums import SemanticTrafficLightState
from osc2tx_runtime.opendrive import LanePosition, RoadMap, Route, SignalPlace, signal_places
from osc2tx_runtime.opendrive.lane_line import lane_line

from .traffic_light_states import LaneLines, Signals

STOP: frozenset[SemanticTrafficLightState] = frozenset({"stop", "attention"})
"""States that forbid passing."""

STOP_IF_POSSIBLE: frozenset[SemanticTrafficLightState] = frozenset({"stop_attention"})
"""States that require a stop of vehicles that can still stop comfortably."""

_STEP_OVER = 1e-6  # m beyond the end of a lane, on the next one
_AT = 1e-5  # m: a line within this distance behind is at the position


class StopLine(NamedTuple):
    """A stop line whose light requires a stop.

    Attributes:
        signal: The light.
        distance: Metres along the lane from the reference point.
        strict: False for a light that requires a stop only if it is comfortable.
    """

    signal: str
    distance: float
    strict: bool


class StopLines:
    """The stop lines of a map: at the positions of signals and signal references in OpenDRIVE.

    Args:
        road_map: The map.
        signals: The states of the lights.
    """

    def __init__(self, road_map: RoadMap, signals: Signals) -> None:
        self._map = road_map
        self._signals = signals
        lights = [each for each in road_map.signals() if each.dynamic]
        self._of_map = signal_places(road_map.roads, lights)

    def ahead(
        self, place: LanePosition, route: Route | None, nearest: float, reach: float
    ) -> StopLine | None:
        """The first line ahead whose light requires a stop; None without one.

        Args:
            place: Start of the search.
            route: Decides at forks, as for the motion.
            nearest: Lines nearer than this (m) are already passed.
            reach: Length of the search (m).
        """
        asking = {each: s for each in self._signals.lit() if (s := self._strict(each)) is not None}
        if not asking:
            return None
        for found, distance in self._along(place, route, reach):
            if found.signal in asking and nearest < distance <= reach:
                return StopLine(found.signal, distance, asking[found.signal])
        return None

    def _strict(self, signal: str) -> bool | None:
        """Whether a light forbids passing in any case; None if it has no effect on vehicles."""
        if all(lamp.for_pedestrians for lamp in self._signals.lamps(signal)):
            return None
        meaning = self._signals.meaning(signal)
        return True if meaning in STOP else False if meaning in STOP_IF_POSSIBLE else None

    @cached_property
    def _places(self) -> LaneLines:
        """Positions of the lights, read only after the cast is on the map."""
        return self._signals.lines(self._of_map)

    def _along(
        self, place: LanePosition, route: Route | None, reach: float
    ) -> Iterator[tuple[SignalPlace, float]]:
        """Positions of signals on the route, by distance (m)."""
        road_map, covered = self._map, 0.0
        while covered <= reach:
            section = road_map.roads[place.road].section_at(place.s)
            with_s = road_map.travel_direction(place.road, place.lane) > 0
            here = self._places.get((place.road, place.lane), ())
            for found in here if with_s else reversed(here):
                ahead = (found.s - place.s) * (1 if with_s else -1) >= -_AT
                if ahead and section.begin <= found.s <= section.end:
                    yield found, covered + self._length(place, found.s)
            left = self._length(place, section.end if with_s else section.begin) + _STEP_OVER
            step = road_map.advance(LanePosition(*place[:3]), left, route)
            covered += left
            if step.travelled < left - 0.5 * _STEP_OVER:
                return  # a dead end
            place = step.position

    def _length(self, place: LanePosition, s: float) -> float:
        """Arc length (m) along the centre of the lane to another s of the same section."""
        line = lane_line(self._map.roads[place.road].section_at(place.s).lanes[place.lane])
        return abs(line.length_at(s) - line.length_at(place.s))

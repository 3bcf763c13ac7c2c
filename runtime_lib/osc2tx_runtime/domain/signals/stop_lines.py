"""Declared stop lines of traffic lights (DSL 8.15.5.2)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from osc2tx_runtime.domain.map.road_graph import RoadGraph, graph_of
from osc2tx_runtime.domain.map.roads_and_lanes import LaneSection, Route
from osc2tx_runtime.domain.map.route_axes import axis_lanes
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.signals.traffic_lights import TrafficLightGroup
from osc2tx_runtime.enums import StopLineMarking
from osc2tx_runtime.errors import PlacementError, ScenarioError, UnsupportedError
from osc2tx_runtime.opendrive import RoadMap, signal_places
from osc2tx_runtime.world.surroundings.traffic_light_states import Signals

ValueT = TypeVar("ValueT")


class TrafficLightStopLine(Route):
    """The stop line of a group of lights: from the map, or declared by the scenario.

    Open members are those of the map for the first light of the group. A line that the scenario
    moves, by `offset` or to other lanes, applies to all lights of the group instead of those of the
    map. Vehicles do not stop at the secondary line.

    Args:
        traffic_light_group: The group.
        route: The lane section of the line.
        rightmost_lane: First lane of the line, counted from the right, from 1.
        leftmost_lane: Last lane of the line.
        offset: Its position on the route (m).
        secondary_stop_offset: Position of a second line (m); default: none.
        primary_stop_line_marking: Its marking.
        secondary_stop_line_marking: Marking of the second line.
    """

    word = "traffic_light_stop_line"

    def __init__(
        self,
        *,
        traffic_light_group: TrafficLightGroup,
        route: LaneSection | None = None,
        rightmost_lane: int | None = None,
        leftmost_lane: int | None = None,
        offset: float | None = None,
        secondary_stop_offset: float | None = None,
        primary_stop_line_marking: StopLineMarking | None = None,
        secondary_stop_line_marking: StopLineMarking | None = None,
    ) -> None:
        super().__init__()
        self.traffic_light_group = traffic_light_group
        self._route = route
        self._lanes = rightmost_lane, leftmost_lane
        self._offset, self._second = offset, secondary_stop_offset
        self._marking = primary_stop_line_marking
        self._second_marking = secondary_stop_line_marking
        self._at: float | None = None

    # --- position -----------------------------------------------------------------------------

    def settle(self, road_map: RoadMap, signals: Signals) -> None:
        """Finds the line on the map, and moves it to the stated position.

        Raises:
            PlacementError: The map has no line for the group, or none on these lanes.
        """
        graph, lights = graph_of(road_map), self.traffic_light_group.lights(signals)
        here, numbers, offset = self._section(graph, lights)
        self.choose(here)
        first, last = self._lanes
        self._at = offset if self._offset is None else self._offset
        self._lanes = first or min(numbers), last or max(numbers)
        if self._offset is None and first is None and last is None:
            return
        lanes = graph.lanes_of(here)
        if not 1 <= self.rightmost_lane <= self.leftmost_lane <= len(lanes):
            raise PlacementError(
                f"lanes {self.rightmost_lane} to {self.leftmost_lane} of {here} cannot have a stop"
                f" line: it has {len(lanes)}",
                self.source,
            )
        s = graph.s_at(axis_lanes(graph, here)[0], self._at)
        if s is None:
            raise PlacementError(f"{here} has no place at s = {self._at:g} m", self.source)
        held = lanes[self.rightmost_lane - 1 : self.leftmost_lane]
        for light in lights:
            signals.stop_at(light, [(lane.road, lane.lane or 0, s) for lane in held])

    def _section(
        self, graph: RoadGraph, lights: Sequence[str]
    ) -> tuple[MapSegment, Sequence[int], float]:
        """Lane section of the line, its lanes counted from the right, and its position."""
        if self._route is not None and self._route.found.kind != "lane_section":
            raise UnsupportedError("a stop line lies on a lane_section here", self.source)
        for signal in (each for each in graph.map.signals() if each.id in lights):
            held = signal_places(graph.map.roads, [signal])
            for (road, lane), places in held.items():
                s = places[0].s
                index = graph.map.roads[road].section_at(s).index
                forwards = graph.map.travel_direction(road, lane) > 0
                found = MapSegment("lane_section", road, index, forwards=forwards)
                if self._route is None or self._route.found == found:
                    numbers = [
                        number
                        for number, each in enumerate(graph.lanes_of(found), 1)
                        if (each.road, each.lane) in held
                    ]
                    return found, numbers, graph.along(axis_lanes(graph, found)[0], s)
        if self._route is None or self._offset is None:
            raise PlacementError(
                f"{self.traffic_light_group.name} holds for no lane there, so the map has no stop"
                " line for it: give its route and its offset",
                self.source,
            )
        lanes = graph.lanes_of(self._route.found)
        return self._route.found, range(1, len(lanes) + 1), self._offset

    # --- read from the map --------------------------------------------------------------------

    @property
    def route(self) -> LaneSection:
        """The lane section of the line."""
        return self._as(LaneSection(), self.found)

    @property
    def rightmost_lane(self) -> int:
        """First lane of the line, counted from the right."""
        return self._known("rightmost_lane", self._lanes[0])

    @property
    def leftmost_lane(self) -> int:
        """Last lane of the line."""
        return self._known("leftmost_lane", self._lanes[1])

    @property
    def offset(self) -> float:
        """Its position on its route (m)."""
        return self._known("offset", self._at)

    @property
    def secondary_stop_offset(self) -> float:
        """Position of the second line (m); default: that of the first."""
        return self.offset if self._second is None else self._second

    @property
    def primary_stop_line_marking(self) -> StopLineMarking:
        """Its marking.

        Raises:
            ScenarioError: The scenario does not state it; maps have none.
        """
        return self._known("primary_stop_line_marking", self._marking)

    @property
    def secondary_stop_line_marking(self) -> StopLineMarking:
        """Marking of the second line; default: that of the first."""
        return self._second_marking or self.primary_stop_line_marking

    def _known(self, member: str, value: ValueT | None) -> ValueT:
        if value is None:
            raise ScenarioError(f"the {member} of the stop line is not stated", self.source)
        return value

"""Start places of actors that do not depend on others: given by the settings, or by default."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.modifiers import Lane, Position, value_of
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap
from osc2tx_runtime.poses import road_entry
from osc2tx_runtime.world.lanes import lane_with_number, number_of_lane

if TYPE_CHECKING:
    from osc2tx_runtime.actors import PhysicalObject

__all__ = ["StartPlaces"]


class StartPlaces:
    """Start places on a map."""

    def __init__(self, road_map: RoadMap) -> None:
        self._map = road_map

    def given(
        self,
        actor: PhysicalObject,
        spawn: LanePosition,
        lane: Lane | None,
        position: Position | None,
    ) -> LanePosition:
        """The place of `--spawn`, checked against the scenario."""
        if position is not None or (lane is not None and lane.reference is not None):
            raise PlacementError(
                f"{actor.id}: the scenario says where it starts, so it takes no --spawn"
            )
        try:
            self._map.pose(spawn)
        except MapError as error:
            raise PlacementError(f"--spawn {actor.id}: {error.message}") from error
        length = self._map.roads[spawn.road].length
        if not 0.0 <= spawn.s <= length:
            raise PlacementError(
                f"--spawn {actor.id}: road {spawn.road} is {length:.1f} m long, so there is no"
                f" s = {spawn.s:g} m"
            )
        if lane is not None:
            number = number_of_lane(self._map, spawn, lane.from_)
            if number != lane.number:
                raise PlacementError(
                    f"--spawn {actor.id}: lane {spawn.lane} of road {spawn.road} is number"
                    f" {number} from the {lane.from_}, the scenario asks for {lane.number}"
                    if number
                    else f"--spawn {actor.id}: lane {spawn.lane} of road {spawn.road} is no"
                    " driving lane"
                )
        return spawn

    def default(
        self,
        actor: PhysicalObject,
        lane: Lane | None,
        position: Position | None,
        is_free: Callable[[LanePosition], bool],
    ) -> LanePosition:
        """The first free default place that agrees with the modifiers."""
        distance = None if position is None else value_of(position.distance or 0.0)
        for candidate in self._candidates(distance):
            place: LanePosition | None = candidate
            if lane is not None:
                place = lane_with_number(self._map, candidate, lane.number, lane.from_)
                if distance is None and place is not None and place.lane != candidate.lane:
                    continue
            if place is not None and is_free(place):
                return place
        wish = "" if lane is None else f" with a lane {lane.number} from the {lane.from_}"
        far = "" if distance is None else f", {distance:g} m from its start"
        raise PlacementError(
            f"{actor.id}: map {self._map.name} has no free place on a road{wish}{far}"
        )

    def _candidates(self, distance: float | None) -> Iterator[LanePosition]:
        """Default start places; with a distance, places so far from the start of each road."""
        if distance is None:
            yield from self._map.spawn_points()
            return
        starts: dict[tuple[str, int], None] = {}
        for point in self._map.spawn_points():
            direction = self._map.travel_direction(point.road, point.lane)
            if (point.road, direction) in starts:
                continue
            starts[point.road, direction] = None
            step = self._map.advance(road_entry(self._map, point), distance)
            if abs(step.travelled - distance) < 1e-6:
                yield step.position

"""Start places without a reference: from the settings, or by default."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Lane, Position
from osc2tx_runtime.domain.routes.lane_coordinates import road_entry
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap
from osc2tx_runtime.world.lane_neighbours import lane_with_number, number_of_lane

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import PhysicalObject
    from osc2tx_runtime.domain.routes.roads_and_lanes import RoadPath

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
        distance: float | None,
        is_free: Callable[[LanePosition], bool],
    ) -> LanePosition:
        """The first free default place on the lane, so far (m) along its road."""
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

    def on_path(
        self,
        actor: PhysicalObject,
        path: RoadPath,
        lane: Lane | None,
        distance: float | None,
        is_free: Callable[[LanePosition], bool],
    ) -> LanePosition:
        """The first free default place on a piece of road; see `default`.

        Without a distance it is from a third of it on, so that there is room for those who start
        behind; if all of that is taken, before.
        """
        stretch = path.found
        section = self._map.roads[stretch.road].sections[stretch.section or 0]
        third = (section.end - section.begin) / 3.0

        def is_on(place: LanePosition, least: float) -> bool:
            forwards = self._map.travel_direction(place.road, place.lane) > 0
            if (place.road, forwards) != (stretch.road, stretch.forwards):
                return False
            covered = place.s - section.begin if forwards else section.end - place.s
            return least <= covered <= section.end - section.begin and is_free(place)

        if distance is None:
            try:
                return self.default(actor, lane, None, lambda place: is_on(place, third))
            except PlacementError:
                pass  # the rest of it is tried below
        try:
            return self.default(actor, lane, distance, lambda place: is_on(place, 0.0))
        except PlacementError as error:
            raise PlacementError(f"{error.message} that is part of its path, {stretch}") from None

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

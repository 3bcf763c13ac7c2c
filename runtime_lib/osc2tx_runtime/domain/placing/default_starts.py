"""Start positions without a reference: from the settings, or by default."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache, partial
from typing import TypeAlias

from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.modifiers import Lane, Position
from osc2tx_runtime.domain.routes.lane_coordinates import place_along_road
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap
from osc2tx_runtime.world.geometry.lane_neighbours import lane_with_number, number_of_lane

_AHEAD = 100.0  # m of road ahead that a start should have
_MOST_KEPT = 1 << 15  # positions of which it is known

TakenBy: TypeAlias = Callable[[LanePosition], str | None]
"""Returns the actor that blocks a position, and the overlap; None if it is free."""


class StartPlaces:
    """Start positions on a map."""

    def __init__(self, road_map: RoadMap) -> None:
        self._map = road_map
        # Making room for an actor asks for the same positions many times.
        self._leads_on = lru_cache(maxsize=_MOST_KEPT)(self._has_road_ahead)

    def given(
        self,
        actor: str,
        spawn: LanePosition,
        lane: Lane | None,
        position: Position | None,
    ) -> LanePosition:
        """The position of `--spawn`, checked against the scenario."""
        if position is not None or (lane is not None and lane.reference is not None):
            raise PlacementError(
                f"{actor}: the scenario states where it starts, so --spawn does not apply"
            )
        try:
            self._map.pose(spawn)
        except MapError as error:
            raise PlacementError(f"--spawn {actor}: {error.message}") from error
        length = self._map.roads[spawn.road].length
        if not 0.0 <= spawn.s <= length:
            raise PlacementError(
                f"--spawn {actor}: road {spawn.road} is {length:.1f} m long, so there is no"
                f" s = {spawn.s:g} m"
            )
        if lane is not None:
            number = number_of_lane(self._map, spawn, lane.edge)
            if number != lane.number:
                raise PlacementError(
                    f"--spawn {actor}: lane {spawn.lane} of road {spawn.road} is number"
                    f" {number} from the {lane.edge}, the scenario requires {lane.number}"
                    if number
                    else f"--spawn {actor}: lane {spawn.lane} of road {spawn.road} is no"
                    " driving lane"
                )
        return spawn

    def default(
        self,
        actor: str,
        lane: Lane | None,
        distance: float | None,
        taken_by: TakenBy,
        belongs: Callable[[LanePosition], bool] = lambda _place: True,
    ) -> LanePosition:
        """The first free default position on the lane.

        With a distance, the position there on its road. A distance fixes the position: if another
        actor is there, no other road is tried.

        Args:
            actor: The actor to place.
            lane: The lane; None: open.
            distance: Metres from the start of the road; None: open.
            taken_by: Returns the actor that an actor there would overlap.
            belongs: Whether a position satisfies the constraints.

        Raises:
            PlacementError: The position does not exist.
        """
        for candidate in self._candidates(lane, distance):
            place: LanePosition | None = candidate
            if lane is not None:
                place = lane_with_number(self._map, candidate, lane.number, lane.edge)
                if distance is None and place is not None and place.lane != candidate.lane:
                    continue
            if place is None or not belongs(place):
                continue
            if (other := taken_by(place)) is None:
                return place
            if distance is not None:
                return self._beside(actor, lane, place, taken_by, f"{other} {distance:g} m")
        wanted = "" if lane is None else f" with a lane {lane.number} from the {lane.edge}"
        far = "" if distance is None else f", {distance:g} m from its start"
        raise PlacementError(
            f"{actor}: map {self._map.name} has no free position on a road{wanted}{far}"
        )

    def _beside(
        self,
        actor: str,
        lane: Lane | None,
        place: LanePosition,
        taken_by: TakenBy,
        where: str,
    ) -> LanePosition:
        """Another lane of the same carriageway, if the scenario leaves the lane open."""
        lanes = self._map.lanes(place.road, place.s, like=place.lane) if lane is None else ()
        for other in lanes:
            found = LanePosition(place.road, other, place.s)
            if taken_by(found) is None:
                return found
        raise PlacementError(
            f"{actor} overlaps {where} from the start of road {place.road}, in lane {place.lane};"
            " state another position for one of them"
        )

    def on_path(
        self,
        actor: str,
        segment: MapSegment,
        lane: Lane | None,
        distance: float | None,
        taken_by: TakenBy,
    ) -> LanePosition:
        """The first free default position on a piece of road; see `default`.

        Without a distance the search starts at a third of its length, to leave room behind for
        other actors; the first third follows last.
        """
        section = self._map.roads[segment.road].sections[segment.section or 0]
        third = (section.end - section.begin) / 3.0

        def is_on(least: float, place: LanePosition) -> bool:
            forwards = self._map.travel_direction(place.road, place.lane) > 0
            if (place.road, forwards) != (segment.road, segment.forwards):
                return False
            covered = place.s - section.begin if forwards else section.end - place.s
            return least <= covered <= section.end - section.begin

        if distance is None:
            try:
                return self.default(actor, lane, None, taken_by, partial(is_on, third))
            except PlacementError:
                pass  # the rest is tried below
        try:
            return self.default(actor, lane, distance, taken_by, partial(is_on, 0.0))
        except PlacementError as error:
            raise PlacementError(f"{error.message} that is part of its path, {segment}") from None

    def _candidates(self, lane: Lane | None, distance: float | None) -> Iterator[LanePosition]:
        """Default start positions, those shortly before a dead end last."""
        dead_ends = []
        for place in self._places(lane, distance):
            if self._leads_on(place):
                yield place
            else:
                dead_ends.append(place)
        yield from dead_ends

    def _has_road_ahead(self, place: LanePosition) -> bool:
        return self._map.advance(place, _AHEAD).travelled >= _AHEAD

    def _places(self, lane: Lane | None, distance: float | None) -> Iterator[LanePosition]:
        """Default start positions; with a distance, positions there on each road.

        If a road is too short, its other carriageway is also omitted.
        """
        if distance is None:
            yield from self._map.spawn_points()
            return
        starts: set[tuple[str, int]] = set()
        short: set[str] = set()
        for point in self._map.spawn_points():
            direction = self._map.travel_direction(point.road, point.lane)
            if (point.road, direction) in starts or point.road in short:
                continue
            starts.add((point.road, direction))
            place = place_along_road(self._map, point, distance)
            if place is not None:
                yield place
            elif lane is None or lane_with_number(self._map, point, lane.number, lane.edge):
                short.add(point.road)

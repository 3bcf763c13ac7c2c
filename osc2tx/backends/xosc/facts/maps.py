"""Maps, looked for and read by the runtime.

A lane of oncoming traffic is a place beside the innermost lane of the own direction.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, cached_property, lru_cache
from pathlib import Path
from typing import cast

from osc2tx.backends.xosc.facts import refusing
from osc2tx.backends.xosc.facts.curves import Waypoint
from osc2tx.losses.entries import Inexpressible
from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.domain.modifiers import Lane
from osc2tx_runtime.domain.placing.default_starts import StartPlaces
from osc2tx_runtime.domain.routes.lane_coordinates import place_along_road
from osc2tx_runtime.domain.routes.road_paths import way_through
from osc2tx_runtime.enums import BulbState, SemanticTrafficLightState
from osc2tx_runtime.errors import InputError, ScenarioError
from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap, read_map
from osc2tx_runtime.opendrive.geodesy import GeoReferenceError
from osc2tx_runtime.opendrive.model import LaneKey
from osc2tx_runtime.world.geometry.lane_neighbours import (
    actual_lane,
    are_opposed,
    lane_with_number,
    lanes_to_left,
    offset_from,
)
from osc2tx_runtime.world.geometry.lane_neighbours import lane_beside as lane_either_way
from osc2tx_runtime.world.longitudinal.bends_ahead import BendsAhead
from osc2tx_runtime.world.surroundings.traffic_light_lamps import Lamp, lamps_that_mean, meaning_of
from osc2tx_runtime.world.surroundings.traffic_light_states import Signals
from osc2tx_shared.map_files import DEFAULT_MAP, places_in_project


class Roads:
    """A map that can be asked."""

    def __init__(self, road_map: RoadMap, file: Path) -> None:
        """Take the map and where it comes from."""
        self.map = road_map
        self.file = file
        self._signals = Signals(road_map)
        self.starts = StartPlaces(road_map)

    @cached_property
    def sharpest_bend(self) -> float:
        """The largest curvature (1/m) of a driving lane."""
        return BendsAhead(self.map).sharpest()

    def beside(self, place: LanePosition, lanes: int) -> LanePosition | None:
        """Return the lane of its direction that many lanes to the left of a place."""
        if lanes == 0:
            return place
        return self.map.neighbour(place, "left" if lanes > 0 else "right", abs(lanes))

    def may_be_beside(self, place: LanePosition, lanes: int) -> LanePosition | None:
        """Return where, from a lane on, the lanes ahead first have one so many to their left."""
        ahead = [self.map.lane_key(place)]
        for key in ahead:
            section = self.map.roads[key.road].sections[key.section]
            middle = LanePosition(key.road, key.lane, (section.begin + section.end) / 2)
            if self.beside(middle, lanes) is not None:
                return middle
            ahead += [each for each in self.map.successors(key) if each not in ahead]
        return None

    def with_number(self, place: LanePosition, lane: Lane) -> LanePosition | None:
        """Return the lane with a number at a place; `None` if there is none."""
        return lane_with_number(self.map, place, lane.number, lane.edge)

    def lanes_between(self, place: LanePosition, other: LanePosition) -> int | None:
        """Return how many lanes to the left another lane of the same road is; `None`: it is not."""
        if place.road != other.road:
            return None
        try:
            return lanes_to_left(self.map, place, other)
        except ScenarioError:
            return None

    def ahead(self, place: LanePosition, distance: float) -> LanePosition | None:
        """Return the place so far (m) along the lane."""
        step = self.map.advance(place, distance)
        return step.position if abs(step.travelled - distance) < 1e-6 else None

    def place(self, road: str, lane: int, s: float, t: float) -> LanePosition:
        """Return a place from its coordinates on a road given by its name."""
        with refusing(about=f"map {self.map.name}: "):
            place = LanePosition(road, lane, s, t * self.map.travel_direction(road, lane))
            self.map.pose(place)
        return place

    def direction_at(self, x: float, y: float, z: float) -> float:
        """Return the heading (rad) of the nearest road."""
        place = self.map.locate(x, y, z)
        return 0.0 if place is None else self.map.pose(place).h

    def on_earth(self, latitude: float, longitude: float, altitude: float) -> Pose | None:
        """Return where a place on the globe (rad, m) is; `None` if the map does not say."""
        try:
            x, y = self.map.geo_reference.project(latitude, longitude)
        except GeoReferenceError:
            return None
        road = self.map.locate(x, y)
        if road is None:
            return Pose(x, y, altitude, 0.0)
        near = self.map.pose(road)
        return Pose(x, y, near.z + altitude, near.h)

    def leftwards(self, lane: LanePosition | None) -> int | None:
        """Return the sign, along t, of what is to the left of travel in a lane.

        If the lane is unknown, it is that of all lanes, if they agree.
        """
        if lane is not None:
            return self.map.travel_direction(lane.road, lane.lane)
        return next(iter(self._directions)) if len(self._directions) == 1 else None

    @cached_property
    def _directions(self) -> frozenset[int]:
        """The directions of travel of all driving lanes: 1 along s, -1 against it."""
        return frozenset(
            lane.direction
            for road in self.map.roads.values()
            for section in road.sections
            for lane in section.lanes.values()
        )

    def signal_position(self, signal: str) -> tuple[float, float]:
        """Return where a traffic light stands (m)."""
        light = next((each for each in self.map.signals() if each.id == signal), None)
        if light is None:
            raise Inexpressible(f"map {self.map.name} has no traffic light {signal}")
        pose = self.map.road_pose(light.road, light.s, light.t)
        return pose.x, pose.y

    @refusing()
    def lamps(self, signal: str) -> tuple[Lamp, ...]:
        """Return the lamps of a traffic light.

        Raises:
            Inexpressible: There is no such light, or its lamps are not known.
        """
        return self._signals.lamps(signal)

    @refusing()
    def group(self, group: str) -> tuple[str, ...]:
        """Return the traffic lights of a group."""
        return self._signals.members(group)

    def group_of(self, signal: str) -> tuple[str, ...]:
        """Return the lights of the group that a traffic light belongs to."""
        group = self._signals.group_of(signal)
        return (signal,) if group is None else self.group(group)

    def meaning(self, signal: str, meaning: str) -> tuple[str, ...] | None:
        """Return the states of lamps that mean something; `None` if a light cannot say it."""
        return lamps_that_mean(self.lamps(signal), cast("SemanticTrafficLightState", meaning))

    def meaning_of(self, signal: str, states: Sequence[str]) -> str:
        """Return what a light means that shows something; `non_functional` if nothing."""
        return meaning_of(self.lamps(signal), cast("Sequence[BulbState]", states))

    def locate(self, x: float, y: float, z: float) -> LanePosition | None:
        """Return the driving lane that contains a point; `None` if there is none."""
        return self.map.locate(x, y, z, max_distance=1e-3)

    @refusing()
    def along(self, places: Sequence[LanePosition]) -> tuple[Waypoint, ...]:
        """Return the way along lanes through places."""
        found = way_through(self.map, places)
        return tuple(Waypoint(0.0, pose.x, pose.y, pose.z, pose.yaw) for pose in found)


@refusing()
def lane_from_edge(number: int, edge: str) -> Lane:
    """Return the lane that is counted from an edge of the road.

    Raises:
        Inexpressible: There is no lane with such a number.
    """
    return Lane(number, from_="right" if edge == "right" else "left")


# --- lanes of oncoming traffic --------------------------------------------------------------------


def is_oncoming(road_map: RoadMap, place: LanePosition) -> bool:
    """Whether a place is by its offset in a lane of oncoming traffic."""
    return actual_lane(road_map, place).lane != place.lane


# --- folders with maps ----------------------------------------------------------------------------

MOST_MAPS = 32
"""Maps that are kept once read."""


class MapFolders:
    """Folders with maps. A map is looked for once for all documents of a scenario.

    Args:
        folders: The folders, or a map itself.
    """

    def __init__(self, folders: Sequence[Path]) -> None:
        self._folders = tuple(folders)
        self.roads = cache(self._roads)
        self.places = cache(self._places)

    def _roads(self, map_file: str | None) -> Roads | None:
        """Return a map, looked for as `osc2tx run` does; `None` if it is not found."""
        wanted = Path(map_file or DEFAULT_MAP)
        if wanted.is_absolute() or ".." in wanted.parts:
            return None  # nothing outside of the folders is read
        try:
            path = find_map(map_file, [folder for folder in self._folders if folder.exists()])
        except InputError:
            return None
        now = path.stat()  # between two builds of one process it may change
        return _read(path, now.st_mtime_ns, now.st_size)

    def _places(self, map_file: str | None) -> tuple[Path, ...]:
        """Return where a map is looked for, outside of the runtime library."""
        return places_in_project(map_file, self._folders)


@lru_cache(maxsize=MOST_MAPS)
def _read(path: Path, modified: int, size: int) -> Roads:
    with refusing(about=f"map {path.name} cannot be read: "):
        return Roads(read_map(path), path)

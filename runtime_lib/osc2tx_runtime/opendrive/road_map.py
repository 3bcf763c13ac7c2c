"""The road map: the public class with all queries."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

from osc2tx_runtime.enums import SideLeftRight

from .crosswalks import Crosswalk
from .lane_advance import Forks, advance
from .lane_cursor import LaneCursor
from .lane_distances import LaneGroups, Route, passable
from .lane_line import lane_line
from .lane_table import LaneTable
from .map_snapshots import read_content_once
from .model import (
    DRIVING,
    Advance,
    Junction,
    Lane,
    LaneKey,
    LaneOutline,
    LanePosition,
    Pose,
    Road,
)
from .network import connect_lanes, linked_ends
from .outlines import lane_outlines, spawn_points
from .poses import lane_pose, surface_pose
from .projection import Projection, best_place, lane_at, place_score, position_of, project
from .reader import MapContent, read_content_text
from .road_index import RoadIndex
from .seams import Seam, seams
from .signals import Controller, Signal

_THIN = 0.05  # m: narrower lanes do not exist at that position


class RoadMap:
    """A road network with its queries. Immutable; caches fill on use.

    Attributes:
        name: Name of the map: file name without suffix.
        roads: Roads by id, in numeric order.
        junctions: Junctions by id, in numeric order.
        geo_reference: Its position on the globe.
        header: Attributes of the header of the file.
        remarks: Errors of the file that do not prevent its use, and unread elements that matter.
    """

    def __init__(self, content: MapContent) -> None:
        self.name = content.name
        self._roads = content.roads
        self.roads: Mapping[str, Road] = MappingProxyType(content.roads)
        self.junctions: Mapping[str, Junction] = MappingProxyType(content.junctions)
        self._signals = content.signals
        self._controllers = content.controllers
        self._crosswalks = content.crosswalks
        self.geo_reference = content.geo_reference
        self.header = content.header
        self.remarks = content.remarks
        self._forks = Forks()
        table = LaneTable(content.roads, content.file)
        self._road, self._lane, self._keyed = table.road, table.at, table.keyed
        connect_lanes(content.roads, content.junctions)

    # --- positions ----------------------------------------------------------------------------

    def pose(self, p: LanePosition) -> Pose:
        """Pose on a lane, heading in direction of travel including the slope of the lane."""
        lane, s = self._lane(p.road, p.lane, p.s)
        return lane_pose(lane, s, p.offset)

    def road_pose(self, road: str, s: float, t: float) -> Pose:
        """Pose in the frame of the reference line at (s, t)."""
        found = self._road(road)
        return surface_pose(found, min(max(s, 0.0), found.length), t, 0.0, 1, tangent=True)

    def locate(
        self,
        x: float,
        y: float,
        z: float | None = None,
        heading: float | None = None,
        hint: LanePosition | None = None,
        lane_types: frozenset[str] = DRIVING,
        max_distance: float = 50.0,
    ) -> LanePosition | None:
        """Lane that contains a point, else the nearest one within `max_distance`.

        Where lanes overlap (junctions, bridges) the point alone is ambiguous: `z` (m), `heading`
        (rad, direction of travel) and `hint` (the last known position, which is then tracked along
        its road and the roads linked to it) decide.
        """
        if hint is not None:
            found = self._track(x, y, hint, lane_types, z, heading)
            if found is not None:
                return position_of(*found)
        best = best_place(self._index, (x, y), lane_types, max_distance, z, heading)
        return None if best is None else position_of(*best)

    def _track(
        self,
        x: float,
        y: float,
        hint: LanePosition,
        types: frozenset[str] | None,
        z: float | None = None,
        heading: float | None = None,
    ) -> tuple[Projection, Lane] | None:
        """Searches the road of the hint, then the roads linked to its ends."""
        lane, s = self._lane(hint.road, hint.lane, hint.s)
        foot = project(lane.road, x, y, s)
        if foot.beyond < 1e-6:
            hit = lane_at(foot.road, foot.s, foot.t, types)
            return (foot, hit[1]) if hit is not None and hit[0] == 0.0 else None
        found: list[tuple[Projection, Lane]] = []
        for road, near in linked_ends(lane, foot.s > 0.0):
            onward = project(road, x, y, near)
            hit = lane_at(road, onward.s, onward.t, types)
            if onward.beyond < 1e-6 and hit is not None and hit[0] == 0.0:
                found.append((onward, hit[1]))
        if not found:
            return None
        return min(found, key=lambda place: place_score(place[0], place[1], 0.0, z, heading))

    # --- lanes --------------------------------------------------------------------------------

    def lane_type(self, road: str, lane: int, s: float) -> str:
        """Type of a lane as written in the file, e.g. "driving"."""
        return self._lane(road, lane, s)[0].type

    def lane_width(self, road: str, lane: int, s: float) -> float:
        """Width of a lane (m)."""
        found, s = self._lane(road, lane, s)
        return found.width_at(s)

    def travel_direction(self, road: str, lane: int) -> int:
        """+1 if traffic on the lane runs with s, -1 against."""
        return self._road(road).direction_of(lane)

    def lanes(
        self,
        road: str,
        s: float,
        *,
        like: int | None = None,
    ) -> tuple[int, ...]:
        """Drivable lanes of one direction, from the right edge to the left in direction of travel.

        Lanes without width at `s` do not count.

        Args:
            road: Road id.
            s: Road coordinate (m).
            like: A lane of the required direction; default: the direction of s.
        """
        found = self._road(road)
        s = min(max(s, 0.0), found.length)
        section = found.section_at(s)
        direction = 1 if like is None else found.direction_of(like)
        ids = sorted(
            lane.id
            for lane in section.lanes.values()
            if lane.direction == direction and lane.type in DRIVING and lane.width_at(s) >= _THIN
        )
        return tuple(ids if direction > 0 else reversed(ids))

    def neighbour(
        self,
        p: LanePosition,
        side: SideLeftRight,
        count: int = 1,
        *,
        either_way: bool = False,
    ) -> LanePosition | None:
        """Position `count` drivable lanes beside `p`; None if absent.

        Shoulders, medians and similar lanes end the search, lanes without width do not.

        Args:
            p: The position.
            side: Side in direction of travel of its lane.
            count: Number of lanes.
            either_way: Whether lanes of oncoming traffic count as well.
        """
        lane, s = self._lane(p.road, p.lane, p.s)
        step = lane.direction if side == "left" else -lane.direction
        beside, left = lane.id, count
        while left > 0:
            beside += step if beside + step else 2 * step  # lane 0 has no width
            found = lane.section.lanes.get(beside)
            if found is None or not (either_way or found.direction == lane.direction):
                return None
            if found.type in DRIVING and found.width_at(s) >= _THIN:
                left -= 1
            elif found.type not in DRIVING and not passable(found, s):
                return None
        return LanePosition(p.road, beside, p.s)

    def lane_key(self, p: LanePosition) -> LaneKey:
        """The lane of a position."""
        return self._lane(p.road, p.lane, p.s)[0].key

    def lane_length(self, key: LaneKey) -> float:
        """Arc length of the centre line on the xy plane (m)."""
        return lane_line(self._keyed(key)).length

    def successors(self, key: LaneKey) -> tuple[LaneKey, ...]:
        """Lanes that follow in direction of travel, sorted."""
        return tuple(lane.key for lane in self._keyed(key).successors)

    def predecessors(self, key: LaneKey) -> tuple[LaneKey, ...]:
        """Lanes that lead here in direction of travel, sorted."""
        return tuple(lane.key for lane in self._keyed(key).predecessors)

    # --- motion and distances -----------------------------------------------------------------

    def advance(self, p: LanePosition, distance: float, route: Route | None = None) -> Advance:
        """Moves along the lane by an arc length (m) at the offset of `p`; negative: backwards.

        At a fork the branch with the least remaining distance on `route` is taken, else that with
        the smallest turn. At a dead end the motion stops; `travelled` is the distance moved.
        """
        lane, s = self._lane(p.road, p.lane, p.s)
        start = p if s == p.s else LanePosition(p.road, p.lane, s, p.offset)
        return advance(lane, start, distance, route, self._forks)

    def cursor(self) -> LaneCursor:
        """A cursor for motion along lanes in many small steps."""
        return LaneCursor(self._lane)

    def route_to(self, goal: LanePosition) -> Route:
        """Field of remaining distances to a position."""
        lane, s = self._lane(goal.road, goal.lane, goal.s)
        place = LanePosition(goal.road, goal.lane, s, goal.offset)
        return Route(place, lane, self._groups, self._lane)

    def route_distance(self, a: LanePosition, b: LanePosition) -> float | None:
        """Distance from a to b along lanes (m), negative if b is behind; None if not connected."""
        lane_a, s_a = self._lane(a.road, a.lane, a.s)
        lane_b, s_b = self._lane(b.road, b.lane, b.s)
        return self._groups.signed(lane_a, s_a, lane_b, s_b)

    # --- furniture and drawing ----------------------------------------------------------------

    def signals(self) -> tuple[Signal, ...]:
        """All signals, sorted by id."""
        return self._signals

    def controllers(self) -> tuple[Controller, ...]:
        """All signal controllers, sorted by id."""
        return self._controllers

    def crosswalks(self) -> tuple[Crosswalk, ...]:
        """All crosswalks, sorted by id."""
        return self._crosswalks

    def spawn_points(self) -> tuple[LanePosition, ...]:
        """Default start positions: driving lanes outside junctions, every 20 m from 10 m."""
        return self._spawn_points

    def with_spawn_points(self, points: Sequence[LanePosition]) -> RoadMap:
        """Return this map with other default start positions."""
        other = copy(self)
        other.__dict__["_spawn_points"] = tuple(points)
        return other

    @cached_property
    def _spawn_points(self) -> tuple[LanePosition, ...]:
        return spawn_points(self._roads.values())

    def lane_outlines(
        self, bounds: tuple[float, float, float, float] | None = None, step: float = 4.0
    ) -> Iterator[LaneOutline]:
        """Edges of all lanes for drawing, optionally only near a box (xmin, ymin, xmax, ymax)."""
        return lane_outlines(self._roads.values(), bounds, step)

    def seams(self) -> tuple[Seam, ...]:
        """Joints at which lanes continue with a gap or a kink."""
        return self._seams

    @cached_property
    def _seams(self) -> tuple[Seam, ...]:
        return seams(self._roads.values())

    def seams_of(self, road: str, lane: int) -> tuple[Seam, ...]:
        """Those in a lane, at its end and at its begin."""
        return self._seams_by_lane.get((road, lane), ())

    def has_seams(self, a: LanePosition, b: LanePosition) -> bool:
        """Whether there are any in the lanes of two positions."""
        found = self._seams_by_lane
        return bool(found) and ((a.road, a.lane) in found or (b.road, b.lane) in found)

    @cached_property
    def _seams_by_lane(self) -> Mapping[tuple[str, int], tuple[Seam, ...]]:
        found: dict[tuple[str, int], tuple[Seam, ...]] = {}
        for seam in self._seams:
            for lane in dict.fromkeys(((seam.road, seam.lane), seam.onto)):
                found[lane] = (*found.get(lane, ()), seam)
        return found

    def bounds(self) -> tuple[float, float, float, float]:
        """Box around all lanes: xmin, ymin, xmax, ymax (m)."""
        return self._bounds

    # --- internals ----------------------------------------------------------------------------

    @cached_property
    def _index(self) -> RoadIndex:
        return RoadIndex(self._roads.values())

    @cached_property
    def _bounds(self) -> tuple[float, float, float, float]:
        return self._index.bounds()

    @cached_property
    def _groups(self) -> LaneGroups:
        return LaneGroups(self._roads.values())


def read_map(path: Path) -> RoadMap:
    """Reads an OpenDRIVE file; the content of a large one is kept for other processes.

    Raises:
        MapError: The file cannot be read or is not a usable map.
    """
    return RoadMap(read_content_once(Path(path)))


def read_map_text(text: str | bytes, name: str = "map") -> RoadMap:
    """Reads an OpenDRIVE map that is in memory; `name` is used in messages."""
    return RoadMap(read_content_text(text, name))

"""Methods of the map actor: routes, paths, trajectories and points (DSL 8.12.2.1)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.map.roads_and_lanes import Junction, PartT, Road, Route
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.paths.path_values import (
    NetworkPath,
    NetworkTrajectory,
    Path,
    RelativePath,
    RelativeTrajectory,
    Trajectory,
)
from osc2tx_runtime.domain.paths.relative_paths import absolute
from osc2tx_runtime.domain.points_and_poses import (
    NetworkPoint,
    OdrPoint,
    Point,
    Pose,
    RoadRoute,
    RoutePoint,
    XyzPoint,
)
from osc2tx_runtime.domain.routes.composed_routes import MadeRoute
from osc2tx_runtime.domain.routes.lane_coordinates import (
    place_of_odr,
    place_of_route,
    route_point_at,
)
from osc2tx_runtime.domain.routes.network_paths import path_in_world
from osc2tx_runtime.domain.signals.traffic_lights import TrafficLightGroup
from osc2tx_runtime.enums import (
    ConnectRoutePoints,
    PathInterpolation,
    RelativeTransform,
    SideLeftRight,
)
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import LanePosition, RoadMap

if TYPE_CHECKING:
    from osc2tx_runtime.domain.measuring.object_measurements import Measures
    from osc2tx_runtime.language.context import ExecutionContext


class RoadNetwork:
    """Methods of a map; mixed into the actor class."""

    named_file: str | None

    @property
    def context(self) -> ExecutionContext:
        """The run."""
        raise NotImplementedError

    @property
    def _map(self) -> RoadMap:
        return self.context.world.map

    # --- points -------------------------------------------------------------------------------

    def create_route_point(self, route: RoadRoute, s: float, t: float) -> RoutePoint:
        """A point in route coordinates (m)."""
        return RoutePoint(route, s, t)

    def create_xyz_point(self, x: float, y: float, z: float) -> XyzPoint:
        """A point in world coordinates (m)."""
        return XyzPoint(Point(x, y, z))

    def create_odr_point(
        self, road_id: str, lane_id: str | None = None, s: float = 0.0, t: float = 0.0
    ) -> OdrPoint:
        """A point in road coordinates (m)."""
        return OdrPoint(road_id, lane_id, s, t)

    def odr_to_route_point(
        self, road_id: str, lane_id: str | None = None, s: float = 0.0, t: float = 0.0
    ) -> RoutePoint:
        """The point on the axis of its lane; without a lane on that of its road."""
        place = place_of_odr(self._map, OdrPoint(road_id, lane_id, s, t))
        if isinstance(place, LanePosition):
            return route_point_at(self._map, place)
        return RoutePoint(RoadRoute(road_id), s, t)

    def xyz_to_route_point(self, x: float, y: float, z: float) -> RoutePoint:
        """The point on the axis of the driving lane under it.

        Raises:
            ScenarioError: There is no driving lane at the point.
        """
        on = self._map.locate(x, y, z, max_distance=1e-3)
        if on is None:
            raise ScenarioError(f"there is no driving lane at ({x:g}, {y:g})")
        return route_point_at(self._map, on)

    def route_point_to_xyz(self, route_point: RoutePoint) -> XyzPoint:
        """The point in the world."""
        place = place_of_route(self._map, route_point)
        pose = self._map.pose(place) if isinstance(place, LanePosition) else place
        return XyzPoint(Point(pose.x, pose.y, pose.z))

    # --- the network --------------------------------------------------------------------------

    def outer_side(self) -> SideLeftRight:
        """The side away from opposing traffic."""
        return "right" if self._right_hand() else "left"

    def inner_side(self) -> SideLeftRight:
        """The side towards opposing traffic."""
        return "left" if self._right_hand() else "right"

    def get_map_file(self) -> str:
        """Name of the map file as stated in the scenario; else the name of the map."""
        return self.named_file or self._map.name

    @property
    def map_file(self) -> str:
        """The same as a field."""
        return self.get_map_file()

    @property
    def routes(self) -> tuple[Road, ...]:
        """The roads outside junctions, by their numbers."""
        graph = graph_of(self._map)
        return self._seen(Road, graph.roads)

    @property
    def junctions(self) -> tuple[Junction, ...]:
        """The junctions, by their numbers."""
        return self._seen(Junction, graph_of(self._map).all("junction"))

    @property
    def traffic_light_groups(self) -> tuple[TrafficLightGroup, ...]:
        """The groups of traffic lights, by their numbers."""
        groups = tuple(TrafficLightGroup(map_id=each.id) for each in self._map.controllers())
        for group in groups:
            group.bind(self.context)
        return groups

    def _seen(self, kind: type[PartT], segments: Sequence[MapSegment]) -> tuple[PartT, ...]:
        parts = []
        for segment in segments:
            part = kind()
            part.bind(self.context)
            part.choose(segment)
            parts.append(part)
        return tuple(parts)

    def _right_hand(self) -> bool:
        rules = {road.right_hand_traffic for road in self._map.roads.values()}
        if len(rules) != 1:
            raise ScenarioError(f"map {self._map.name} has roads of both driving rules")
        return rules.pop()

    # --- paths: converted to world coordinates where they are used ----------------------------

    def create_path(
        self, points: Sequence[Pose], interpolation: PathInterpolation = "straight_line"
    ) -> Path:
        """A path through poses."""
        return Path(tuple(points), interpolation)

    def create_path_odr_points(
        self,
        points: Sequence[OdrPoint],
        interpolation: PathInterpolation = "straight_line",
        on_road_network: bool = False,
    ) -> Path:
        """A path through points in road coordinates, along the lanes if it has to stay on them."""
        return NetworkPath((), interpolation, tuple(points), on_road_network, self)

    def create_path_route_points(
        self,
        points: Sequence[RoutePoint],
        interpolation: PathInterpolation = "straight_line",
        on_road_network: bool = False,
    ) -> Path:
        """A path through points in route coordinates, likewise."""
        return NetworkPath((), interpolation, tuple(points), on_road_network, self)

    def create_route(
        self,
        routes: Sequence[NetworkPoint | Route | Path | RoadRoute],
        connect_points_by: ConnectRoutePoints = "waypoint",
        legal_route: bool = True,
    ) -> MadeRoute:
        """The route through points, roads, lanes, crossings and paths, in order (DSL 8.5.7).

        Args:
            routes: Its elements in order; gaps are filled.
            connect_points_by: Meaning of points: themselves, or the element under them.
            legal_route: No effect: lanes of vehicles are always followed in direction of travel.
        """
        return MadeRoute((), "smooth", (), True, self, tuple(_elements(routes)), connect_points_by)

    def in_world(self, path: Path) -> Path:
        """A path through poses of this map.

        Raises:
            PathError: A point is not on the map, or no route along lanes leads to it.
        """
        return path_in_world(self._map, path)

    def create_trajectory(
        self,
        points: Sequence[Pose],
        time_stamps: Sequence[float],
        interpolation: PathInterpolation = "straight_line",
    ) -> Trajectory:
        """A trajectory through poses."""
        return Trajectory(tuple(points), tuple(time_stamps), interpolation)

    def create_trajectory_odr_points(
        self,
        points: Sequence[OdrPoint],
        time_stamps: Sequence[float],
        interpolation: PathInterpolation = "straight_line",
        on_road_network: bool = False,
    ) -> Trajectory:
        """A trajectory through points in road coordinates."""
        stamps = tuple(time_stamps)
        return NetworkTrajectory((), stamps, interpolation, tuple(points), on_road_network)

    def create_trajectory_route_points(
        self,
        points: Sequence[RoutePoint],
        time_stamps: Sequence[float],
        interpolation: PathInterpolation = "straight_line",
        on_road_network: bool = False,
    ) -> Trajectory:
        """A trajectory through points in route coordinates."""
        stamps = tuple(time_stamps)
        return NetworkTrajectory((), stamps, interpolation, tuple(points), on_road_network)

    def resolve_relative_path(
        self, relative_path: RelativePath, reference: Measures, transform: RelativeTransform
    ) -> Path:
        """The absolute path, at the present pose of the reference."""
        points, interpolation = relative_path.points, relative_path.interpolation
        poses = absolute(self._map, points, reference.state, transform, interpolation)
        return Path(poses, interpolation)

    def resolve_relative_trajectory(
        self,
        relative_trajectory: RelativeTrajectory,
        reference: Measures,
        transform: RelativeTransform,
    ) -> Trajectory:
        """The absolute trajectory, at the present pose of the reference; times are unchanged."""
        poses = absolute(self._map, relative_trajectory.points, reference.state, transform)
        return Trajectory(poses, relative_trajectory.time_stamps, relative_trajectory.interpolation)


def _elements(
    routes: Sequence[NetworkPoint | Route | Path | RoadRoute],
) -> Iterator[NetworkPoint | Route | Path | RoadRoute]:
    """The elements of routes; composed routes are expanded."""
    for each in routes:
        if isinstance(each, MadeRoute):
            yield from _elements(each.route_elements)
        else:
            yield each

"""Start positions given as a point in the world."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from osc2tx_runtime import opendrive
from osc2tx_runtime.domain.modifiers import Lane, Position
from osc2tx_runtime.domain.placing.pose_resolution import pose_of, road_heading
from osc2tx_runtime.domain.routes.lane_coordinates import place_of_route
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world.geometry.lane_neighbours import lane_with_number, number_of_lane
from osc2tx_runtime.world.motion.moving_body import ANY_LANE

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import PhysicalObject
    from osc2tx_runtime.domain.points_and_poses import Point, RoutePoint

_MARGIN = 50.0  # m around the lanes that still belong to the map


class PointPlaces:
    """Positions at, under, or at a distance from points."""

    def __init__(self, road_map: RoadMap) -> None:
        self._map = road_map

    def check_lane(
        self, actor: PhysicalObject, at: LanePosition | opendrive.Pose, lane: Lane
    ) -> None:
        """Check that a lane modifier agrees with the point, which determines the lane."""
        if lane.reference is not None:
            raise PlacementError(
                f"{actor.id}: its point already determines the lane, which cannot be relative to"
                f" {lane.reference.id}"
            )
        on = (
            at
            if isinstance(at, LanePosition)
            else self._map.locate(at.x, at.y, at.z, max_distance=1e-3)
        )
        if on is None or number_of_lane(self._map, on, lane.edge) != lane.number:
            raise PlacementError(
                f"{actor.id}: its point is not on lane {lane.number} from the {lane.edge}"
            )

    def projected(self, actor: PhysicalObject, point: Point, lane: Lane | None) -> LanePosition:
        """Centre of the driving lane nearest to a point, or of a lane beside it."""
        on = self._map.locate(point.x, point.y, point.z)
        if on is None:
            raise PlacementError(
                f"{actor.id}: there is no lane near ({point.x:g}, {point.y:g}); with"
                " project_on_route: false it can be off the road"
            )
        place = LanePosition(on.road, on.lane, on.s)
        if lane is None:
            return place
        if lane.reference is not None:
            self.check_lane(actor, place, lane)
        return self.numbered(actor, place, lane)

    def at_point(self, actor: PhysicalObject, position: Position) -> LanePosition | opendrive.Pose:
        """Position of the point: on a lane if there is one, else off the lanes."""
        pose, heading = pose_of(actor, position)
        west, south, east, north = self._map.bounds()
        if not (
            west - _MARGIN <= pose.x <= east + _MARGIN
            and south - _MARGIN <= pose.y <= north + _MARGIN
        ):
            raise PlacementError(
                f"{actor.id}: ({pose.x:g}, {pose.y:g}) is off the map, which reaches from"
                f" ({west:.0f}, {south:.0f}) to ({east:.0f}, {north:.0f})"
            )
        z = None if position.z is None and position.at_point is None else pose.z
        types = opendrive.DRIVING if actor.lane_bound else ANY_LANE
        on = self._map.locate(pose.x, pose.y, z, heading, lane_types=types, max_distance=1e-3)
        if on is None:
            h = road_heading(self._map, pose) if heading is None else heading
            return opendrive.Pose(pose.x, pose.y, pose.z, h)
        lane = self._map.pose(on)
        if actor.lane_bound and math.cos(lane.h - (lane.h if heading is None else heading)) > 0.0:
            return on
        h = lane.h if heading is None else heading
        return opendrive.Pose(pose.x, pose.y, lane.z if z is None else z, h)

    def on_way(self, actor: PhysicalObject, point: RoutePoint) -> LanePosition | opendrive.Pose:
        """A point of a path or crossing, with its heading; vehicles in the lane at that point."""
        pose = place_of_route(self._map, point)
        assert isinstance(pose, opendrive.Pose)
        return self.at_pose(actor, pose)

    def at_pose(self, actor: PhysicalObject, pose: opendrive.Pose) -> LanePosition | opendrive.Pose:
        """A pose of a path; of vehicles in the lane at that pose."""
        on = self._map.locate(pose.x, pose.y, heading=pose.h, max_distance=1e-3)
        if on is None or not actor.lane_bound or math.cos(self._map.pose(on).h - pose.h) <= 0.0:
            return pose
        return on

    def near_point(
        self, actor: PhysicalObject, position: Position, distance: float, lane: Lane | None
    ) -> LanePosition:
        """The position at a distance (m) ahead of or behind a point on the road."""
        assert position.reference_point is not None
        place = self.projected(actor, position.reference_point, lane)
        wanted = distance if position.ahead else -distance
        step = self._map.advance(place, wanted)
        if abs(step.travelled - wanted) > 1e-6:
            raise PlacementError(
                f"{actor.id}: lane {place.lane} of road {place.road} does not reach"
                f" {abs(wanted):.1f} m from its point"
            )
        return step.position

    def numbered(self, actor: PhysicalObject, place: LanePosition, lane: Lane) -> LanePosition:
        """The lane with a number at the road coordinate of a position."""
        found = lane_with_number(self._map, place, lane.number, lane.edge)
        if found is None:
            raise PlacementError(
                f"{actor.id}: road {place.road} has no lane {lane.number} from the {lane.edge}"
                f" at s = {place.s:.1f} m"
            )
        return found

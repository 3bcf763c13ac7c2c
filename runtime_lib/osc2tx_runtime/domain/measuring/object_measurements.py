"""Readable fields and measuring methods of physical objects."""

from __future__ import annotations

import math

from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart
from osc2tx_runtime.domain.measuring.object_position import MeasuredObject, RoutePosition
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.domain.points_and_poses import (
    OdrPoint,
    Orientation,
    Point,
    Pose,
    RoutePoint,
    XyzPoint,
)
from osc2tx_runtime.domain.routes.lane_coordinates import place_of_odr, place_of_route
from osc2tx_runtime.domain.routes.place_on_route import place_on_route
from osc2tx_runtime.domain.routes.route_coordinates import (
    between_on_crossing,
    between_on_section,
    place_in_route,
)
from osc2tx_runtime.enums import (
    DistanceDirection,
    DistanceMode,
    OnRouteType,
    RoadDistanceDirection,
    RouteDistanceEnum,
)
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.opendrive import Pose as MapPose
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.measuring.distances import (
    across_road,
    along_own_lane,
    along_road,
    gap_between,
    headway_between,
    lateral_on_road,
    object_distance,
    side_gap,
    time_to_collision,
    time_to_cover,
)
from osc2tx_runtime.world.measuring.measured import Measured
from osc2tx_runtime.world.measuring.velocities import Acceleration, Velocity
from osc2tx_runtime.world.state import ActorState


class Measures(MeasuredObject):
    """Measurements of a physical object; mixed into the actor classes."""

    # --- fields -------------------------------------------------------------------------------

    @property
    def speed(self) -> float:
        """Speed (m/s), negative in reverse."""
        return Measured(self.state.v)

    @property
    def velocity(self) -> Velocity:
        """Velocity over ground, in the axes of the object."""
        return self.context.world.motion(self.id).velocity

    @property
    def acceleration(self) -> Acceleration:
        """Acceleration over ground, in the axes of the object."""
        return self.context.world.motion(self.id).acceleration

    @property
    def position(self) -> RoutePosition:
        """Position of the reference point."""
        return RoutePosition(self)

    @property
    def orientation(self) -> Orientation:
        """Orientation (rad)."""
        state = self.state
        return Orientation(*map(Measured, (state.roll, state.pitch, state.h)))

    @property
    def pose(self) -> Pose:
        """Pose of the reference point."""
        place = Point(*map(Measured, self.state[:3]))
        return Pose(position=place, orientation=self.orientation)

    # --- distances ----------------------------------------------------------------------------

    def object_distance(
        self,
        reference: Measures,
        direction: DistanceDirection,
        mode: DistanceMode = "reference_points",
    ) -> float:
        """Distance (m) in the axes of the object.

        Positive if the reference is ahead, left or above.
        """
        return Measured(object_distance(self.state, reference.state, direction, mode))

    def road_distance(
        self,
        reference: Measures,
        direction: RoadDistanceDirection,
        mode: DistanceMode = "reference_points",
        route_type: OnRouteType = "on_road",
    ) -> float:
        """Distance (m) along or across the road; positive if the reference is ahead or left.

        On one road, or in one lane section, it is the difference of s or t, in whatever lanes both
        are; from one to another, and with `on_lane`, it is measured along the lanes between them,
        to oncoming traffic along the own lane.

        With `bounding_boxes` it is measured between the facing ends or sides.
        """
        return Measured(self._road_distance_to(reference.state, direction, mode, route_type))

    def space_gap(self, reference: Measures, direction: RoadDistanceDirection) -> float:
        """Space (m) between facing ends or sides; positive if the caller is ahead or left.

        0 while both overlap in this direction. Vehicles in adjacent lanes also have a longitudinal
        gap.
        """
        world = self.context.world
        me, other = world.state(self.id), world.state(reference.id)
        if direction == "longitudinal":
            along = -self._way(world.map, me, reference, other)
            return Measured(gap_between(along, me.shape, other.shape))
        return Measured(side_gap(self._distance_across(reference), me.shape, other.shape))

    def time_gap(self, reference: Measures, direction: RoadDistanceDirection) -> float:
        """Space gap over the speed of the follower (s); lateral: over the approach speed."""
        gap = self.space_gap(reference, direction)
        if direction == "longitudinal":
            return Measured(time_to_cover(gap, reference.speed if gap > 0.0 else self.speed))
        me, other = self.state, reference.state
        place = me.lane_position
        along = me.h if place is None else self.context.world.map.pose(place).h
        to_left = me.v * math.sin(me.h - along) - other.v * math.sin(other.h - along)
        return Measured(time_to_cover(gap, -to_left if gap > 0.0 else to_left))

    def space_headway(self, reference: Measures) -> float:
        """Distance (m) from front to front; positive if the caller is the follower."""
        along = self._distance_along(reference)
        return Measured(-headway_between(-along, self.state.shape, reference.state.shape))

    def time_headway(self, reference: Measures) -> float:
        """Space headway over the speed of the follower (s).

        Positive if the caller is the follower.
        """
        headway = self.space_headway(reference)
        return Measured(time_to_cover(headway, self.speed if headway > 0.0 else reference.speed))

    def time_to_collision(self, reference: Measures) -> float:
        """Time (s) until the boxes touch at constant velocities; infinite if they never do."""
        return Measured(time_to_collision(self.state, reference.state))

    def get_s_coord(self, route_type: OnRouteType = "on_road") -> float:
        """Road coordinate (m), or distance along the lane centre from the start of the lane."""
        return Measured(self.get_route_point(route_type).s)

    def get_t_coord(self, route_type: OnRouteType = "on_road") -> float:
        """Distance (m) to the left of the reference line of the road, or of the lane centre."""
        return Measured(self.get_route_point(route_type).t)

    def get_route_point(self, route_type: OnRouteType = "on_road") -> RoutePoint:
        """Position in coordinates of the road, lane section, lane or crossing."""
        try:
            return place_in_route(self.context, self.state, route_type)
        except ScenarioError as error:
            raise ScenarioError(f"{self.id}: {error.message}") from error

    # --- distances to points ------------------------------------------------------------------

    def distance_to_xyz_point(
        self,
        point: XyzPoint,
        direction: DistanceDirection,
        mode: DistanceMode = "reference_points",
    ) -> float:
        """As `object_distance`, to a point."""
        there = point.position
        return Measured(object_distance(self.state, self._standing_at(there, 0.0), direction, mode))

    def distance_to_route_point(
        self,
        point: RoutePoint,
        direction: RoadDistanceDirection,
        mode: DistanceMode = "reference_points",
        route_type: OnRouteType = "on_road",
    ) -> float:
        """As `road_distance`, to a point."""
        there = self._at_place(place_of_route(self.context.world.map, point))
        return Measured(self._road_distance_to(there, direction, mode, route_type))

    def distance_to_odr_point(
        self,
        point: OdrPoint,
        direction: RoadDistanceDirection,
        mode: DistanceMode = "reference_points",
        route_type: OnRouteType = "on_road",
    ) -> float:
        """As `road_distance`, to a point."""
        there = self._at_place(place_of_odr(self.context.world.map, point))
        return Measured(self._road_distance_to(there, direction, mode, route_type))

    def distance_along_route(
        self, route: Path | RoadPart, from_: RouteDistanceEnum = "from_start"
    ) -> float:
        """Metres from the start of a route to this object, or from it to the end of the route.

        Raises:
            ScenarioError: It is not on the route.
        """
        try:
            along, length = place_on_route(self.context.world.map, route, self.state)
        except ScenarioError as error:
            raise ScenarioError(f"{self.id}: {error.message}") from error
        return Measured(along if from_ == "from_start" else length - along)

    # --- internals ----------------------------------------------------------------------------

    def _road_distance_to(
        self,
        there: ActorState,
        direction: RoadDistanceDirection,
        mode: DistanceMode,
        route_type: OnRouteType,
    ) -> float:
        here, road_map = self.state, self.context.world.map
        ahead = direction == "longitudinal"
        if route_type == "on_crossing":
            return between_on_crossing(self.context, here, there, ahead=ahead, mode=mode)
        distance = None
        if route_type == "on_lane_section":
            distance = between_on_section(self.context, here, there, ahead=ahead)
        if route_type == "on_road":
            distance = (along_road if ahead else across_road)(road_map, here, there)
        if distance is None:
            distance = (along_own_lane if ahead else lateral_on_road)(road_map, here, there)
        if distance is None:
            raise ScenarioError(
                f"no route along lanes leads from {self.id} to the position or back"
            )
        if mode == "reference_points":
            return distance
        if ahead:
            return -gap_between(-distance, here.shape, there.shape)
        return -side_gap(distance, here.shape, there.shape)

    def _standing_at(self, point: Point, heading: float) -> ActorState:
        """A point as an object without extent."""
        on = self.context.world.map.locate(point.x, point.y, point.z)
        shape = Shape(0.0, 0.0, 0.0, 0.0)
        return ActorState(point.x, point.y, point.z, heading, 0.0, 0.0, on, 0.0, shape)

    def _at_place(self, place: LanePosition | MapPose) -> ActorState:
        pose = self.context.world.map.pose(place) if isinstance(place, LanePosition) else place
        state = self._standing_at(Point(pose.x, pose.y, pose.z), pose.h)
        return state._replace(lane_position=place) if isinstance(place, LanePosition) else state

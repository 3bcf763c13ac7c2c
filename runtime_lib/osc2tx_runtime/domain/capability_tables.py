"""Tables of the readable fields and methods and of the value classes, by their DSL names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from osc2tx_runtime.domain.actors import (
    Animal,
    Environment,
    Map,
    MovableObject,
    Orientation,
    Person,
    PhysicalObject,
    Point,
    Pose,
    StationaryObject,
    TrafficLightController,
    Trailer,
    Vehicle,
)
from osc2tx_runtime.domain.actors.road_network import RoadNetwork
from osc2tx_runtime.domain.measuring.object_position import RoutePosition
from osc2tx_runtime.domain.measuring.weather import (
    Air,
    CelestialLightSource,
    CelestialPosition,
    Clouds,
    Fog,
    GeodeticPosition,
    Precipitation,
    Weather,
    Wind,
)
from osc2tx_runtime.domain.objects.parts import (
    Axle,
    BehavioralModel,
    BmEngine,
    BoundingBox,
    HitchCoupler,
    HitchReceiver,
)
from osc2tx_runtime.domain.paths.path_values import (
    Path,
    RelativePathOdr,
    RelativePathPose3d,
    RelativePathSt,
    RelativeTrajectoryOdr,
    RelativeTrajectoryPose3d,
    RelativeTrajectorySt,
    Trajectory,
)
from osc2tx_runtime.domain.points_and_poses import GeodeticPoint, OdrPoint, RoutePoint, XyzPoint
from osc2tx_runtime.domain.routes.crossings import Crossing, CrossingType
from osc2tx_runtime.domain.routes.roads_and_lanes import (
    CompoundLane,
    CompoundRoute,
    Junction,
    Lane,
    LaneSection,
    Road,
    RoadPath,
    Route,
)
from osc2tx_runtime.domain.shapes import (
    AnyAccelerationShape,
    AnyLateralShape,
    AnyPositionShape,
    AnyShape,
    AnySpeedShape,
    CommonAccelerationShape,
    CommonLateralShape,
    CommonPositionShape,
    CommonShape,
    CommonSpeedShape,
)
from osc2tx_runtime.domain.signals.stop_lines import TrafficLightStopLine
from osc2tx_runtime.domain.signals.traffic_lights import (
    TrafficLight,
    TrafficLightBulb,
    TrafficLightCycle,
    TrafficLightGroup,
    TrafficLightPhase,
)
from osc2tx_runtime.world.velocities import (
    Acceleration,
    OrientationAcceleration,
    OrientationRate,
    TranslationalAcceleration,
    TranslationalVelocity,
    Velocity,
)

__all__ = ["FIELDS", "MANDATORY", "METHODS", "OBJECTS", "UNKNOWN"]

METHODS: Mapping[str, Callable[..., Any]] = {
    "physical_object.object_distance": PhysicalObject.object_distance,
    "physical_object.road_distance": PhysicalObject.road_distance,
    "physical_object.get_s_coord": PhysicalObject.get_s_coord,
    "physical_object.get_t_coord": PhysicalObject.get_t_coord,
    "physical_object.get_route_point": PhysicalObject.get_route_point,
    "physical_object.distance_to_xyz_point": PhysicalObject.distance_to_xyz_point,
    "physical_object.distance_to_route_point": PhysicalObject.distance_to_route_point,
    "physical_object.distance_to_odr_point": PhysicalObject.distance_to_odr_point,
    **{
        f"map.{name}": method
        for name, method in vars(RoadNetwork).items()
        if not name.startswith("_") and callable(method) and name != "in_world"
    },
    "traffic_participant.space_gap": PhysicalObject.space_gap,
    "traffic_participant.time_gap": PhysicalObject.time_gap,
    "traffic_participant.space_headway": PhysicalObject.space_headway,
    "traffic_participant.time_headway": PhysicalObject.time_headway,
    "traffic_participant.time_to_collision": PhysicalObject.time_to_collision,
    "traffic_light.state_equal": TrafficLight.state_equal,
    "traffic_light.semantic_state_to_state": TrafficLight.semantic_state_to_state,
    "traffic_light.state_to_semantic_state": TrafficLight.state_to_semantic_state,
    "traffic_light_group.state_equal": TrafficLightGroup.state_equal,
    "movable_object.distance_along_route": PhysicalObject.distance_along_route,
    "environment.local_to_unix_time": Environment.local_to_unix_time,
    "physical_object.set_bm": PhysicalObject.set_bm,
    "position_3d.norm": Point.norm,
    "any_shape.duration": CommonShape.duration,
    "any_acceleration_shape.compute": CommonShape.compute,
    "any_lateral_shape.compute": CommonShape.compute,
    "any_position_shape.compute": CommonShape.compute,
    "any_speed_shape.compute": CommonShape.compute,
    "route.end_point": Route.end_point,
    "route.start_point": Route.start_point,
    "translational_acceleration_3d.norm": TranslationalAcceleration.norm,
    "translational_velocity_3d.norm": TranslationalVelocity.norm,
    "carla_position.ahead_of": RoutePosition.ahead_of,
    "carla_position.behind": RoutePosition.behind,
}
"""Methods of the domain model that can be read in expressions."""

FIELDS: Mapping[str, str] = {
    "physical_object.bounding_box": "bounding_box",
    "physical_object.center_of_gravity": "position_3d",
    "physical_object.color": "color",
    "physical_object.geometry_reference": "string",
    "physical_object.initial_bm": "behavioral_model",
    "physical_object.position": "carla_position",
    "physical_object.orientation": "orientation_3d",
    "physical_object.pose": "pose_3d",
    "movable_object.speed": "speed",
    "movable_object.acceleration": "acceleration_6d",
    "movable_object.velocity": "velocity_6d",
    "traffic_participant.intended_infrastructure": "list of intended_infrastructure",
    "traffic_participant.role": "traffic_participant_role",
    "trailer.coupler": "hitch_coupler",
    "trailer.tow_vehicle": "vehicle",
    "trailer.trailer_category": "trailer_category",
    "vehicle.axles": "list of axle",
    "vehicle.rear_overhang": "length",
    "vehicle.trailer_receiver": "hitch_receiver",
    "vehicle.vehicle_category": "vehicle_category",
    "environment.datetime": "time",
    "environment.geodetic_position": "geodetic_position_2d",
    "environment.sun": "celestial_light_source",
    "environment.moon": "celestial_light_source",
    "environment.weather": "weather",
    "map.driving_rule": "driving_rule",
    "map.junctions": "list of junction",
    "map.map_file": "string",
    "map.routes": "list of route",
    "map.traffic_light_control": "list of traffic_light_cycle",
    "map.traffic_light_groups": "list of traffic_light_group",
    "relative_path.interpolation": "path_interpolation",
    "relative_trajectory.interpolation": "path_interpolation",
    "relative_trajectory.time_stamps": "list of time",
    "route_point.s": "length",
    "route_point.t": "length",
    "traffic_light.bulbs": "list of traffic_light_bulb",
    "traffic_light.group": "traffic_light_group",
    "traffic_light_bulb.state": "bulb_state",
    "traffic_light_group.bulbs": "list of traffic_light_bulb",
    "traffic_light_group.traffic_lights": "list of traffic_light",
    "xyz_point.position": "position_3d",
}
"""Members of actors that can be read in expressions, with their types; of structs all can be."""

OBJECTS: Mapping[str, Callable[..., Any]] = {
    **{
        kind.kinds[0]: kind
        for kind in (
            Animal,
            Environment,
            Map,
            MovableObject,
            Person,
            PhysicalObject,
            StationaryObject,
            TrafficLightController,
            Trailer,
            Vehicle,
        )
    },
    "acceleration_6d": Acceleration,
    "air": Air,
    "axle": Axle,
    "behavioral_model": BehavioralModel,
    "bm_engine": BmEngine,
    "bounding_box": BoundingBox,
    "celestial_light_source": CelestialLightSource,
    "celestial_position_2d": CelestialPosition,
    "clouds": Clouds,
    "fog": Fog,
    "geodetic_position_2d": GeodeticPosition,
    "hitch_coupler": HitchCoupler,
    "hitch_receiver": HitchReceiver,
    "orientation_acceleration_3d": OrientationAcceleration,
    "orientation_rate_3d": OrientationRate,
    "precipitation": Precipitation,
    "translational_acceleration_3d": TranslationalAcceleration,
    "translational_velocity_3d": TranslationalVelocity,
    "velocity_6d": Velocity,
    "weather": Weather,
    "wind": Wind,
    "orientation_3d": Orientation,
    "pose_3d": Pose,
    "position_3d": Point,
    "any_acceleration_shape": AnyAccelerationShape,
    "any_lateral_shape": AnyLateralShape,
    "any_position_shape": AnyPositionShape,
    "any_shape": AnyShape,
    "any_speed_shape": AnySpeedShape,
    "common_acceleration_shape": CommonAccelerationShape,
    "common_lateral_shape": CommonLateralShape,
    "common_position_shape": CommonPositionShape,
    "common_speed_shape": CommonSpeedShape,
    "compound_lane": CompoundLane,
    "compound_route": CompoundRoute,
    "crossing": Crossing,
    "crossing_type": CrossingType,
    "geodetic_point": GeodeticPoint,
    "junction": Junction,
    "lane": Lane,
    "lane_section": LaneSection,
    "road": Road,
    "route": Route,
    "traffic_light": TrafficLight,
    "traffic_light_bulb": TrafficLightBulb,
    "traffic_light_cycle": TrafficLightCycle,
    "traffic_light_group": TrafficLightGroup,
    "traffic_light_phase": TrafficLightPhase,
    "traffic_light_stop_line": TrafficLightStopLine,
    "odr_point": OdrPoint,
    "path": Path,
    "Path": RoadPath,
    "relative_path_odr": RelativePathOdr,
    "relative_path_pose_3d": RelativePathPose3d,
    "relative_path_st": RelativePathSt,
    "relative_trajectory_odr": RelativeTrajectoryOdr,
    "relative_trajectory_pose_3d": RelativeTrajectoryPose3d,
    "relative_trajectory_st": RelativeTrajectorySt,
    "route_point": RoutePoint,
    "trajectory": Trajectory,
    "xyz_point": XyzPoint,
}
"""Classes of actors and values, by their names in the domain model."""

MANDATORY: Mapping[str, tuple[str, ...]] = {
    "axle": ("max_steering", "wheel_diameter", "track_width", "position_x", "position_z"),
    "bounding_box": ("length", "width", "height"),
    "clouds": ("cloudiness",),
    "fog": ("visual_range",),
    "hitch_coupler": ("hitch_type", "position_x", "position_z"),
    "hitch_receiver": ("position_x", "position_z"),
    "wind": ("speed", "direction"),
}
"""Members that a value of a scenario's own must have, besides those without a default.

As members of an actor these values may leave them open: the catalogue knows them.
"""

UNKNOWN = (
    "environment.datetime",
    "environment.geodetic_position",
    "physical_object.color",
    "physical_object.geometry_reference",
)
"""Members of actors that only the scenario can say."""

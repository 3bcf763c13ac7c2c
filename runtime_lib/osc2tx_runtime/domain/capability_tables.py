"""Tables of the readable fields and methods and of the value classes, by their DSL names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from osc2tx_runtime.domain import actors, points_and_poses, shapes
from osc2tx_runtime.domain.actors import road_network
from osc2tx_runtime.domain.map import crossings, roads_and_lanes
from osc2tx_runtime.domain.measuring import object_position, weather
from osc2tx_runtime.domain.objects import parts
from osc2tx_runtime.domain.paths import path_values
from osc2tx_runtime.domain.signals import stop_lines, traffic_lights
from osc2tx_runtime.world.measuring import velocities

METHODS: Mapping[str, Callable[..., Any]] = {
    "physical_object.object_distance": actors.PhysicalObject.object_distance,
    "physical_object.road_distance": actors.PhysicalObject.road_distance,
    "physical_object.get_s_coord": actors.PhysicalObject.get_s_coord,
    "physical_object.get_t_coord": actors.PhysicalObject.get_t_coord,
    "physical_object.get_route_point": actors.PhysicalObject.get_route_point,
    "physical_object.distance_to_xyz_point": actors.PhysicalObject.distance_to_xyz_point,
    "physical_object.distance_to_route_point": actors.PhysicalObject.distance_to_route_point,
    "physical_object.distance_to_odr_point": actors.PhysicalObject.distance_to_odr_point,
    **{
        f"map.{name}": method
        for name, method in vars(road_network.RoadNetwork).items()
        if not name.startswith("_") and callable(method) and name != "in_world"
    },
    "traffic_participant.space_gap": actors.PhysicalObject.space_gap,
    "traffic_participant.time_gap": actors.PhysicalObject.time_gap,
    "traffic_participant.space_headway": actors.PhysicalObject.space_headway,
    "traffic_participant.time_headway": actors.PhysicalObject.time_headway,
    "traffic_participant.time_to_collision": actors.PhysicalObject.time_to_collision,
    "traffic_light.state_equal": traffic_lights.TrafficLight.state_equal,
    "traffic_light.semantic_state_to_state": traffic_lights.TrafficLight.semantic_state_to_state,
    "traffic_light.state_to_semantic_state": traffic_lights.TrafficLight.state_to_semantic_state,
    "traffic_light_group.state_equal": traffic_lights.TrafficLightGroup.state_equal,
    "movable_object.distance_along_route": actors.PhysicalObject.distance_along_route,
    "environment.local_to_unix_time": actors.Environment.local_to_unix_time,
    "physical_object.set_bm": actors.PhysicalObject.set_bm,
    "position_3d.norm": actors.Point.norm,
    "any_shape.duration": shapes.CommonShape.duration,
    "any_acceleration_shape.compute": shapes.CommonShape.compute,
    "any_lateral_shape.compute": shapes.CommonShape.compute,
    "any_position_shape.compute": shapes.CommonShape.compute,
    "any_speed_shape.compute": shapes.CommonShape.compute,
    "route.end_point": roads_and_lanes.Route.end_point,
    "route.start_point": roads_and_lanes.Route.start_point,
    "translational_acceleration_3d.norm": velocities.TranslationalAcceleration.norm,
    "translational_velocity_3d.norm": velocities.TranslationalVelocity.norm,
    "carla_position.ahead_of": object_position.RoutePosition.ahead_of,
    "carla_position.behind": object_position.RoutePosition.behind,
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
"""Members of actors that can be read in expressions, with their types; of structs all members."""

OBJECTS: Mapping[str, Callable[..., Any]] = {
    **{
        kind.kinds[0]: kind
        for kind in (
            actors.Animal,
            actors.Environment,
            actors.Map,
            actors.MovableObject,
            actors.Person,
            actors.PhysicalObject,
            actors.StationaryObject,
            actors.TrafficLightController,
            actors.Trailer,
            actors.Vehicle,
        )
    },
    "acceleration_6d": velocities.Acceleration,
    "air": weather.Air,
    "axle": parts.Axle,
    "behavioral_model": parts.BehavioralModel,
    "bm_engine": parts.BmEngine,
    "bounding_box": parts.BoundingBox,
    "celestial_light_source": weather.CelestialLightSource,
    "celestial_position_2d": weather.CelestialPosition,
    "clouds": weather.Clouds,
    "fog": weather.Fog,
    "geodetic_position_2d": weather.GeodeticPosition,
    "hitch_coupler": parts.HitchCoupler,
    "hitch_receiver": parts.HitchReceiver,
    "orientation_acceleration_3d": velocities.OrientationAcceleration,
    "orientation_rate_3d": velocities.OrientationRate,
    "precipitation": weather.Precipitation,
    "translational_acceleration_3d": velocities.TranslationalAcceleration,
    "translational_velocity_3d": velocities.TranslationalVelocity,
    "velocity_6d": velocities.Velocity,
    "weather": weather.Weather,
    "wind": weather.Wind,
    "orientation_3d": actors.Orientation,
    "pose_3d": actors.Pose,
    "position_3d": actors.Point,
    "any_acceleration_shape": shapes.AnyAccelerationShape,
    "any_lateral_shape": shapes.AnyLateralShape,
    "any_position_shape": shapes.AnyPositionShape,
    "any_shape": shapes.AnyShape,
    "any_speed_shape": shapes.AnySpeedShape,
    "common_acceleration_shape": shapes.CommonAccelerationShape,
    "common_lateral_shape": shapes.CommonLateralShape,
    "common_position_shape": shapes.CommonPositionShape,
    "common_speed_shape": shapes.CommonSpeedShape,
    "compound_lane": roads_and_lanes.CompoundLane,
    "compound_route": roads_and_lanes.CompoundRoute,
    "crossing": crossings.Crossing,
    "crossing_type": crossings.CrossingType,
    "geodetic_point": points_and_poses.GeodeticPoint,
    "junction": roads_and_lanes.Junction,
    "lane": roads_and_lanes.Lane,
    "lane_section": roads_and_lanes.LaneSection,
    "road": roads_and_lanes.Road,
    "route": roads_and_lanes.Route,
    "traffic_light": traffic_lights.TrafficLight,
    "traffic_light_bulb": traffic_lights.TrafficLightBulb,
    "traffic_light_cycle": traffic_lights.TrafficLightCycle,
    "traffic_light_group": traffic_lights.TrafficLightGroup,
    "traffic_light_phase": traffic_lights.TrafficLightPhase,
    "traffic_light_stop_line": stop_lines.TrafficLightStopLine,
    "odr_point": points_and_poses.OdrPoint,
    "path": path_values.Path,
    "Path": roads_and_lanes.RoadPath,
    "relative_path_odr": path_values.RelativePathOdr,
    "relative_path_pose_3d": path_values.RelativePathPose3d,
    "relative_path_st": path_values.RelativePathSt,
    "relative_trajectory_odr": path_values.RelativeTrajectoryOdr,
    "relative_trajectory_pose_3d": path_values.RelativeTrajectoryPose3d,
    "relative_trajectory_st": path_values.RelativeTrajectorySt,
    "route_point": points_and_poses.RoutePoint,
    "trajectory": path_values.Trajectory,
    "xyz_point": points_and_poses.XyzPoint,
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
"""Members that a value defined by a scenario must have, besides those without a default.

As members of an actor these values may omit them.
"""

UNKNOWN = (
    "environment.datetime",
    "environment.geodetic_position",
    "physical_object.color",
    "physical_object.geometry_reference",
)
"""Members of actors that only the scenario can state."""

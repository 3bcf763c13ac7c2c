"""The objects of the library that the runtime makes: their classes, and what these take.

The compiler does not import the runtime; a test compares these tables with the runtime.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

ROOT = "osc_actor"
"""The type of the library that all actors inherit from."""

# Actor type of the standard library -> class of the runtime.
ACTOR_CLASSES = {
    "animal": "Animal",
    "environment": "Environment",
    "map": "Map",
    "movable_object": "MovableObject",
    "person": "Person",
    "physical_object": "PhysicalObject",
    "stationary_object": "StationaryObject",
    "traffic_light_controller": "TrafficLightController",
    "trailer": "Trailer",
    "vehicle": "Vehicle",
}

# Struct type of the standard library -> value class of the runtime.
STRUCT_CLASSES = {
    "acceleration_6d": "Acceleration",
    "air": "Air",
    "axle": "Axle",
    "behavioral_model": "BehavioralModel",
    "bm_engine": "BmEngine",
    "bounding_box": "BoundingBox",
    "celestial_light_source": "CelestialLightSource",
    "celestial_position_2d": "CelestialPosition",
    "clouds": "Clouds",
    "any_acceleration_shape": "AnyAccelerationShape",
    "any_lateral_shape": "AnyLateralShape",
    "any_position_shape": "AnyPositionShape",
    "any_shape": "AnyShape",
    "any_speed_shape": "AnySpeedShape",
    "common_acceleration_shape": "CommonAccelerationShape",
    "common_lateral_shape": "CommonLateralShape",
    "common_position_shape": "CommonPositionShape",
    "common_speed_shape": "CommonSpeedShape",
    "compound_lane": "CompoundLane",
    "compound_route": "CompoundRoute",
    "crossing": "Crossing",
    "crossing_type": "CrossingType",
    "geodetic_point": "GeodeticPoint",
    "fog": "Fog",
    "geodetic_position_2d": "GeodeticPosition",
    "hitch_coupler": "HitchCoupler",
    "hitch_receiver": "HitchReceiver",
    "junction": "Junction",
    "lane": "Lane",
    "lane_section": "LaneSection",
    "odr_point": "OdrPoint",
    "orientation_3d": "Orientation",
    "orientation_acceleration_3d": "OrientationAcceleration",
    "orientation_rate_3d": "OrientationRate",
    "Path": "RoadPath",
    "path": "Path",
    "pose_3d": "Pose",
    "position_3d": "Point",
    "precipitation": "Precipitation",
    "relative_path_odr": "RelativePathOdr",
    "relative_path_pose_3d": "RelativePathPose3d",
    "relative_path_st": "RelativePathSt",
    "relative_trajectory_odr": "RelativeTrajectoryOdr",
    "relative_trajectory_pose_3d": "RelativeTrajectoryPose3d",
    "relative_trajectory_st": "RelativeTrajectorySt",
    "road": "Road",
    "route": "Route",
    "route_point": "RoutePoint",
    "traffic_light": "TrafficLight",
    "traffic_light_bulb": "TrafficLightBulb",
    "traffic_light_cycle": "TrafficLightCycle",
    "traffic_light_group": "TrafficLightGroup",
    "traffic_light_phase": "TrafficLightPhase",
    "traffic_light_stop_line": "TrafficLightStopLine",
    "trajectory": "Trajectory",
    "translational_acceleration_3d": "TranslationalAcceleration",
    "translational_velocity_3d": "TranslationalVelocity",
    "velocity_6d": "Velocity",
    "weather": "Weather",
    "wind": "Wind",
    "xyz_point": "XyzPoint",
}

# Members whose own members the constructor of the object takes itself: `Vehicle(length=4 * m)`.
FLAT_MEMBERS = frozenset(
    {
        ("physical_object", "bounding_box"),
        ("pose_3d", "orientation"),
        ("pose_3d", "position"),
    }
)

# Members of objects that are values of a struct themselves, with their types.
NESTED_OBJECTS: Mapping[tuple[str, str], str] = {
    ("acceleration_6d", "angular"): "orientation_acceleration_3d",
    ("acceleration_6d", "translational"): "translational_acceleration_3d",
    ("behavioral_model", "bm_engine"): "bm_engine",
    ("bounding_box", "center"): "position_3d",
    ("crossing", "crossing_type"): "crossing_type",
    ("environment", "geodetic_position"): "geodetic_position_2d",
    ("physical_object", "center"): "position_3d",
    ("physical_object", "center_of_gravity"): "position_3d",
    ("physical_object", "initial_bm"): "behavioral_model",
    ("traffic_light_phase", "group"): "traffic_light_group",
    ("traffic_light_stop_line", "traffic_light_group"): "traffic_light_group",
    ("trailer", "coupler"): "hitch_coupler",
    ("vehicle", "trailer_receiver"): "hitch_receiver",
    ("velocity_6d", "angular"): "orientation_rate_3d",
    ("velocity_6d", "translational"): "translational_velocity_3d",
    ("weather", "air"): "air",
    ("weather", "clouds"): "clouds",
    ("weather", "fog"): "fog",
    ("weather", "rain"): "precipitation",
    ("weather", "snow"): "precipitation",
    ("weather", "wind"): "wind",
    ("xyz_point", "position"): "position_3d",
}

# Lists of which a constructor takes single elements, `axles={0: Axle(…)}`, with the types of these;
# `None` for plain values.
LIST_ELEMENTS: Mapping[tuple[str, str], str | None] = {
    ("traffic_participant", "intended_infrastructure"): None,
    ("vehicle", "axles"): "axle",
}


def constructor_path(lineage: Sequence[str], path: tuple[str, ...]) -> tuple[str, ...]:
    """Return a path below an object as the constructors have it, keyword by keyword."""
    is_flat = len(path) > 1 and any((type_, path[0]) in FLAT_MEMBERS for type_ in lineage)
    return path[1:] if is_flat else path


def nested_object(lineage: Sequence[str], member: str) -> str | None:
    """Return the type of a member that is a value of a struct of the library."""
    found = (NESTED_OBJECTS.get((type_, member)) for type_ in lineage)
    return next((type_ for type_ in found if type_ is not None), None)


# Nested objects of which the actor knows what a scenario does not state.
COMPLETED_MEMBERS = frozenset({("trailer", "coupler"), ("vehicle", "trailer_receiver")})


def is_completed(lineage: Sequence[str], member: str) -> bool:
    """Whether a member is a nested object of which a part may be stated."""
    return any((type_, member) in COMPLETED_MEMBERS for type_ in lineage)


def list_element(lineage: Sequence[str], member: str) -> tuple[str, ...] | None:
    """Return the type of the elements of a list that are taken one by one, if it is such a list.

    It is empty for plain values.
    """
    for type_ in lineage:
        if (type_, member) in LIST_ELEMENTS:
            element = LIST_ELEMENTS[type_, member]
            return () if element is None else (element,)
    return None

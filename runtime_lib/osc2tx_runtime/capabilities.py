"""What this runtime carries out, as plain data: for the compiler and for the documentation.

What is not listed is not there; the compiler refuses it before anything runs.
"""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from osc2tx_runtime.actions.checks import CONFLICTS, EXCLUSIVE, MOVING, NO_START
from osc2tx_runtime.actions.shaped import ShapedAction
from osc2tx_runtime.actors import (
    Actor,
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
from osc2tx_runtime.argument_rules import Rule
from osc2tx_runtime.initializer import PLACEMENT_MODIFIERS
from osc2tx_runtime.measures import RoutePosition
from osc2tx_runtime.modifiers import MAP_MODIFIERS, MODIFIERS, Modifier
from osc2tx_runtime.registry import Method, methods
from osc2tx_runtime.road_network import RoadNetwork
from osc2tx_runtime.road_parts import (
    CompoundLane,
    CompoundRoute,
    Junction,
    Lane,
    LaneSection,
    Road,
    RoadPath,
)
from osc2tx_runtime.shapes import CommonAccelerationShape, CommonLateralShape, CommonSpeedShape
from osc2tx_runtime.traffic_cycles import TrafficLightCycle, TrafficLightPhase
from osc2tx_runtime.traffic_lights import (
    TrafficLight,
    TrafficLightBulb,
    TrafficLightGroup,
)
from osc2tx_runtime.values import (
    OdrPoint,
    Path,
    RelativePathOdr,
    RelativePathPose3d,
    RelativePathSt,
    RelativeTrajectoryOdr,
    RelativeTrajectoryPose3d,
    RelativeTrajectorySt,
    RoutePoint,
    Trajectory,
    XyzPoint,
)

__all__ = ["FIELDS", "METHODS", "OBJECTS", "capabilities"]

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
        if not name.startswith("_") and name != "context"
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
    "position_3d.norm": Point.norm,
    "carla_position.ahead_of": RoutePosition.ahead_of,
    "carla_position.behind": RoutePosition.behind,
}
"""Methods of the domain model that can be read in expressions."""

FIELDS: Mapping[str, str] = {
    "physical_object.color": "color",
    "physical_object.position": "carla_position",
    "physical_object.orientation": "orientation_3d",
    "physical_object.pose": "pose_3d",
    "movable_object.speed": "speed",
    "movable_object.acceleration": "acceleration_6d",
    "movable_object.velocity": "velocity_6d",
    "acceleration_6d.translational": "translational_acceleration_3d",
    "velocity_6d.translational": "translational_velocity_3d",
    "translational_acceleration_3d.x": "acceleration",
    "translational_velocity_3d.x": "speed",
    "hitch_coupler.is_towed": "bool",
    "hitch_receiver.is_towing": "bool",
    "trailer.coupler": "hitch_coupler",
    "trailer.tow_vehicle": "vehicle",
    "vehicle.trailer_receiver": "hitch_receiver",
    "vehicle.vehicle_category": "vehicle_category",
    "environment.sun": "celestial_light_source",
    "environment.moon": "celestial_light_source",
    "environment.weather": "weather",
    "weather.air": "air",
    "weather.rain": "precipitation",
    "weather.snow": "precipitation",
    "weather.wind": "wind",
    "weather.fog": "fog",
    "weather.clouds": "clouds",
    "air.temperature": "temperature",
    "air.pressure": "pressure",
    "air.relative_humidity": "float",
    "precipitation.intensity": "speed",
    "wind.speed": "speed",
    "wind.direction": "angle",
    "fog.visual_range": "length",
    "clouds.cloudiness": "uint",
    "celestial_light_source.position": "celestial_position_2d",
    "celestial_position_2d.azimuth": "angle",
    "celestial_position_2d.elevation": "angle",
    "map.driving_rule": "driving_rule",
    "map.traffic_light_control": "list of traffic_light_cycle",
    "route_point.s": "length",
    "route_point.t": "length",
    "traffic_light.bulbs": "list of traffic_light_bulb",
    "traffic_light.group": "traffic_light_group",
    "traffic_light_bulb.state": "bulb_state",
    "traffic_light_group.bulbs": "list of traffic_light_bulb",
    "traffic_light_group.traffic_lights": "list of traffic_light",
    "xyz_point.position": "position_3d",
}
"""Members that can be read in expressions, with their types."""

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
    "orientation_3d": Orientation,
    "pose_3d": Pose,
    "position_3d": Point,
    "common_acceleration_shape": CommonAccelerationShape,
    "common_lateral_shape": CommonLateralShape,
    "common_speed_shape": CommonSpeedShape,
    "compound_lane": CompoundLane,
    "compound_route": CompoundRoute,
    "junction": Junction,
    "lane": Lane,
    "lane_section": LaneSection,
    "road": Road,
    "traffic_light": TrafficLight,
    "traffic_light_bulb": TrafficLightBulb,
    "traffic_light_cycle": TrafficLightCycle,
    "traffic_light_group": TrafficLightGroup,
    "traffic_light_phase": TrafficLightPhase,
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


def capabilities() -> dict[str, Any]:
    """Lists what there is, by kind and name, in sorted order.

    Returns:
        `actions`: `vehicle.drive` to its `arguments`, which of them are `required`, `modifiers`,
        `slots` and how it `ends`, and whether it `moves` as its modifiers say;
        `modifiers`: name to parameters; `placement`: the same for those an actor can start with;
        `methods`: `physical_object.object_distance` to parameters; `fields`: name to type;
        `exclusive`: groups of modifiers of which an action takes one;
        `objects`: actor or value type to what its constructor takes; `needed`: what it cannot do
        without; `reserved`: what actors have besides actions; `rules`: which arguments of a
        modifier or action go together, as written in `argument_rules`; `conflicts`: modifiers to
        those that they leave no room for; `no_start`: modifiers that say nothing of a start.
    """
    return {
        "actions": {f"{m.kind}.{m.name}": _action(m) for m in methods.all()},
        "modifiers": {name: _parameters(MODIFIERS[name]) for name in sorted(MODIFIERS)},
        "placement": {
            kind.name: _parameters(kind)
            for kind in sorted((*PLACEMENT_MODIFIERS, *MAP_MODIFIERS), key=lambda each: each.name)
        },
        "exclusive": [[kind.name for kind in kinds] for kinds in EXCLUSIVE],
        "methods": {name: _arguments(METHODS[name]) for name in sorted(METHODS)},
        "fields": dict(sorted(FIELDS.items())),
        "objects": {name: _keywords(OBJECTS[name]) for name in sorted(OBJECTS)},
        "needed": {name: _needed(OBJECTS[name]) for name in sorted(OBJECTS)},
        "reserved": sorted(_members()),
        "conflicts": {
            name: [kind.name for kind in kinds] for name, kinds in sorted(CONFLICTS.items())
        },
        "no_start": sorted(kind.name for kind in NO_START),
        "rules": {
            **{f"{name} while moving": _rules(MOVING[name]) for name in sorted(MOVING)},
            **{name: _rules(MODIFIERS[name].rules) for name in sorted(MODIFIERS)},
            **{f"{m.kind}.{m.name}": _rules(m.factory.rules) for m in methods.all()},
        },
    }


def _members() -> set[str]:
    """Public attributes of actors: an action of such a name would never be looked up."""
    kinds = [kind for kind in OBJECTS.values() if isinstance(kind, type)]
    actors = [kind() for kind in kinds if issubclass(kind, Actor)]
    return {name for actor in actors for name in (*dir(actor),) if not name.startswith("_")}


def _action(method: Method) -> dict[str, Any]:
    accepted = [kind.name for kind in method.factory.accepts if issubclass(kind, Modifier)]
    return {
        "arguments": _arguments(method.factory.__init__),
        "required": _required(method.factory.__init__),
        "modifiers": sorted(accepted),
        "moves": issubclass(method.factory, ShapedAction),
        "slots": list(method.slots),
        "ends": method.ends,
    }


def _arguments(function: Callable[..., Any]) -> list[str]:
    """Names of the parameters in their order, without the actor and what all have."""
    return [
        parameter.name
        for parameter in list(inspect.signature(function).parameters.values())[1:]
        if parameter.name not in ("actor", "duration", "label")
        and parameter.kind not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
    ]


def _required(function: Callable[..., Any]) -> list[str]:
    """Names of those that have no default."""
    parameters = inspect.signature(function).parameters
    names = _arguments(function)
    return [name for name in names if parameters[name].default is inspect.Parameter.empty]


def _keywords(kind: Callable[..., Any]) -> list[str]:
    return list(inspect.signature(kind).parameters)


def _rules(rules: Sequence[Rule]) -> list[dict[str, Any]]:
    """Rules as plain data, without what is not said."""
    written = (dataclasses.asdict(rule) for rule in rules)
    return [{name: value for name, value in rule.items() if value} for rule in written]


def _needed(kind: Callable[..., Any]) -> list[str]:
    parameters = inspect.signature(kind).parameters.values()
    return [p.name for p in parameters if p.default is inspect.Parameter.empty]


def _parameters(kind: type[Modifier]) -> list[str]:
    return [field.name for field in dataclasses.fields(kind)]

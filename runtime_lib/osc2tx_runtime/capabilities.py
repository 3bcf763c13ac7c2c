"""What this runtime carries out, as plain data: for the compiler and for the documentation.

What is not listed is not there; the compiler refuses it before anything runs.
"""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Callable, Mapping
from typing import Any

from osc2tx_runtime.actions.checks import EXCLUSIVE
from osc2tx_runtime.actors import (
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
from osc2tx_runtime.initializer import PLACEMENT_MODIFIERS
from osc2tx_runtime.measures import RoutePosition
from osc2tx_runtime.modifiers import MODIFIERS, Modifier
from osc2tx_runtime.registry import Method, methods
from osc2tx_runtime.road_network import RoadNetwork
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

__all__ = ["FIELDS", "METHODS", "OBJECTS", "OTHER_OBJECTS", "capabilities"]

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
    "carla_position.ahead_of": RoutePosition.ahead_of,
    "carla_position.behind": RoutePosition.behind,
}
"""Methods of the domain model that can be read in expressions."""

FIELDS: Mapping[str, str] = {
    "physical_object.position": "carla_position",
    "physical_object.orientation": "orientation_3d",
    "physical_object.pose": "pose_3d",
    "movable_object.speed": "speed",
    "movable_object.acceleration": "acceleration",
    "environment.sun": "celestial_light_source",
    "environment.moon": "celestial_light_source",
    "route_point.s": "length",
    "route_point.t": "length",
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
            Vehicle,
        )
    },
    "orientation_3d": Orientation,
    "pose_3d": Pose,
    "position_3d": Point,
}
"""Classes of actors and values, by their names in the domain model."""

OTHER_OBJECTS: Mapping[str, Callable[..., Any]] = {
    "odr_point": OdrPoint,
    "path": Path,
    "relative_path_odr": RelativePathOdr,
    "relative_path_pose_3d": RelativePathPose3d,
    "relative_path_st": RelativePathSt,
    "relative_trajectory_odr": RelativeTrajectoryOdr,
    "relative_trajectory_pose_3d": RelativeTrajectoryPose3d,
    "relative_trajectory_st": RelativeTrajectorySt,
    "route_point": RoutePoint,
    "trajectory": Trajectory,
    "xyz_point": XyzPoint,
    "trailer": Trailer,
}
"""Likewise, but generated modules cannot declare them yet: the compiler has no names for them."""


def capabilities() -> dict[str, Any]:
    """Lists what there is, by kind and name, in sorted order.

    Returns:
        `actions`: `vehicle.drive` to its `arguments`, which of them are `required`, `modifiers`,
        `slots` and how it `ends`;
        `modifiers`: name to parameters; `placement`: the same for those an actor can start with;
        `methods`: `physical_object.object_distance` to parameters; `fields`: name to type;
        `exclusive`: groups of modifiers of which an action takes one;
        `objects`: actor or value type to what its constructor takes; `other_objects`: those the
        compiler does not know yet.
    """
    return {
        "actions": {f"{m.kind}.{m.name}": _action(m) for m in methods.all()},
        "modifiers": {name: _parameters(MODIFIERS[name]) for name in sorted(MODIFIERS)},
        "placement": {
            kind.name: _parameters(kind)
            for kind in sorted(PLACEMENT_MODIFIERS, key=lambda each: each.name)
        },
        "exclusive": [[kind.name for kind in kinds] for kinds in EXCLUSIVE],
        "methods": {name: _arguments(METHODS[name]) for name in sorted(METHODS)},
        "fields": dict(sorted(FIELDS.items())),
        "objects": {name: _keywords(OBJECTS[name]) for name in sorted(OBJECTS)},
        "other_objects": {name: _keywords(OTHER_OBJECTS[name]) for name in sorted(OTHER_OBJECTS)},
    }


def _action(method: Method) -> dict[str, Any]:
    accepted = [kind.name for kind in method.factory.accepts if issubclass(kind, Modifier)]
    return {
        "arguments": _arguments(method.factory.__init__),
        "required": _required(method.factory.__init__),
        "modifiers": sorted(accepted),
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


def _parameters(kind: type[Modifier]) -> list[str]:
    return [field.name for field in dataclasses.fields(kind)]

"""What the backend knows of the runtime library, as tables.

The compiler does not import the runtime; a test compares these tables with the real thing.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

from osc2tx.light_dataclass import dataclass

API_LEVEL = 1

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
    "common_acceleration_shape": "CommonAccelerationShape",
    "common_lateral_shape": "CommonLateralShape",
    "common_speed_shape": "CommonSpeedShape",
    "odr_point": "OdrPoint",
    "compound_lane": "CompoundLane",
    "compound_route": "CompoundRoute",
    "junction": "Junction",
    "lane": "Lane",
    "lane_section": "LaneSection",
    "orientation_3d": "Orientation",
    "path": "Path",
    "Path": "RoadPath",
    "pose_3d": "Pose",
    "position_3d": "Point",
    "road": "Road",
    "relative_path_odr": "RelativePathOdr",
    "relative_path_pose_3d": "RelativePathPose3d",
    "relative_path_st": "RelativePathSt",
    "relative_trajectory_odr": "RelativeTrajectoryOdr",
    "relative_trajectory_pose_3d": "RelativeTrajectoryPose3d",
    "relative_trajectory_st": "RelativeTrajectorySt",
    "route_point": "RoutePoint",
    "traffic_light": "TrafficLight",
    "traffic_light_bulb": "TrafficLightBulb",
    "traffic_light_cycle": "TrafficLightCycle",
    "traffic_light_group": "TrafficLightGroup",
    "traffic_light_phase": "TrafficLightPhase",
    "trajectory": "Trajectory",
    "xyz_point": "XyzPoint",
}

# Paths below an object that a constructor takes under another name.
CONSTRUCTOR_KEYWORDS: Mapping[tuple[str, ...], str] = {
    ("bounding_box", "height"): "height",
    ("bounding_box", "length"): "length",
    ("bounding_box", "width"): "width",
    ("orientation", "pitch"): "pitch",
    ("orientation", "roll"): "roll",
    ("orientation", "yaw"): "yaw",
    ("position", "x"): "x",
    ("position", "y"): "y",
    ("position", "z"): "z",
}

# Members of values that are values themselves, with their types.
NESTED_OBJECTS: Mapping[tuple[str, str], str] = {
    ("xyz_point", "position"): "position_3d",
}

# Python types of plain values, by what sort of value they are.
ANNOTATIONS = {"bool": "bool", "int": "int", "float": "float", "quantity": "float"} | {
    "enum": "str",
    "string": "str",
}


def constructor_keyword(path: tuple[str, ...]) -> str:
    """Return the constructor's keyword for a member below an object."""
    return CONSTRUCTOR_KEYWORDS.get(path, ".".join(path))


@dataclass(frozen=True, slots=True)
class ActionSupport:
    """What the runtime takes for one action.

    Attributes:
        arguments: Names of its arguments.
        required: Those it cannot do without.
        modifiers: Modifiers that it honours.
        moves: Whether it moves as its modifiers say, so that they must go together.
    """

    arguments: frozenset[str]
    required: frozenset[str]
    modifiers: frozenset[str]
    moves: bool


@dataclass(frozen=True, slots=True)
class ArgumentRule:
    """What holds for the arguments of one call; see `argument_rules` of the runtime.

    Attributes:
        kind: `at_most_one` or `at_least_one` of the parameters is given, `none` of them, or each
            that is given is `at_least` some number.
        of: Parameters.
        when: It only holds if one of these is given,
        values: with one of these values,
        unless: and none of these is given.
        least: The number.
    """

    kind: str
    of: tuple[str, ...]
    when: tuple[str, ...] = ()
    values: tuple[str, ...] = ()
    unless: tuple[str, ...] = ()
    least: int = 0


@dataclass(frozen=True, slots=True)
class RuntimeSupport:
    """What the runtime carries out, by the names of the language.

    Attributes:
        actions: `vehicle.drive` to what it takes.
        modifiers: Modifier to its parameters.
        placement: The same for modifiers that place an actor.
        exclusive: Groups of modifiers of which an action takes one.
        methods: `physical_object.object_distance` to its parameters.
        fields: Members one can read, `movable_object.speed`.
        objects: Type of actor or struct to what its constructor takes.
        needed: Type of actor or struct to what its constructor cannot do without.
        conflicts: Modifiers to those that they leave no room for.
        no_start: Modifiers that say nothing of a start.
        rules: Modifier or action to which of its arguments go together.
        reserved: What actors of the runtime have besides actions.
    """

    actions: Mapping[str, ActionSupport]
    modifiers: Mapping[str, frozenset[str]]
    placement: Mapping[str, frozenset[str]]
    exclusive: tuple[frozenset[str], ...]
    methods: Mapping[str, frozenset[str]]
    fields: frozenset[str]
    objects: Mapping[str, frozenset[str]]
    needed: Mapping[str, frozenset[str]]
    conflicts: Mapping[str, frozenset[str]]
    no_start: frozenset[str]
    rules: Mapping[str, tuple[ArgumentRule, ...]]
    reserved: frozenset[str]


@cache
def runtime_support() -> RuntimeSupport:
    """Return the tables of `runtime_api.json`, which `tools/make_runtime_api.py` writes."""
    text = (files(__package__) / "runtime_api.json").read_text(encoding="utf-8")
    table = json.loads(text)

    def sets(name: str) -> dict[str, frozenset[str]]:
        return {key: frozenset(values) for key, values in table[name].items()}

    return RuntimeSupport(
        actions={
            name: ActionSupport(
                frozenset(entry["arguments"]),
                frozenset(entry["required"]),
                frozenset(entry["modifiers"]),
                entry["moves"],
            )
            for name, entry in table["actions"].items()
        },
        modifiers=sets("modifiers"),
        placement=sets("placement"),
        exclusive=tuple(frozenset(group) for group in table["exclusive"]),
        methods=sets("methods"),
        fields=frozenset(table["fields"]),
        objects=sets("objects"),
        needed=sets("needed"),
        conflicts=sets("conflicts"),
        no_start=frozenset(table["no_start"]),
        rules={
            name: tuple(ArgumentRule(**{k: _frozen(v) for k, v in rule.items()}) for rule in rules)
            for name, rules in table["rules"].items()
        },
        reserved=frozenset(table["reserved"]),
    )


def _frozen(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value

"""What the backend knows of the runtime library, as tables.

The compiler does not import the runtime; a test compares these tables with the real thing.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

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
    "vehicle": "Vehicle",
}

# Struct type of the standard library -> value class of the runtime.
STRUCT_CLASSES = {
    "orientation_3d": "Orientation",
    "pose_3d": "Pose",
    "position_3d": "Point",
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
    """What the runtime takes for one action; it cannot do without the `required` arguments."""

    arguments: frozenset[str]
    required: frozenset[str]
    modifiers: frozenset[str]


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
    """

    actions: Mapping[str, ActionSupport]
    modifiers: Mapping[str, frozenset[str]]
    placement: Mapping[str, frozenset[str]]
    exclusive: tuple[frozenset[str], ...]
    methods: Mapping[str, frozenset[str]]
    fields: frozenset[str]
    objects: Mapping[str, frozenset[str]]


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
            )
            for name, entry in table["actions"].items()
        },
        modifiers=sets("modifiers"),
        placement=sets("placement"),
        exclusive=tuple(frozenset(group) for group in table["exclusive"]),
        methods=sets("methods"),
        fields=frozenset(table["fields"]),
        objects=sets("objects"),
    )

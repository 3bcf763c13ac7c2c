"""Colloquial names, and names of other tools and languages, for names of the standard."""

from __future__ import annotations

from collections.abc import Container, Mapping

from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import Remedy, write

TYPES: Mapping[str, str] = {
    "bike": "vehicle",
    "bicycle": "vehicle",
    "boolean": "bool",
    "bus": "vehicle",
    "car": "vehicle",
    "cyclist": "vehicle",
    "direction": "side_left_right",
    "double": "float",
    "duration": "time",
    "integer": "int",
    "motorcycle": "vehicle",
    "obstacle": "stationary_object",
    "pedestrian": "person",
    "pos_3d": "position_3d",
    "str": "string",
    "truck": "vehicle",
    "robot": "vehicle",
    "van": "vehicle",
    "walker": "person",
    "weather": "environment",
}
BEHAVIORS: Mapping[str, str] = {
    "accelerate": "change_speed",
    "brake": "change_speed",
    "change_to_lane": "change_lane",
    "decelerate": "change_speed",
    "follow": "keep_time_gap",
    "lane_change": "change_lane",
    "set_position": "assign_position",
    "set_speed": "assign_speed",
    "go": "drive",
    "go_to": "change_position",
    "park": "remain_stationary",
    "stand": "remain_stationary",
    "keep_distance": "keep_space_gap",
    "overtake": "change_lane",
    "speed_change": "change_speed",
    "stop": "remain_stationary",
    "stand_still": "remain_stationary",
    "teleport": "assign_position",
}
MODIFIERS: Mapping[str, str] = {
    "follow_lane": "keep_lane",
    "gap": "distance",
    "initial_speed": "speed",
    "lane_keeping": "keep_lane",
    "lane_offset": "lateral",
    "offset": "lateral",
    "start_position": "position",
    "stay_in_lane": "keep_lane",
    "velocity": "speed",
}
# Names that are no behaviors, or no modifiers, with their replacements.
_GAP = "a gap is kept by an action: `….keep_space_gap(…)` or `….keep_time_gap(…)`"
NO_BEHAVIORS: Mapping[str, str] = {
    **dict.fromkeys(
        ("turn", "turn_left", "turn_right"),
        "a turn follows from the route: `drive` with the modifier `along`, on a route that turns",
    ),
    **dict.fromkeys(
        ("wait", "sleep", "pause"), "`wait elapsed(3s)` is a statement of its own, without an actor"
    ),
}
NO_MODIFIERS: Mapping[str, str] = {
    "ahead_of": "a parameter of `position`: `position(20m, ahead_of: …)`",
    "behind": "a parameter of `position`: `position(20m, behind: …)`",
    "in_front_of": "a parameter of `position`: `position(20m, ahead_of: …)`",
    "faster_than": "a parameter of `speed`: `speed(10kph, faster_than: …)`",
    "slower_than": "a parameter of `speed`: `speed(10kph, slower_than: …)`",
    **dict.fromkeys(("keep_distance", "keep_gap", "follow", "following"), _GAP),
    "left_of": "a parameter of `lateral` and `lane`: `lane(1, side_of: …, side: left)`",
    "right_of": "a parameter of `lateral` and `lane`: `lane(1, side_of: …, side: right)`",
    "same_lane": "`lane(same_as: …)`",
    "duration": "the duration is an argument of the invocation: `(duration: …)`",
    "repeat": "there are no loops: repeat the invocation",
    "retry": "there are no loops: repeat the invocation",
    "timeout": "the duration is an argument of the invocation: `(duration: …)`",
    "wait": "`wait` belongs inside `do`, on a line of its own",
}
# For a word several, of which a behavior or modifier has one.
PARAMETERS: Mapping[str, tuple[str, ...]] = {
    "acceleration": ("rate_peak",),
    "after": ("behind",),
    "before": ("ahead_of",),
    "deceleration": ("rate_peak",),
    "front_of": ("ahead_of",),
    "in_front_of": ("ahead_of",),
    "lanes": ("num_of_lanes",),
    "number_of_lanes": ("num_of_lanes",),
    "rate": ("rate_peak",),
    "relative_to": ("reference", "side_of"),
    "speed": ("target",),
    "target_speed": ("target", "speed"),
    "velocity": ("target", "speed"),
}
ENUM_MEMBERS: Mapping[str, str] = {
    "anti_clockwise": "counterclockwise",
    "begin": "start",
    "beginning": "start",
    "finish": "end",
    "linear": "constant",
    "sinusoidal": "smooth",
    "stop": "end",
}
UNITS: Mapping[str, str] = {
    "kmh": "kph",
    "km_h": "kph",
    "metres": "m",
    "meters": "m",
    "seconds": "s",
    "secs": "s",
    "ms2": "mpss",
    "mps2": "mpss",
    "mss": "mpss",
    "m_s": "mps",
    "degrees": "deg",
}
MEMBERS: Mapping[str, str] = {
    "distance": "object_distance(…)",
    "distance_to": "object_distance(…)",
    "get_distance": "object_distance(…)",
    "get_speed": "speed",
    "heading": "pose.orientation.yaw",
    "location": "pose.position",
    "thw": "time_headway(…)",
    "ttc": "time_to_collision(…)",
    "velocity": "speed",
    "x": "pose.position.x",
    "y": "pose.position.y",
    "z": "pose.position.z",
    "yaw": "pose.orientation.yaw",
}
LIST_WORDS: Mapping[str, str] = {"len": "size", "length": "size", "contains": "has"}
NAMES: Mapping[str, str] = {
    "True": "true",
    "TRUE": "true",
    "False": "false",
    "FALSE": "false",
    "NaN": "nan",
    "Inf": "inf",
}
NOTHING = frozenset({"None", "null", "NULL", "nil", "undefined"})
# Units as quotients: the unit of the number, and the name that the text divides by.
QUOTIENTS: Mapping[tuple[str, str], str] = {
    ("km", "h"): "kph",
    ("m", "s"): "mps",
    ("m", "s2"): "mpss",
    ("mi", "h"): "mph",
    ("mile", "h"): "mph",
    ("mm", "h"): "mmph",
}

# Actions of other tools that write something.
OUTPUT = frozenset({"echo", "log", "print", "write"})

# Event conditions, which are no methods: they are used alone behind `wait`, `until`, `on` and `is`.
CONDITIONS = frozenset({"rise", "fall", "elapsed", "every"})


def fitting_word(word: str, known: Container[str]) -> str | None:
    """Return the parameter that a word denotes, of the given ones."""
    return next((name for name in PARAMETERS.get(word, ()) if name in known), None)


def plain_word(written: Span, table: Mapping[str, str]) -> Remedy | None:
    """Return the remedy that replaces a word by the one of the standard.

    It is safe if both words denote the same value; parameters of an action may differ.
    """
    if written.text not in table:
        return None
    return write(written, table[written.text], is_safe=table is NAMES or table is UNITS)

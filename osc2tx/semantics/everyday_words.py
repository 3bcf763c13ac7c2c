"""Words that people, and other tools and languages, use for what the standard calls otherwise."""

from __future__ import annotations

from collections.abc import Mapping

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
    "speed_change": "change_speed",
    "stop": "remain_stationary",
    "stand_still": "remain_stationary",
    "teleport": "assign_position",
}
NAMES: Mapping[str, str] = {"True": "true", "False": "false", "NaN": "nan", "Inf": "inf"}
# Units of speed as quotients: the unit of the number, and the name that the text divides by.
SPEEDS: Mapping[tuple[str, str], str] = {
    ("km", "h"): "kph",
    ("m", "s"): "mps",
    ("mi", "h"): "mph",
    ("mile", "h"): "mph",
    ("mm", "h"): "mmph",
}

# Event conditions, which are no methods: they stand alone behind `wait`, `until`, `on` and `is`.
CONDITIONS = frozenset({"rise", "fall", "elapsed", "every"})


def plain_word(word: str, table: Mapping[str, str]) -> str | None:
    """Return the line of help that names the standard's word for another one."""
    return f"write `{table[word]}`" if word in table else None

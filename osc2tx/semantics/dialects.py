"""Dialects as data: a prelude of declarations and a set of relaxed rules (design D1)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import TYPE_CHECKING

from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx.semantics.symbols import UnitSymbol


@dataclass(frozen=True, slots=True)
class Dialect:
    """A set of accepted deviations from the standard.

    Attributes:
        name: Its name for `--dialect`.
        prelude: Library text that is loaded on top of the standard library.
        relaxed: Codes of its relaxations; each is a warning 6xx.
        library_files: File names that denote the library if no such file exists.
        unprefixed_library: Whether library names need neither prefix nor `use`.
    """

    name: str
    prelude: str | None = None
    relaxed: frozenset[str] = frozenset()
    library_files: frozenset[str] = frozenset()
    unprefixed_library: bool = False


LIBRARY_FILES = frozenset({"domain.osc", "types.osc", "standard.osc"})
RUNNER_FILE = "basic.osc"  # where ScenarioRunner declares its types; denotes the prelude

ASAM = Dialect("asam")
CARLA = Dialect(
    "carla",
    prelude="dialects/carla.osc",
    relaxed=frozenset({"OSC111", *(f"OSC{number}" for number in range(601, 629))}),
    library_files=LIBRARY_FILES | {RUNNER_FILE},
    unprefixed_library=True,
)
DIALECTS: Mapping[str, Dialect] = {dialect.name: dialect for dialect in (ASAM, CARLA)}


@dataclass(frozen=True, slots=True)
class PreludeHint:
    """The help of dialect `asam` for a name that only a prelude declares."""

    dialect: str
    instead: str


PRELUDE_MEMBERS: Mapping[str, PreludeHint] = {
    "name": PreludeHint("carla", "the name of the field itself names the object"),
    "model": PreludeHint("carla", "use `geometry_reference` for a 3D model"),
    "position": PreludeHint(
        "carla", "`pose.position` is the position, `road_distance(…)` a distance along the road"
    ),
}
PRELUDE_PARAMETERS: Mapping[tuple[str, str], PreludeHint] = {
    **{
        (action, "path"): PreludeHint("carla", "the modifier `along()` names a route")
        for action in ("drive", "walk")
    },
    ("speed", "rate_profile"): PreludeHint("carla", "use `shape:` with a `common_speed_shape`"),
    ("speed", "rate_peak"): PreludeHint("carla", "use `shape:` with a `common_speed_shape`"),
    **{
        ("position", axis): PreludeHint("carla", "use `at_point:` with a `position_3d`")
        for axis in ("x", "y", "z", "h", "frame")
    },
}
PRELUDE_BEHAVIORS: Mapping[tuple[str, str], PreludeHint] = {
    ("vehicle", "set_lights"): PreludeHint("carla", "it has no action for lights"),
    ("stationary_object", "assign_position"): PreludeHint(
        "carla", "place the object with the modifier `location()`"
    ),
}


@dataclass(frozen=True, slots=True)
class ParameterAlias:
    """The meaning of another name of a parameter.

    Attributes:
        parameter: The standard's parameter, which takes the value.
        implied: Another parameter and its enum member.
        note: A difference that is easily missed.
    """

    parameter: str
    implied: tuple[str, str] | None = None
    note: str | None = None

    @property
    def written_out(self) -> str:
        """How the standard writes it."""
        further = f", {self.implied[0]}: {self.implied[1]}" if self.implied else ""
        return f"{self.parameter}: …{further}"


# Arguments of forks of ScenarioRunner for actions of the library, and why they are not needed here.
LEFT_OUT: Mapping[tuple[str, str], str] = {
    ("drive", "adjust"): "an actor follows its path as it is",
    ("walk", "adjust"): "an actor follows its path as it is",
}

# Other names for names of the standard. Every dialect uses them for help; a dialect that relaxes
# OSC612 to OSC615 and OSC619 accepts them.
TYPE_ALIASES: Mapping[str, str] = {
    "velocity": "speed",
    "distance": "length",
    "angular_speed": "angular_rate",
}
UNIT_ALIASES: Mapping[str, str] = {"kphps": "kmphps"}
PARAMETER_ALIASES: Mapping[tuple[str, str], ParameterAlias] = {
    **{
        (modifier, f"{side}_of"): ParameterAlias("side_of", ("side", side))
        for modifier in ("lane", "lateral")
        for side in ("left", "right")
    },
    ("change_lane", "lane_changes"): ParameterAlias("lane"),
    ("change_speed", "desired_speed"): ParameterAlias(
        "speed", note="it is a difference to the present speed, not the target speed"
    ),
    ("change_speed", "delta"): ParameterAlias("speed"),
    ("assign_speed", "target"): ParameterAlias("speed"),
    ("assign_acceleration", "target"): ParameterAlias("acceleration"),
    ("assign_orientation", "target"): ParameterAlias("orientation"),
    ("air", "atmospheric_pressure"): ParameterAlias("pressure"),
    **{
        (modifier, "measured_by"): ParameterAlias("measure_by")
        for modifier in ("lateral", "yaw", "orientation")
    },
}
ENUM_MEMBER_ALIASES: Mapping[tuple[str, str], str] = {("lane_change_side", "same_as"): "same"}
MEMBER_ALIASES: Mapping[tuple[str, str], str] = {
    **{
        (owner, short): long
        for owner in ("geodetic_position_2d", "geodetic_point")
        for short, long in (("lat", "latitude"), ("lon", "longitude"))
    },
}
BEHAVIOR_ALIASES: Mapping[tuple[str, str], str] = {("environment", "cloud"): "clouds"}

# Names of events that ScenarioRunner raises itself, with the parameters that make them its own.
RUNNER_EVENTS: Mapping[str, frozenset[str]] = {
    "near_collision": frozenset({"other_car", "distance"}),
    "drive_distance": frozenset({"other_car", "distance"}),
}
# Texts by which ScenarioRunner names a quantity of an actor, `"<actor>_speed"`: suffix to type.
QUANTITY_TEXTS: Mapping[str, str] = {"_speed": "speed"}


@dataclass(slots=True)
class Relaxations:
    """The relaxations of one run so far; each kind is reported once per file.

    Attributes:
        dialect: The dialect of the file.
        reported: File, code and key of the warnings that were given.
        disputed: Units that a program declares again with another value.
    """

    dialect: Dialect
    reported: set[tuple[str, str, str]] = field(default_factory=set)
    disputed: dict[str, UnitSymbol] = field(default_factory=dict)

    def is_new(self, code: str, file: str, key: str) -> bool:
        """Note a relaxation; whether it was not reported before."""
        entry = (file, code, key)
        if entry in self.reported:
            return False
        self.reported.add(entry)
        return True

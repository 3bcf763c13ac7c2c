"""Dialects as data: a prelude of declarations and a set of relaxed rules (design D1)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Dialect:
    """A way of writing scenarios that one meets.

    Attributes:
        name: What `--dialect` calls it.
        prelude: Library text that is loaded on top of the standard library.
        relaxed: Codes of the relaxations that it grants; each is a warning 6xx.
        library_files: File names that stand for the library if no such file exists.
        unprefixed_library: Whether library names need neither prefix nor `use`.
    """

    name: str
    prelude: str | None = None
    relaxed: frozenset[str] = frozenset()
    library_files: frozenset[str] = frozenset()
    unprefixed_library: bool = False


LIBRARY_FILES = frozenset({"domain.osc", "types.osc", "standard.osc"})

ASAM = Dialect("asam")
CARLA = Dialect(
    "carla",
    prelude="dialects/carla.osc",
    relaxed=frozenset(f"OSC60{digit}" for digit in range(1, 10)),
    library_files=LIBRARY_FILES,
    unprefixed_library=True,
)
DIALECTS: Mapping[str, Dialect] = {dialect.name: dialect for dialect in (ASAM, CARLA)}


@dataclass(frozen=True, slots=True)
class PreludeHint:
    """What `asam` says about a name that only a prelude declares."""

    dialect: str
    instead: str


PRELUDE_MEMBERS: Mapping[str, PreludeHint] = {
    "name": PreludeHint("carla", "the name of the field itself names the object"),
    "model": PreludeHint("carla", "use `geometry_reference` for a 3D model"),
    "position": PreludeHint(
        "carla", "`pose.position` is the place, `road_distance(…)` a distance along the road"
    ),
}
PRELUDE_PARAMETERS: Mapping[tuple[str, str], PreludeHint] = {
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


@dataclass(slots=True)
class Relaxations:
    """What one run has relaxed so far; each kind is reported once per file.

    Attributes:
        dialect: The dialect in force.
        reported: File, code and key of the warnings that were given.
    """

    dialect: Dialect
    reported: set[tuple[str, str, str]] = field(default_factory=set)

    def is_new(self, code: str, file: str, key: str) -> bool:
        """Note a relaxation; whether it was not reported before."""
        entry = (file, code, key)
        if entry in self.reported:
            return False
        self.reported.add(entry)
        return True

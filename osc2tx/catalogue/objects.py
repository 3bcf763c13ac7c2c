"""What scenarios read and make: methods, fields, actors and values of the runtime."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class ObjectTables:
    """The runtime's items besides actions and modifiers, by the names of the language.

    Attributes:
        methods: `physical_object.object_distance` to its parameters.
        fields: Members one can read, `movable_object.speed`.
        objects: Type of actor or struct to what its constructor takes.
        needed: Type of actor or struct to what its constructor cannot do without.
        unknown: Members of actors that only the scenario can say.
        reserved: What actors of the runtime have besides actions.
        declared: Structs that are objects as actors are, not values, to what these have.
        lane_bound: Types of actors that follow lanes.
        enums: Names of the types of the library's enums.
        units: Names of the library's units.
    """

    methods: Mapping[str, frozenset[str]]
    fields: frozenset[str]
    objects: Mapping[str, frozenset[str]]
    needed: Mapping[str, frozenset[str]]
    unknown: frozenset[str]
    reserved: frozenset[str]
    declared: Mapping[str, frozenset[str]]
    lane_bound: frozenset[str]
    enums: frozenset[str]
    units: frozenset[str]


@cache
def object_tables() -> ObjectTables:
    """Return the tables."""
    table = json.loads(Path(__file__).with_name("objects.json").read_text(encoding="utf-8"))

    def sets(name: str) -> dict[str, frozenset[str]]:
        return {key: frozenset(values) for key, values in table[name].items()}

    return ObjectTables(
        methods=sets("methods"),
        fields=frozenset(table["fields"]),
        objects=sets("objects"),
        needed=sets("needed"),
        unknown=frozenset(table["unknown"]),
        reserved=frozenset(table["reserved"]),
        declared=sets("declared"),
        lane_bound=frozenset(table["lane_bound"]),
        enums=frozenset(table["enums"]),
        units=frozenset(table["units"]),
    )

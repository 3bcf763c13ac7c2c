"""Facts about the standard library that its declarations do not state, as tables.

Sections are those of OpenSCENARIO DSL 2.2. A test holds the tables against the library, and what
the runtime says of the actions that it has.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import supertypes

# Actions that go on until something else ends them: actor type, action -> section.
OPEN_ENDED: Mapping[tuple[str, str], str] = MappingProxyType(
    {
        ("movable_object", "move"): "8.8.2.3",
        ("movable_object", "remain_stationary"): "8.8.2.10",
        ("movable_object", "keep_speed"): "8.8.2.13",
        ("movable_object", "keep_acceleration"): "8.8.2.15",
        ("vehicle", "drive"): "8.8.3.1",
        ("vehicle", "follow_lane"): "8.8.3.2",
        ("vehicle", "keep_time_gap"): "8.8.3.5",
        ("vehicle", "keep_space_gap"): "8.8.3.7",
        ("vehicle", "keep_time_headway"): "8.8.3.9",
        ("vehicle", "keep_space_headway"): "8.8.3.11",
        ("person", "walk"): "8.8.4.1",
        ("animal", "walk"): "8.8.4.1",  # the text has it, the types do not
        ("traffic_light_controller", "play_cycles"): "8.15.9.7.1",
    }
)

# Modifiers that bound an open-ended action: it is over when their way is.
BOUNDING_MODIFIERS: Mapping[str, str] = MappingProxyType(
    {"along": "8.9.11", "along_trajectory": "8.9.12", "distance": "8.9.13"}
)

# Actions that take no time.
INSTANT: Mapping[tuple[str, str], str] = MappingProxyType(
    {
        ("movable_object", "assign_position"): "8.8.2.4",
        ("movable_object", "assign_orientation"): "8.8.2.5",
        ("movable_object", "assign_speed"): "8.8.2.6",
        ("movable_object", "assign_acceleration"): "8.8.2.7",
        ("environment", "air"): "8.11.2",
        ("environment", "rain"): "8.11.3",
        ("environment", "snow"): "8.11.4",
        ("environment", "wind"): "8.11.5",
        ("environment", "fog"): "8.11.6",
        ("environment", "clouds"): "8.11.7",
        ("environment", "assign_celestial_position"): "8.11.8",
        ("traffic_light_controller", "set_bulb_state"): "8.15.9.1.1",
        ("traffic_light_controller", "set_state"): "8.15.9.2.1",
        ("traffic_light_controller", "set_semantic_state"): "8.15.9.3.1",
        ("traffic_light_controller", "set_group_bulb_state"): "8.15.9.4.1",
        ("traffic_light_controller", "set_group_state"): "8.15.9.5.1",
        ("traffic_light_controller", "set_group_semantic_state"): "8.15.9.6.1",
        ("vehicle", "set_lights"): "",  # of dialect carla
        ("stationary_object", "assign_position"): "",  # of dialect carla
    }
)

# Actions whose arguments say where the actor is.
PLACING_ACTIONS: Mapping[str, str] = MappingProxyType(
    {
        "assign_position": "8.8.2.4",
        "replay_path": "8.8.2.8",
        "replay_trajectory": "8.8.2.9",
        "follow_path": "8.8.2.16",
        "follow_trajectory": "8.8.2.17",
    }
)

# Modifiers that say where the actor is.
PLACING_MODIFIERS: Mapping[str, str] = MappingProxyType(
    {
        "position": "8.9.2",
        "lateral": "8.9.8",
        "along": "8.9.11",
        "along_trajectory": "8.9.12",
        "lane": "8.9.14",
        "location": "8.7.4.1.1",
    }
)

# Modifiers that say how fast the actor is, or where it is at each time.
PACING_MODIFIERS: Mapping[str, str] = MappingProxyType(
    {
        "keep_position": "8.9.3",
        "speed": "8.9.4",
        "change_speed": "8.9.5",
        "keep_speed": "8.9.6",
        "acceleration": "8.9.7",
        "along_trajectory": "8.9.12",
        "distance": "8.9.13",
    }
)

# Actions that leave the speed to their modifiers.
UNPACED_ACTIONS = frozenset({"move", "drive", "walk"})

# Parameters that only state an order; the amount stands in one of the others, or stays open.
RELATIONS: Mapping[tuple[str, str], frozenset[str]] = MappingProxyType(
    {
        ("speed", "faster_than"): frozenset({"speed", "speed_range"}),
        ("speed", "slower_than"): frozenset({"speed", "speed_range"}),
        ("position", "ahead_of"): frozenset({"distance", "time", "distance_range", "time_range"}),
        ("position", "behind"): frozenset({"distance", "time", "distance_range", "time_range"}),
    }
)

# Overlaps of `parallel` that leave start and end of the members open (§7.3.13.2).
LOOSE_OVERLAPS = frozenset({"initial", "final", "inside", "full", "any"})


def is_open_ended(action: sym.ActionSymbol) -> bool:
    """Whether an action, or one that it derives from, goes on until something ends it."""
    return _is_listed(action, OPEN_ENDED)


def is_instant(action: sym.ActionSymbol) -> bool:
    """Whether an action takes no time."""
    return _is_listed(action, INSTANT)


def _is_listed(action: sym.ActionSymbol, table: Mapping[tuple[str, str], str]) -> bool:
    return any(
        isinstance(ancestor, sym.ActionSymbol)
        and ancestor.origin != "user"
        and ancestor.actor is not None
        and (ancestor.actor.name, ancestor.name) in table
        for ancestor in supertypes(action)
    )


def is_library_actor(actor: sym.ActorSymbol, name: str) -> bool:
    """Whether an actor type is the library's of that name, or derives from it."""
    return any(a.name == name and a.origin != "user" for a in supertypes(actor))

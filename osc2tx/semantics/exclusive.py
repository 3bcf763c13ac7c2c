"""Parameters of library modifiers and actions that exclude each other (§8.9.1.3)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.symbols import (
    ActionSymbol,
    FieldSymbol,
    ModifierSymbol,
    ParameterSymbol,
    Symbol,
)
from osc2tx.syntax import ast

EXCLUSIVE: Mapping[str, Sequence[frozenset[str]]] = {
    "position": (
        frozenset({"distance", "time", "distance_range", "time_range", "at_point", "x"}),
        frozenset({"ahead_of", "behind", "ahead_of_point", "behind_point", "at_point"}),
    ),
    "speed": (
        frozenset({"speed", "speed_range"}),
        frozenset({"faster_than", "slower_than", "same_as"}),
    ),
    "change_speed": (frozenset({"speed", "speed_range"}),),
    "acceleration": (frozenset({"acceleration", "acceleration_range"}),),
    "lateral": (frozenset({"distance", "distance_range"}),),
    "yaw": (frozenset({"angle", "angle_range"}),),
    "lane": (frozenset({"side_of", "same_as", "from"}),),
    "assign_position": (frozenset({"position", "route_point", "odr_point"}),),
    "change_position": (frozenset({"target_position", "target_st", "target_odr", "target_xyz"}),),
    "follow_lane": (frozenset({"offset", "offset_range"}),),
    "follow_path": (frozenset({"absolute", "relative"}),),
    "follow_trajectory": (frozenset({"absolute", "relative"}),),
    "replay_path": (frozenset({"absolute", "relative"}),),
    "replay_trajectory": (frozenset({"absolute", "relative"}),),
}


def check_exclusive(
    r: Resolution,
    callee: Symbol,
    pairs: Sequence[tuple[FieldSymbol | ParameterSymbol, ast.Expression]],
) -> None:
    """Report arguments of a library modifier or action of which only one may be given."""
    if not isinstance(callee, ModifierSymbol | ActionSymbol) or callee.origin == "user":
        return
    for group in EXCLUSIVE.get(callee.name, ()):
        given = [(p.name, value) for p, value in pairs if p.name in group]
        if len(given) > 1:
            (first, _), (second, value) = given[:2]
            r.report(
                "OSC408",
                value.span,
                f"`{callee.name}` takes `{first}` or `{second}`, not both",
            )

"""Which modifiers of an action go together: data that the compiler reads as well.

A modifier is of a *sort* by what is said with it: a `speed` with `direction: lateral` is another
thing than one along the road.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from osc2tx_runtime.domain.modifiers import (
    Acceleration,
    Along,
    AlongTrajectory,
    ChangeLane,
    ChangeSpeed,
    Distance,
    KeepLane,
    KeepPosition,
    KeepSpeed,
    Lane,
    Lateral,
    Modifier,
    Orient,
    Position,
    Speed,
    Yaw,
)
from osc2tx_runtime.language.argument_rules import Rule, at_least_one, none_of

__all__ = [
    "CONFLICTS",
    "CONTRADICTIONS",
    "EXCLUSIVE",
    "MOVING",
    "NO_START",
    "ON_LANES",
    "SORTS",
    "STARTING",
    "Sort",
    "sorts_of",
]


@dataclass(frozen=True, slots=True)
class Sort:
    """Modifiers with something in common.

    Attributes:
        name: Of the sort.
        modifier: Name in the DSL.
        given: Parameters of which one is given,
        value: with this value; empty: with any.
        lacks: None of these is given.
    """

    name: str
    modifier: str
    given: tuple[str, ...] = ()
    value: str = ""
    lacks: tuple[str, ...] = ()

    def has(self, name: str, given: Mapping[str, Any]) -> bool:
        """Whether a modifier with these arguments is of the sort."""
        if name != self.modifier or any(each in given for each in self.lacks):
            return False
        values = [given[each] for each in self.given if each in given]
        return not self.given or any(not self.value or value == self.value for value in values)


SORTS = (
    Sort("lateral speed", "speed", given=("direction",), value="lateral"),
    Sort("place beside an actor", "lateral", given=("side_of",)),
    Sort("place on the lane", "position", lacks=("ahead_of", "behind")),
    Sort("course of the place", "position", given=("shape",)),
    Sort("course along a route", "along", given=("shape",)),
    Sort("course of the way", "distance", given=("shape",)),
)

# Of each group an action takes one; what stands in two groups speaks of both things.
EXCLUSIVE: tuple[tuple[type[Modifier], ...], ...] = (
    (ChangeSpeed, KeepSpeed, Position, KeepPosition, AlongTrajectory),
    (Lane, ChangeLane, KeepLane, Yaw, Orient, Along, AlongTrajectory),
    (Lateral, Yaw, Orient, Along, AlongTrajectory),
)

_SPEEDS: tuple[type[Modifier], ...] = (Speed, Acceleration, *EXCLUSIVE[0], Distance)

# What a modifier leaves no room for, by its name or sort, though those others go together.
CONFLICTS: Mapping[str, tuple[type[Modifier], ...]] = {
    "acceleration": EXCLUSIVE[0],
    "speed": EXCLUSIVE[0],
    "lateral speed": (Lane, Lateral, ChangeLane, KeepLane, Yaw, Orient, Along),
    "place beside an actor": (Lane, ChangeLane, KeepLane),
    "place on the lane": (Along,),
    "course of the place": _SPEEDS,
    "course along a route": _SPEEDS,
    "course of the way": _SPEEDS,
}

# Arguments that contradict each other in the modifiers of one action.
CONTRADICTIONS = ((("movement_mode", "monotonous"), ("option", "prefer_non_physical")),)

# What a modifier needs in an action, unlike as a start.
MOVING: Mapping[str, tuple[Rule, ...]] = {
    "position": (
        at_least_one("ahead_of", "behind", "shape", when=["at"], values=["all"]),
        none_of("at_point", when=["project_on_route"], values=["false"]),
    )
}

# What says nothing about a start, in any modifier.
STARTING: tuple[Rule, ...] = (none_of("shape", when=["at"], values=["start"]),)

NO_START: dict[type[Modifier], str] = {
    ChangeSpeed: "cannot change the speed at the start",
    ChangeLane: "cannot change the lane at the start",
    Distance: "is covered during the action, not at its start",
    Along: "does not take effect at the start; use position(at: start) for a place on it",
    AlongTrajectory: "does not take effect at the start; use position(at: start)",
}

ON_LANES: tuple[type[Modifier], ...] = (Lane, Lateral, ChangeLane, KeepLane, Position)
"""What is only for actors that follow lanes, but for the start."""


def sorts_of(modifier: Modifier) -> frozenset[str]:
    """The name of a modifier, or what it is instead, and the sorts it is of."""
    given = modifier.given()
    found = {sort.name for sort in SORTS if sort.has(modifier.name, given)}
    return frozenset(found) if "lateral speed" in found else frozenset((modifier.name, *found))

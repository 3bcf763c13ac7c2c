"""Which modifiers go together, checked before anything runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from osc2tx_runtime.action import Action
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.modifiers import (
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

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["EXCLUSIVE", "check_modifiers"]

ModifierT = TypeVar("ModifierT", bound=Modifier)

# Of each group an action takes one; what stands in two groups speaks of both things.
EXCLUSIVE: tuple[tuple[type[Modifier], ...], ...] = (
    (ChangeSpeed, KeepSpeed, Position, KeepPosition, AlongTrajectory),
    (Lane, ChangeLane, KeepLane, Yaw, Orient, Along, AlongTrajectory),
    (Lateral, Yaw, Orient, Along, AlongTrajectory),
)

_USE_ASSIGN = "does not take effect at the start of a movement; use {} before it"
_NO_START: dict[type[Modifier], str] = {
    Position: _USE_ASSIGN.format("assign_position"),
    Lane: _USE_ASSIGN.format("assign_position"),
    Lateral: _USE_ASSIGN.format("assign_position"),
    ChangeSpeed: "cannot change the speed at the start",
    ChangeLane: "cannot change the lane at the start",
}


def check_modifiers(action: Action) -> None:
    """Refuses modifiers that contradict each other, or have no effect here.

    Raises:
        UnsupportedError: They cannot be carried out together, or at that time.
        ScenarioError: A modifier is given twice.
    """
    modifiers, name = action.modifiers, action.action_name
    whole_way = (Distance,) if action.duration is not None else ()
    along = [m for m in modifiers if isinstance(m, Speed) and m.direction == "longitudinal"]
    across = [m for m in modifiers if isinstance(m, Speed) and m.direction == "lateral"]
    rest = [m for m in modifiers if not isinstance(m, Speed)]
    _alone(name, along, rest, EXCLUSIVE[0])
    _alone(name, _of(rest, Acceleration), rest, EXCLUSIVE[0])
    if whole_way:
        _alone(name, [*along, *_of(rest, Acceleration)], rest, whole_way)
    for kinds in EXCLUSIVE:
        _exclusive(name, rest, *kinds)
    _alone(name, across, rest, (Lane, Lateral, ChangeLane, KeepLane, Yaw, Orient, Along))
    _at(action, along)
    for modifier in rest:
        if sum(type(other) is type(modifier) for other in rest) > 1:
            raise ScenarioError(f"{name} has {modifier.name} twice", action.source or None)
    _one_measure(action)


def _of(modifiers: Sequence[Modifier], kind: type[ModifierT]) -> list[ModifierT]:
    return [modifier for modifier in modifiers if isinstance(modifier, kind)]


def _alone(
    name: str,
    first: Sequence[Modifier],
    others: Sequence[Modifier],
    kinds: tuple[type[Modifier], ...],
) -> None:
    for other in others:
        if first and isinstance(other, kinds) and other not in first:
            _refuse(name, first[0], other)


def _exclusive(name: str, modifiers: Sequence[Modifier], *kinds: type[Modifier]) -> None:
    found = [modifier for modifier in modifiers if isinstance(modifier, kinds)]
    for other in found[1:]:
        if type(other) is not type(found[0]):
            _refuse(name, found[0], other)


def _refuse(name: str, one: Modifier, other: Modifier) -> None:
    raise UnsupportedError(f"{name}: {one.name} and {other.name} speak of the same thing; give one")


def _at(action: Action, speeds: Sequence[Speed]) -> None:
    for modifier in action.modifiers:
        why = _NO_START.get(type(modifier))
        if why is not None and getattr(modifier, "at", "all") == "start":
            raise UnsupportedError(f"{action.action_name}: {modifier.name} {why}")
    for sideways in _of(action.modifiers, Speed):
        whole = sideways.at == "all" and sideways.reference is None
        if sideways.direction == "lateral" and not whole:
            raise UnsupportedError(
                f"{action.action_name}: a lateral speed holds all the time, and has no reference"
            )
    lasting = [speed for speed in speeds if speed.at != "start"]
    if len(lasting) > 1 or len(speeds) - len(lasting) > 1:
        raise ScenarioError(
            f"{action.action_name} has two speeds for one time", action.source or None
        )
    for speed in lasting:
        shaped = speed.rate_profile != "none" or speed.rate_peak is not None
        if speed.reference is not None and shaped:
            raise UnsupportedError(
                f"{action.action_name}: a speed relative to an actor takes no rate"
            )
    position = _of(action.modifiers, Position)
    if position and position[0].absolute:
        raise UnsupportedError(
            f"{action.action_name}: position at a point is a start; to go there use"
            " change_position"
        )
    if position and position[0].reference is None and position[0].at != "end":
        raise UnsupportedError(
            f"{action.action_name}: position needs ahead_of or behind an actor while it moves, or"
            " at: end; for a start use assign_position"
        )


def _one_measure(action: Action) -> None:
    name = action.action_name
    lanes = any(isinstance(other, Lane | ChangeLane | KeepLane) for other in action.modifiers)
    for modifier in _of(action.modifiers, Lateral):
        beside = modifier.side_of is not None
        if not beside and modifier.measure_by == "closest":
            raise UnsupportedError(f"{name}: lateral measured by closest needs side_of")
        if beside and lanes:
            raise UnsupportedError(f"{name}: lateral beside an actor leaves no room for a lane")

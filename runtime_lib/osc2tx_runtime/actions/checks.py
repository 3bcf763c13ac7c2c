"""Which modifiers go together, checked before anything runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from osc2tx_runtime.argument_rules import Rule, at_least_one, check_arguments
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
    from collections.abc import Mapping, Sequence

    from .shaped import ShapedAction

__all__ = ["CONFLICTS", "EXCLUSIVE", "MOVING", "NO_START", "check_modifiers", "check_options"]

ModifierT = TypeVar("ModifierT", bound=Modifier)

# Of each group an action takes one; what stands in two groups speaks of both things.
EXCLUSIVE: tuple[tuple[type[Modifier], ...], ...] = (
    (ChangeSpeed, KeepSpeed, Position, KeepPosition, AlongTrajectory),
    (Lane, ChangeLane, KeepLane, Yaw, Orient, Along, AlongTrajectory),
    (Lateral, Yaw, Orient, Along, AlongTrajectory),
)

# What a modifier leaves no room for, though those others go together.
CONFLICTS: Mapping[str, tuple[type[Modifier], ...]] = {
    "acceleration": EXCLUSIVE[0],
    "speed": EXCLUSIVE[0],
    "lateral speed": (Lane, Lateral, ChangeLane, KeepLane, Yaw, Orient, Along),
}

# What a modifier needs in an action, unlike as a start.
MOVING: Mapping[str, tuple[Rule, ...]] = {
    "position": (at_least_one("ahead_of", "behind", when=["at"], values=["all"]),)
}

NO_START: dict[type[Modifier], str] = {
    ChangeSpeed: "cannot change the speed at the start",
    ChangeLane: "cannot change the lane at the start",
    Distance: "is covered during the action, not at its start",
    Along: "does not take effect at the start; use position(at: start) for a place on it",
    AlongTrajectory: "does not take effect at the start; use position(at: start)",
}


def check_modifiers(action: ShapedAction) -> None:
    """Refuses modifiers that contradict each other, or have no effect here.

    Raises:
        UnsupportedError: They cannot be carried out together, or at that time.
        ScenarioError: A modifier is given twice.
    """
    lasting, name = action.lasting, action.action_name
    along = [m for m in lasting if isinstance(m, Speed) and m.direction == "longitudinal"]
    across = [m for m in action.modifiers if isinstance(m, Speed) and m.direction == "lateral"]
    rest = [m for m in lasting if not isinstance(m, Speed)]
    room = _room_for_place(action, along)
    for first in (along, _of(rest, Acceleration)):
        kinds = CONFLICTS[first[0].name] if first else ()
        _alone(name, first, rest, tuple(k for k in kinds if k is not Position or not room))
    if action.duration is not None or action.end_is_known:
        if not _arrives(action, along):
            _alone(name, along, rest, (Distance,))
        _alone(name, _of(rest, Acceleration), rest, (Distance,))
    for kinds in EXCLUSIVE:
        _exclusive(name, rest, *kinds)
    _alone(name, across, rest, CONFLICTS["lateral speed"])
    _twice(action, rest)
    _at(action, across)
    _two_speeds(action, along)
    _position(action, _of(rest, Position))
    _one_measure(name, rest)


def _room_for_place(action: ShapedAction, speeds: Sequence[Speed]) -> bool:
    """Whether there can be a place beside speeds and accelerations: at the end, when it comes."""
    ends = all(position.at == "end" for position in _of(action.lasting, Position))
    rates = [m.at for m in (*speeds, *_of(action.lasting, Acceleration))]
    return ends and (_arrives(action, speeds) or all(at == "all" for at in rates))


def _arrives(action: ShapedAction, speeds: Sequence[Speed]) -> bool:
    """Whether a place and a speed at the end of a known time are asked for."""
    return (
        action.end_is_known
        and all(speed.at == "end" and not speed.shaped for speed in speeds)
        and all(position.at == "end" for position in _of(action.lasting, Position))
    )


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


def _twice(action: ShapedAction, lasting: Sequence[Modifier]) -> None:
    starts = [m for m in action.modifiers if m not in action.lasting]
    for group in (lasting, starts):
        for modifier in group:
            if sum(type(other) is type(modifier) for other in group) > 1:
                raise ScenarioError(f"{action.action_name} has {modifier.name} twice")


def _at(action: ShapedAction, across: Sequence[Speed]) -> None:
    for modifier in action.modifiers:
        why = NO_START.get(type(modifier))
        if why is not None and getattr(modifier, "at", "all") == "start":
            raise UnsupportedError(f"{action.action_name}: {modifier.name} {why}")
    for speed in across:
        if speed.at != "all" or speed.reference is not None or speed.shaped:
            raise UnsupportedError(
                f"{action.action_name}: a lateral speed holds all the time, and has no reference"
            )


def _two_speeds(action: ShapedAction, lasting: Sequence[Speed]) -> None:
    name = action.action_name
    if len(lasting) > 1:
        raise ScenarioError(f"{name} has two speeds for one time", action.source or None)
    for speed in lasting:
        if speed.reference is not None and speed.shaped and not speed.projected:
            raise UnsupportedError(f"{name}: a speed relative to an actor takes no rate")


def _position(action: ShapedAction, lasting: Sequence[Position]) -> None:
    name = action.action_name
    for position in lasting:
        if position.reference is not None or position.at == "end":
            if position.absolute and not position.project_on_route:
                raise UnsupportedError(
                    f"{name}: only change_position goes to a point off the lanes"
                )
            if _of(action.modifiers, Along) and position.reference is None:
                raise UnsupportedError(
                    f"{name}: position without a reference counts along the lane, and along"
                    " leaves it"
                )
            continue
        given = {**position.given(), "at": position.at}
        check_arguments(f"{name}: position", MOVING["position"], given)


def _one_measure(name: str, lasting: Sequence[Modifier]) -> None:
    lanes = any(isinstance(other, Lane | ChangeLane | KeepLane) for other in lasting)
    for modifier in _of(lasting, Lateral):
        beside = modifier.side_of is not None
        if beside and lanes:
            raise UnsupportedError(f"{name}: lateral beside an actor leaves no room for a lane")
        if beside and modifier.shape is not None:
            raise UnsupportedError(f"{name}: lateral beside an actor takes no shape")


def check_options(action: ShapedAction) -> None:
    """Refuses what only vehicles on lanes can do; called when the actor is known to be one or not.

    Raises:
        UnsupportedError: The actor follows no lanes.
    """
    if action.movable.lane_bound:
        return
    for modifier in action.modifiers:
        sideways = isinstance(modifier, Speed) and modifier.direction == "lateral"
        lanes = isinstance(modifier, Lane | Lateral | ChangeLane | KeepLane | Position)
        starts = getattr(modifier, "at", "all") == "start"
        if sideways:
            raise UnsupportedError(
                f"{action.action_name}: only vehicles on lanes have a lateral speed",
                action.source or None,
            )
        if lanes and not starts:
            raise UnsupportedError(
                f"{action.action_name}: {modifier.name} is for vehicles, which follow lanes",
                action.source or None,
            )

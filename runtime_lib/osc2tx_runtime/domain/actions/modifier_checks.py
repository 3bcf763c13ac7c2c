"""Which modifiers go together, checked before anything runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from osc2tx_runtime.domain.modifiers import Acceleration, Distance, Modifier, Position, Speed
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.language.argument_rules import check_arguments

from .combinations import (
    CONFLICTS,
    CONTRADICTIONS,
    EXCLUSIVE,
    MOVING,
    NO_START,
    ON_LANES,
    STARTING,
    sorts_of,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from osc2tx_runtime.domain.planning.modified_motion import ModifiedMotion

__all__ = ["check_modifiers", "check_options"]

ModifierT = TypeVar("ModifierT", bound=Modifier)


def check_modifiers(action: ModifiedMotion) -> None:
    """Refuses modifiers that contradict each other, or have no effect here.

    Raises:
        UnsupportedError: They cannot be carried out together, or at that time.
        ScenarioError: A modifier is given twice.
    """
    lasting, name = action.lasting, action.action_name
    along = [m for m in lasting if isinstance(m, Speed) and m.direction == "longitudinal"]
    rest = [m for m in lasting if not isinstance(m, Speed)]
    for modifier in lasting:
        _conflicts(action, modifier, along)
    if action.duration is not None or action.end_is_known:
        if not _arrives(action, along):
            _alone(name, along, rest, (Distance,))
        _alone(name, _of(rest, Acceleration), rest, (Distance,))
    for kinds in EXCLUSIVE:
        _exclusive(name, rest, *kinds)
    _twice(action)
    _at(action)
    _contradictions(action)
    for modifier in lasting:
        at = getattr(modifier, "at", "all")
        rules = MOVING.get(modifier.name, ())
        check_arguments(f"{name}: {modifier.name}", rules, {**modifier.given(), "at": at})


def _conflicts(action: ModifiedMotion, modifier: Modifier, along: Sequence[Speed]) -> None:
    """Refuses what a modifier leaves no room for."""
    room = not _shaped(action) and _room_for_place(action, along)
    for sort in sorted(sorts_of(modifier)):
        kinds = CONFLICTS.get(sort, ())
        if sort in ("speed", "acceleration") and room:
            kinds = tuple(kind for kind in kinds if kind is not Position)
        others = [m for m in action.lasting if m is not modifier and _is_along(m)]
        _alone(action.action_name, [modifier], others, kinds)


def _is_along(modifier: Modifier) -> bool:
    """Whether it is no speed across the lane, which leaves room for everything along it."""
    return not isinstance(modifier, Speed) or modifier.direction == "longitudinal"


def _shaped(action: ModifiedMotion) -> bool:
    """Whether a shape says where the actor is."""
    return any(position.shape is not None for position in _of(action.lasting, Position))


def _room_for_place(action: ModifiedMotion, speeds: Sequence[Speed]) -> bool:
    """Whether there can be a place beside speeds and accelerations: at the end, when it comes."""
    ends = all(position.at == "end" for position in _of(action.lasting, Position))
    rates = [m.at for m in (*speeds, *_of(action.lasting, Acceleration))]
    return ends and (_arrives(action, speeds) or all(at == "all" for at in rates))


def _arrives(action: ModifiedMotion, speeds: Sequence[Speed]) -> bool:
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


def _twice(action: ModifiedMotion) -> None:
    starts = [m for m in action.modifiers if m not in action.lasting]
    for group in (action.lasting, starts):
        found: set[frozenset[str]] = set()
        for modifier in group:
            sort = frozenset((modifier.name, *({"lateral speed"} & sorts_of(modifier))))
            if sort in found:
                raise ScenarioError(f"{action.action_name} has {modifier.name} twice")
            found.add(sort)


def _at(action: ModifiedMotion) -> None:
    for modifier in action.modifiers:
        if getattr(modifier, "at", "all") != "start":
            continue
        why = NO_START.get(type(modifier))
        if why is not None:
            raise UnsupportedError(f"{action.action_name}: {modifier.name} {why}")
        what = f"{action.action_name}: {modifier.name}"
        check_arguments(what, STARTING, {**modifier.given(), "at": "start"})


def _contradictions(action: ModifiedMotion) -> None:
    for one, other in CONTRADICTIONS:
        said = {
            (name, value)
            for modifier in action.modifiers
            for name, value in modifier.given().items()
            if isinstance(value, str)
        }
        if one in said and other in said:
            raise UnsupportedError(
                f"{action.action_name}: {one[1]} and {other[1]} exclude each other"
            )


def check_options(action: ModifiedMotion) -> None:
    """Refuses what only vehicles on lanes can do; called when the actor is known to be one or not.

    Raises:
        UnsupportedError: The actor follows no lanes.
    """
    if action.movable.lane_bound:
        return
    for modifier in action.modifiers:
        sideways = isinstance(modifier, Speed) and modifier.direction == "lateral"
        lanes = isinstance(modifier, ON_LANES)
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

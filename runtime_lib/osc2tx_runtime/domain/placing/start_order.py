"""Order of placement: references first, towing vehicles before trailers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.actors import PhysicalObject, Vehicle
from osc2tx_runtime.domain.modifiers import (
    Along,
    AlongTrajectory,
    Lane,
    Location,
    Modifier,
    OnPath,
    Position,
    TowTrailer,
)
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind
from osc2tx_runtime.errors import PlacementError
from osc2tx_shared.classes import replace

if TYPE_CHECKING:
    from osc2tx_runtime.language.actions.placement import Placement


_PLACES = (Position, Location, Along, AlongTrajectory, OnPath)
"""Modifiers that state the position of an actor along the road."""


class ActorStart:
    """One actor to place.

    Attributes:
        actor: The actor.
        modifiers: Its start.
        source: Position in the scenario.
        references: Actors that must be placed before.
        rank: Absolute positions come before relative ones, defaults last.
        towed_by: The vehicle it is coupled to from the start.
    """

    def __init__(
        self, actor: PhysicalObject, modifiers: Sequence[Modifier], source: str | None
    ) -> None:
        self.actor = actor
        self.modifiers = modifiers
        self.source = source
        self.references: list[str] = []
        self.towed_by: PhysicalObject | None = None
        for modifier in modifiers:
            if not modifier.facts.placement:
                raise PlacementError(f"{actor.id} cannot start with {modifier.name}", source)
            if getattr(modifier, "at", "all") == "end":
                raise PlacementError(
                    f"{actor.id}: {modifier.name} at the end is not a start", source
                )
            reference = getattr(modifier, "reference", None)
            reference = reference or getattr(modifier, "relative_to", None)
            if reference is not None:
                self.references.append(reference.id)
        position = one_of_kind(modifiers, Position)
        absolute = position is not None and position.absolute
        absolute = absolute or one_of_kind(modifiers, Location) is not None
        self.rank = 0 if absolute else 1 if self.references else 2

    @property
    def id(self) -> str:
        """The actor."""
        return self.actor.id

    @property
    def has_place(self) -> bool:
        """Whether the scenario states its position along the road, or an actor beside it."""
        return bool(self.references) or any(isinstance(m, _PLACES) for m in self.modifiers)

    @property
    def is_open(self) -> bool:
        """Whether the scenario leaves its position along the road or its lane open."""
        if self.rank != 2:
            return False
        if one_of_kind(self.modifiers, Along) is not None:
            return one_of_kind(self.modifiers, Lane) is None
        return one_of_kind(self.modifiers, Position) is None


def joined(first: Placement, second: Placement) -> Placement:
    """Return the modifiers of two members of a scenario for the start of an actor.

    Raises:
        PlacementError: They constrain the same motion, and differ.
    """
    if second.implied:
        return replace(first, modifiers=with_implied(first.modifiers, second.modifiers))
    said = {_subject(modifier): modifier for modifier in first.modifiers}
    for modifier in second.modifiers:
        if said.setdefault(_subject(modifier), modifier) != modifier:
            raise PlacementError(
                f"{second.actor.id} is placed already ({first.source})", second.source
            )
    throughout = first.throughout and second.throughout
    return replace(first, modifiers=tuple(said.values()), throughout=throughout)


def with_implied(stated: Sequence[Modifier], implied: Sequence[Modifier]) -> tuple[Modifier, ...]:
    """Return the stated modifiers of a start, completed by the implied ones."""
    known = {_subject(modifier) for modifier in stated}
    if any(isinstance(modifier, _PLACES) for modifier in stated):
        known |= {_subject(modifier) for modifier in implied if isinstance(modifier, _PLACES)}
    return (*stated, *(modifier for modifier in implied if _subject(modifier) not in known))


def _subject(modifier: Modifier) -> tuple[str, str]:
    return modifier.name, str(getattr(modifier, "direction", ""))


def couple(starts: Sequence[ActorStart]) -> None:
    """Makes trailers depend on their towing vehicles.

    Raises:
        PlacementError: A trailer has a start position of its own or two towing vehicles, or its
            coupler does not fit.
    """
    by_id = {start.id: start for start in starts}
    for start in starts:
        tow = one_of_kind(start.modifiers, TowTrailer)
        if tow is None:
            continue
        trailer = by_id[tow.trailer.id]
        places = [m for m in trailer.modifiers if not isinstance(m, TowTrailer)]
        if places or trailer.towed_by is not None:
            raise PlacementError(
                f"{trailer.actor.id} is towed by {start.actor.id}, so it has no start position of"
                " its own",
                start.source,
            )
        vehicle = start.actor
        misfit = tow.trailer.misfit(vehicle.said_receiver) if isinstance(vehicle, Vehicle) else None
        if misfit is not None:
            raise PlacementError(
                f"{start.actor.id} cannot tow {trailer.actor.id}: {misfit}", start.source
            )
        trailer.towed_by, trailer.references, trailer.rank = start.actor, [start.id], 1


def cycle_of(waiting: Sequence[ActorStart]) -> PlacementError:
    """Return the starts that depend on each other, in words."""
    by_id = {start.id: start for start in waiting}
    start, seen = waiting[0], []
    while start not in seen:
        seen.append(start)
        blocking = [r for r in start.references if r in by_id]
        if not blocking:
            missing = ", ".join(start.references)
            return PlacementError(f"{start.id} waits for {missing}", start.source)
        start = by_id[blocking[0]]
    ring = seen[seen.index(start) :]
    places = ", ".join(f"{each.id} ({each.source})" for each in ring)
    return PlacementError(f"the starts of {places} depend on each other", ring[-1].source)

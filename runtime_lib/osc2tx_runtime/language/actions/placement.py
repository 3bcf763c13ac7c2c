"""The record of one `place` call."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx_runtime.language.actions.modifier import Modifier
    from osc2tx_runtime.language.declared import BaseActor


@dataclass(frozen=True, slots=True)
class Placement:
    """The start of an actor.

    Attributes:
        actor: The actor.
        modifiers: position, lane, speed and others, as stated.
        source: Position in the scenario.
        throughout: Whether it also holds later.
        implied: Whether it is not stated, but implied by the first action of the actor.
    """

    actor: BaseActor
    modifiers: tuple[Modifier, ...]
    source: str
    throughout: bool = False
    implied: bool = False

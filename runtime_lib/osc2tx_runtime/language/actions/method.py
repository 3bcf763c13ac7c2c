"""Registration data of an action: name, slots, how it ends, needs."""

from __future__ import annotations

from typing import Literal

from osc2tx_runtime.world.protocol import Feature
from osc2tx_shared.classes import dataclass

LONGITUDINAL = "longitudinal"
LATERAL = "lateral"

Ends = Literal["goal", "open", "instant", "at_once"]


@dataclass(frozen=True, slots=True)
class Method:
    """One action.

    Attributes:
        kind: Actor kind of the DSL (`vehicle`); None for an action that has no actor.
        name: Method name (`change_lane`).
        slots: Slots of the actor that it controls: LONGITUDINAL, LATERAL, both or none. An action
            that moves as its modifiers state controls none itself.
        ends: `goal` when its goal is reached, `at_once` with a goal that is reached at the instant
            of its start, `open` only with its surroundings, `instant` immediately. An instantaneous
            action has no goal, so like an `emit` it does not bound a composition.
        places: Whether its arguments state the position of the actor.
        paces: Whether it sets or holds the speed of the actor.
        needs: Capabilities of the world that it requires.
        undeclared: Why the library does not declare it, if it does not.
    """

    kind: str | None
    name: str
    slots: tuple[str, ...]
    ends: Ends
    places: bool = False
    paces: bool = False
    needs: tuple[Feature, ...] = ()
    undeclared: str = ""

    @property
    def qualified_name(self) -> str:
        """`vehicle.change_lane`; only the name without an actor."""
        return self.name if self.kind is None else f"{self.kind}.{self.name}"

    @property
    def is_momentary(self) -> bool:
        """Whether it takes no time."""
        return self.ends in ("instant", "at_once")

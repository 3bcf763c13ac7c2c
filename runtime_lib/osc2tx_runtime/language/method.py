"""Registration data of an action: name, slots, how it ends, needs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

__all__ = ["LATERAL", "LONGITUDINAL", "Ends", "Method", "Need"]

LONGITUDINAL = "longitudinal"
LATERAL = "lateral"

Ends = Literal["goal", "open", "instant", "step"]
Need = Literal["lanes", "lights", "map", "towing", "traffic_lights", "weather"]
"""What a world must have beside moving actors."""


@dataclass(frozen=True, slots=True)
class Method:
    """One action.

    Attributes:
        kind: Actor kind of the DSL (`vehicle`).
        name: Method name (`change_lane`).
        slots: What it controls of the actor: LONGITUDINAL, LATERAL, both or nothing. An action that
            moves as its modifiers say controls nothing itself.
        ends: `goal` when its goal is reached, `open` only with its surroundings, `instant` at once,
            `step` at the next step, where what it assigns can be seen.
        places: Whether its arguments say where the actor is.
        paces: Whether it sets or holds the speed of the actor.
        needs: What a world must have to carry it out.
        undeclared: Why the library does not declare it, if it does not.
    """

    kind: str
    name: str
    slots: tuple[str, ...]
    ends: Ends
    places: bool = False
    paces: bool = False
    needs: tuple[Need, ...] = ()
    undeclared: str = ""

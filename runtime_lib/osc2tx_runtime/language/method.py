"""What is known of an action besides its class: name, slots, how it ends."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

__all__ = ["LATERAL", "LONGITUDINAL", "Ends", "Method"]

LONGITUDINAL = "longitudinal"
LATERAL = "lateral"

Ends = Literal["goal", "open", "instant"]


@dataclass(frozen=True, slots=True)
class Method:
    """One action.

    Attributes:
        kind: Actor kind of the DSL (`vehicle`).
        name: Method name (`change_lane`).
        slots: What it controls of the actor: LONGITUDINAL, LATERAL, both or nothing.
        ends: `goal` when its goal is reached, `open` only with its surroundings, `instant` at once.
    """

    kind: str
    name: str
    slots: tuple[str, ...]
    ends: Ends

"""A condition on the states of a phase."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from osc2tx_runtime.enums import At
from osc2tx_shared.classes import dataclass

Reading: TypeAlias = tuple[float, float, float]
"""A value, and its least and greatest allowed value."""


@dataclass(frozen=True, slots=True)
class Condition:
    """A condition on the states of a phase.

    Attributes:
        modifier: Name of its origin in the DSL.
        what: The measured quantity, for messages: `its speed`.
        quantity: Name in `QUANTITIES`.
        at: The time at which it has to hold.
        measure: Reads it at the present step; None while it cannot be measured.
        text: Describes a reading in messages, if numbers alone are unclear.
        is_steady: It reads only speed, acceleration, lane and offset of the actor.
        is_target: It is the target of an action (DSL 8.8.2.2) or of a shape.
        source: Position of the modifier in the scenario; empty for what the action implies.
        is_late: It constrains the start, but only later states determine it.
    """

    modifier: str
    what: str
    quantity: str
    at: At
    measure: Callable[[], Reading | None]
    text: Callable[[Reading], str] | None = None
    is_steady: bool = False
    is_target: bool = False
    is_late: bool = False
    source: str = ""

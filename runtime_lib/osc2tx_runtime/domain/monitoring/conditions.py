"""A condition on the states of a phase."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from osc2tx_runtime.enums import At
from osc2tx_shared.classes import dataclass

Reading: TypeAlias = tuple[float, float, float]
"""A value, and the least and the greatest that is allowed."""


@dataclass(frozen=True, slots=True)
class Condition:
    """A condition on the states of a phase.

    Attributes:
        modifier: Name of its origin in the DSL.
        what: The measured quantity, for messages: `its speed`.
        quantity: Name in `QUANTITIES`.
        at: When it has to hold.
        measure: Reads it at the present step; None while it cannot be measured.
        text: Describes a reading in messages, where numbers alone are not clear.
        is_steady: It reads nothing but speed, acceleration, lane and offset of the actor itself.
        is_target: It is the target of an action (DSL 8.8.2.2) or of the course of a shape.
        source: Position of the modifier in the scenario; empty for what the action implies.
        is_late: It is about the start, but only later states tell it.
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

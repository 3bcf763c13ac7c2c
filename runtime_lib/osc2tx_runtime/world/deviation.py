"""How far a measured actor is from where it is to be."""

from __future__ import annotations

import math
from typing import NamedTuple

from .curve import turn_between
from .state import ActorState

__all__ = ["Deviation"]


class Deviation(NamedTuple):
    """How far an actor is from where it is to be.

    Attributes:
        speed: m/s it is too fast.
        place: m it is to the left of its path.
        heading: rad it is turned to the left of it.
        late: s since the reference has come to the end of what it is to do.
    """

    speed: float
    place: float
    heading: float
    late: float = 0.0

    @classmethod
    def of(cls, state: ActorState, reference: ActorState, late: float = 0.0) -> Deviation:
        """Compare a measured state with its reference."""
        dx, dy, h = state.x - reference.x, state.y - reference.y, reference.h
        return cls(
            state.v - reference.v,
            dy * math.cos(h) - dx * math.sin(h),
            turn_between(h, state.h),
            late,
        )

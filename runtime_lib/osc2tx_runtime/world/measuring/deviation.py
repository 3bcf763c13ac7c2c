"""How far a measured actor is from where it is to be."""

from __future__ import annotations

import math
from typing import NamedTuple

from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.state import ActorState

STANDSTILL = 0.05
"""m/s: a lower measured speed counts as standstill."""
SPEED_TOLERANCE = 0.5
"""m/s off the commanded speed that count as reached; at standstill none do."""
ACCELERATION_TOLERANCE = 0.5
"""m/s^2 off the commanded acceleration that count as reached."""
PLACE_TOLERANCE = 0.5
"""m beside the commanded path that count as on it."""
HEADING_TOLERANCE = math.radians(3.0)
"""rad off the commanded heading that count as reached."""
PATIENCE = 5.0
"""s after the end of its reference at which an actor has to be there."""
OFF_ITS_PATH = 1.0
"""m beside its path at which an actor has left it, if it stays so for a second."""


class Deviation(NamedTuple):
    """How far an actor is from where it is to be.

    Attributes:
        speed: m/s it is too fast.
        place: m to the left of its path.
        heading: rad to the left of its path.
        late: s since the reference has completed its command.
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

"""Deviations of a measured actor from its reference."""

from __future__ import annotations

import math
from typing import NamedTuple

from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.state import ActorState

STANDSTILL = 0.05
"""m/s: a lower measured speed counts as standstill."""
SPEED_TOLERANCE = 0.5
"""Tolerance (m/s) of the commanded speed; not applied at standstill."""
ACCELERATION_TOLERANCE = 0.5
"""Tolerance (m/s^2) of the commanded acceleration."""
PLACE_TOLERANCE = 0.5
"""Tolerance (m) of the lateral deviation from the commanded path."""
HEADING_TOLERANCE = math.radians(3.0)
"""Tolerance (rad) of the commanded heading."""
PATIENCE = 5.0
"""Seconds after the end of its reference within which an actor has to arrive."""
OFF_ITS_PATH = 1.0
"""Lateral deviation (m) beyond which an actor has left its path, if it lasts for a second."""


class Deviation(NamedTuple):
    """Deviation of an actor from its reference.

    Attributes:
        speed: m/s: excess speed.
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

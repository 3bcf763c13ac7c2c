"""The quantities that monitors check, with their tolerances.

`docs/reference/monitors.md` shows it; a test compares.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from osc2tx_runtime.world.measuring.deviation import (
    ACCELERATION_TOLERANCE,
    HEADING_TOLERANCE,
    PLACE_TOLERANCE,
    SPEED_TOLERANCE,
)
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx_runtime.world.state import ActorState


def _unknown(state: ActorState) -> float:
    return 0.0


@dataclass(frozen=True, slots=True)
class Quantity:
    """A quantity of conditions.

    Attributes:
        unit: SI unit; empty for a number.
        exact: Tolerance for actors that follow their commands exactly.
        measured: Tolerance for actors that a simulator or driver moves.
        rate: Its rate of change. The exact end of a phase is within its last step, so a change of
            one step is allowed there.
    """

    unit: str
    exact: float
    measured: float
    rate: Callable[[ActorState], float] = _unknown


QUANTITIES: dict[str, Quantity] = {
    "speed": Quantity("m/s", 0.05, SPEED_TOLERANCE, lambda state: state.a),
    "acceleration": Quantity("m/s^2", 0.1, ACCELERATION_TOLERANCE),
    "position": Quantity("m", 0.1, PLACE_TOLERANCE, lambda state: state.v),
    "lateral position": Quantity("m", 0.1, PLACE_TOLERANCE, lambda state: state.lateral_speed),
    "lane": Quantity("", 0.0, 0.0),
    "angle": Quantity("rad", 0.01, HEADING_TOLERANCE),
    "time": Quantity("s", 0.05, 0.5, lambda state: 1.0),
}
"""By name, in the order of the page."""

"""Arrival commands: a distance to another actor at the end of a duration."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.world.actor_dimensions import COMFORT
from osc2tx_runtime.world.commands import Arrive, FollowSpeed
from osc2tx_runtime.world.measuring.distances import along_lanes, gap_between, headway_between

if TYPE_CHECKING:
    from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion
    from osc2tx_runtime.world.commands import KeepGap

_CHOICES = 200  # samples of a range of times


def arrival(action: ModifiedMotion, gap: KeepGap) -> Arrive | None:
    """The command to have a gap, at the speed of the reference, when the action ends.

    From a range of durations the shortest comfortable one is chosen, else the longest.

    Returns:
        The command; None if the action ends when the gap is reached, at any time.

    Raises:
        Refused: There is no path along lanes to the reference.
    """
    duration = action.time_frame()
    if duration is None:
        return None
    low, high = duration if isinstance(duration, tuple) else (duration, duration)
    if math.isinf(high):
        return None
    dt = action.context.dt
    missing, closing = _missing(action, gap)
    limits = action.limits
    most = COMFORT * min(limits.acceleration, limits.deceleration)
    for i in range(_CHOICES + 1):
        time = max(low + (high - low) * i / _CHOICES, dt)
        # Linearly decreasing accelerations, see `guidance`, from the first to the last.
        first = (6.0 * missing - 4.0 * closing * time) / (time * time)
        last = (2.0 * closing * time - 6.0 * missing) / (time * time)
        if max(abs(first), abs(last)) <= most:
            break
    return Arrive(time, gap=gap, speed=FollowSpeed(gap.reference))


def _missing(action: ModifiedMotion, gap: KeepGap) -> tuple[float, float]:
    """Metres to gain, and the present rate (m/s)."""
    me, other = action.here, action.world.state(gap.reference)
    along = along_lanes(action.world.map, other, me)
    if along is None:
        raise Refused(f"there is no route along lanes to {gap.reference}")
    here = along
    if gap.measure == "gap":
        here = gap_between(along, me.shape, other.shape)
    elif gap.measure == "headway":
        here = headway_between(along, me.shape, other.shape)
    size = gap.distance or 0.0
    if gap.time is not None:
        size = gap.time * other.v
    return (size if gap.ahead else -size) - here, me.v - other.v

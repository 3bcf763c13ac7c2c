"""The time in which an action reaches its goal, for other conditions at its end (DSL 8.9.13).

`distance(50m)` without a duration ends its action after 50 m, `position(50m, at: end)` at a
position. Other conditions `at: end` have to hold then, so this time is computed from the motion
that the other modifiers require.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Acceleration, Distance, Position
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.world.commands import FollowSpeed, SpeedChange
from osc2tx_runtime.world.longitudinal.execution import speed_profile
from osc2tx_runtime.world.measuring.distances import along_lanes

from .goals import (
    lasting_position,
    position_shape,
    speed_at_end,
    speeds_of,
    way_to,
    way_to_goal,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from osc2tx_runtime.domain.modifiers import Speed
    from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion

_STEP = 0.01  # s between samples of an integrated speed
_MOST = 600.0  # s after which a distance counts as never covered
_SAME = 0.1  # m between the end of a distance and a position


def time_to_goal(action: ModifiedMotion) -> float | None:
    """Seconds until an action reaches its goal.

    Returns:
        None if another condition ends it, or if it never reaches its goal.

    Raises:
        Refused: Its distance does not end at the required position.
    """
    if action.duration is not None or action.end_is_known or position_shape(action) is not None:
        return None
    goal = way_to_goal(action)
    if goal is None:
        return None
    way, position = goal[0], lasting_position(action)
    counted = one_of_kind(action.modifiers, Distance) is not None
    if counted and position is not None and position.at == "end":
        timed = _time_at_place(action, position, way)
        if timed is not None:
            return timed
    end = speed_at_end(action)
    if end is not None:
        speed = end if isinstance(end, float) else _speed_of(action, end)
        return _ratio(way, 0.5 * (action.here.v + speed))
    rate = one_of_kind(action.lasting, Acceleration)
    lasting = [each for each in speeds_of(action) if each.at == "all"]
    if lasting:
        return _covered(_speed_course(action, lasting[0], rate), way)
    v = action.here.v
    if rate is None:
        return _ratio(way, v)
    target = rate.value(action.here.a)
    here = action.here.a if rate.at == "end" else target  # at the end it has changed linearly
    return _root(lambda t: v * t + (2.0 * here + target) * t * t / 6.0 - way)


def _time_at_place(action: ModifiedMotion, position: Position, way: float) -> float | None:
    """Time at which another actor is at the required position; None without a moving reference.

    Raises:
        Refused: The position is a different one.
    """
    if position.reference is None:
        low, high = way_to(action, position)
    else:
        other = action.world.state(position.reference.id)
        ahead = along_lanes(action.world.map, action.here, other)
        if ahead is None or position.timed:
            return None
        low, high = position.size()
        low, high = (ahead + low, ahead + high) if position.ahead else (ahead - high, ahead - low)
        if other.v > 0.0:
            return max((way - min(max(way, low), high)) / other.v, 0.0) or None
    if not low - _SAME <= way <= high + _SAME:
        nearest = min(max(way, low), high)
        raise Refused(
            f"`distance` ends after {way:.1f} m, and `position` is {nearest:.1f} m ahead of it"
        )
    return None


def _speed_of(action: ModifiedMotion, wanted: FollowSpeed) -> float:
    """The speed (m/s) relative to another actor in its present motion."""
    base = action.world.state(wanted.reference).v * wanted.factor + wanted.difference
    return min(max(action.here.v, base), base + wanted.spread)


def _speed_course(
    action: ModifiedMotion, speed: Speed, rate: Acceleration | None
) -> Callable[[float], float]:
    """The speed (m/s) over time; references continue their present motion."""
    low, high = speed.difference()
    if speed.reference is not None:
        other = speed.times * action.world.state(speed.reference.id).v
        low, high = low + other, high + other
    here = action.here
    profile, peak = speed.course
    if rate is not None:
        profile, peak = "constant", abs(rate.value(0.0))
    change = SpeedChange(min(max(here.v, low), high), profile, peak)
    return speed_profile(change, here.v, action.limits, here.a).value


def _covered(speed: Callable[[float], float], way: float) -> float | None:
    """Seconds until a speed over time has covered a distance (m); None if it never does."""
    covered, before = 0.0, abs(speed(0.0))
    for i in range(1, int(_MOST / _STEP)):
        after = abs(speed(i * _STEP))
        gained = 0.5 * (before + after) * _STEP
        if gained and covered + gained >= way:
            return (i - 1 + (way - covered) / gained) * _STEP
        covered, before = covered + gained, after
    return None


def _root(beyond: Callable[[float], float]) -> float | None:
    """The first root (s) of an increasing function; None without one."""
    step, low = 0.1, 0.0
    while beyond(low + step) < 0.0:
        low += step
        if low > _MOST:
            return None
    high = low + step
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if beyond(middle) < 0.0 else (low, middle)
    return high


def _ratio(way: float, speed: float) -> float | None:
    return way / speed if speed > 0.0 and not math.isinf(way) else None

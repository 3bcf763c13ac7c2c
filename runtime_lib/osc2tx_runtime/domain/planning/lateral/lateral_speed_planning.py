"""Lateral commands for `speed` with `direction: lateral` (DSL 8.9.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers.base import own_course
from osc2tx_runtime.domain.planning.feasibility import check_one_way, check_peak
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.world.actor_dimensions import COMFORT
from osc2tx_runtime.world.commands import Command, RunOut, Sideways
from osc2tx_runtime.world.geometry.function_profiles import Mapped, change_profile

if TYPE_CHECKING:
    from collections.abc import Sequence

    from osc2tx_runtime.domain.modifiers import Speed
    from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion
    from osc2tx_runtime.world.geometry.profiles import Profile

_MOST = 12.0  # m/s^2: lateral limit of tyres


def lateral_speed_bounds(action: ModifiedMotion, speed: Speed) -> tuple[float, float]:
    """Least and greatest lateral speed (m/s) that a modifier allows now."""
    low, high = speed.difference()
    other = _other(action, speed)
    return low + other, high + other


def lateral_speed_command(action: ModifiedMotion, speeds: Sequence[Speed]) -> Command | None:
    """The command for the lateral speed; None if modifiers only constrain the start.

    Raises:
        Refused: It is not possible.
    """
    here = action.here.lateral_speed
    for speed in sorted(speeds, key=lambda each: each.at != "start"):
        low, high = lateral_speed_bounds(action, speed)
        target = min(max(here, low), high)
        if speed.at != "start":
            return _sideways(action, speed, here, target)
        here = target if action.may_jump else here
    return RunOut(here) if action.may_jump else None


def _sideways(action: ModifiedMotion, speed: Speed, here: float, target: float) -> Sideways:
    """The motion from one lateral speed to another."""
    moving = speed.reference is not None and not speed.projected
    base = _other(action, speed)
    course = _course(action, speed, here - base, target - base)
    if not moving:
        return Sideways(target, course=None if course is None else Mapped(course, 1.0, base))
    assert speed.reference is not None
    return Sideways(target - base, speed.reference.id, speed.times, course)


def _other(action: ModifiedMotion, speed: Speed) -> float:
    if speed.reference is None:
        return 0.0
    return speed.times * action.world.state(speed.reference.id).lateral_speed


def _course(action: ModifiedMotion, speed: Speed, start: float, end: float) -> Profile | None:
    """How the speed is reached; None: instantly."""
    own = own_course(speed.shape)
    if own is not None:
        sign = -1.0 if speed.slower_than is not None else 1.0
        check_one_way(speed, own)
        return Mapped(own, sign, 0.0)
    if action.may_jump or (speed.at == "all" and not speed.shaped):
        return None
    profile, peak = speed.course
    check_peak(peak, "m/s^2")
    time = action.time_left() if speed.at == "end" and peak is None else None
    most = action.limits.lateral if action.strict else _MOST
    usual = COMFORT * action.limits.lateral
    course = change_profile(start, end, 0.0, (profile, peak, time), (usual, action.limits.jerk))
    rates = (course.rate(course.duration * i / 40.0) for i in range(40))
    if course.duration and max(map(abs, rates)) > most * 1.01:
        raise Refused(
            f"a lateral speed change from {start:.1f} to {end:.1f} m/s in {course.duration:.2f} s"
            f" requires more than {most:g} m/s^2"
        )
    return course

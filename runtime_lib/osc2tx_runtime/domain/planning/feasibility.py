"""Checks of profiles against the limits of the actor, and of monotonous ones for reversals."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.world.geometry.function_profiles import turns_back

if TYPE_CHECKING:
    from osc2tx_runtime.domain.modifiers.base import MovementModifier
    from osc2tx_runtime.world.geometry.profiles import Profile

    from .motion_action import ModifiedMotion

_JUMP = 0.5  # m/s: a smaller difference is corrected during the motion
_SAMPLES = 200


def check_peak(peak: float | None, unit: str) -> None:
    """Rejects a non-positive peak."""
    if peak is not None and peak <= 0.0:
        raise Refused(f"rate_peak {peak:g} {unit} is not positive")


def check_one_way(modifier: MovementModifier, course: Profile) -> None:
    """Rejects a reversal if a modifier requires a monotonous motion."""
    turn = turns_back(course) if modifier.monotonous else None
    if turn is not None:
        raise Refused(f"{modifier.name}: it would have to reverse after {turn:.1f} s")


def check_course(
    action: ModifiedMotion, modifier: MovementModifier, way: Profile, offset: float, *, ends: bool
) -> None:
    """Rejects a distance over time that exceeds the limits of the actor.

    Args:
        action: The action.
        modifier: The modifier that requires it.
        way: Metres over time, relative to a moving origin.
        offset: Speed of that origin (m/s).
        ends: Whether the action ends with it, at any speed.
    """
    check_one_way(modifier, way)
    if action.may_jump or math.isinf(way.duration):
        return
    duration = way.duration
    step = duration / _SAMPLES
    speeds = [offset + way.rate(i * step) for i in range(_SAMPLES)]
    speeds.append(offset + way.rate(max(duration - 1e-9, 0.0)))
    if duration == 0.0 and abs(way.value(0.0)) < 1e-6:
        return
    _check_jump(action.here.v, speeds[0], "at its start")
    if not ends:
        _check_jump(speeds[-1], offset, "at its end")
    _check_speeds(action, speeds, step)


def check_rates(action: ModifiedMotion, course: Profile) -> None:
    """Rejects a speed (m/s) over time that exceeds the limits."""
    if math.isinf(course.duration):
        return
    step = course.duration / _SAMPLES
    _check_jump(action.here.v, course.value(0.0), "at its start")
    _check_speeds(action, [course.value(i * step) for i in range(_SAMPLES + 1)], step)


def _check_speeds(action: ModifiedMotion, speeds: list[float], step: float) -> None:
    """Rejects a sequence of speeds (m/s) that exceeds the limits."""
    limits = action.limits if action.strict else action.tyres
    for gaining, cap in ((True, limits.acceleration), (False, limits.deceleration)):
        rates = (
            abs(after - before) / step
            for before, after in pairwise(speeds)
            if step and gaining == (abs(after) > abs(before))
        )
        most = max(rates, default=0.0)
        if most > cap * 1.01:
            raise Refused(
                f"its shape requires {most:.2f} m/s^2, which exceeds its limit of"
                f" {cap:.4g} m/s^2{limits.road}"
            )


def _check_jump(before: float, after: float, when: str) -> None:
    if abs(after - before) > _JUMP:
        raise Refused(
            f"{when} its shape has {after:.2f} m/s, after {before:.2f} m/s; a speed only jumps with"
            " physical_movement(prefer_non_physical)"
        )

"""Seconds in whole steps: the first step at or after a time, and how late that is."""

from __future__ import annotations

import math

_ROUNDING = 1e-6
"""Part of a step by which seconds over steps may miss a whole number: 4.5 / 0.05 is 90."""

_NEVER = 2.0**62
"""A number of steps that no run reaches, for a quotient of time and dt beyond the range of
floats."""


def whole_steps(seconds: float, dt: float) -> int:
    """Return the first step at or after a time.

    Args:
        seconds: Finite; negative before the start.
        dt: Length of a step (s).
    """
    return math.ceil(min(seconds / dt, _NEVER) - _ROUNDING)


def lateness(steps: int, seconds: float, dt: float) -> float:
    """Return by how many seconds a step comes after a time; 0 for the rounding of sums.

    Args:
        steps: The step.
        seconds: The time.
        dt: Length of a step (s).
    """
    late = steps * dt - seconds
    return late if late > _ROUNDING * dt else 0.0


def is_longer(seconds: float, than: float, dt: float) -> bool:
    """Return whether a part of a step is longer than another, beyond the rounding of sums.

    Args:
        seconds: The part (s).
        than: The other part (s).
        dt: Length of a step (s).
    """
    return seconds - than > _ROUNDING * dt

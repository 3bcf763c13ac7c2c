"""Guidance law: accelerations to a position, and a speed there, in a number of steps.

The result is the first of the accelerations, one per step and constant in it, that reach the
position with the least sum of squares. Recomputed in each step, they decrease linearly in time
without disturbances: the motion of least effort, independent of the step size.
"""

from __future__ import annotations


def rate_to_place(steps: int, dt: float, missing: float) -> float:
    """Acceleration (m/s^2) of this step, with any speed at the end.

    Args:
        steps: Remaining steps, at least 1.
        dt: Their length (s).
        missing: Metres by which the position would be missed without acceleration.
    """
    _, second = _sums(steps, dt)
    return missing * (steps - 0.5) / second


def mean_rate_to_place(steps: int, dt: float, missing: float) -> float:
    """Mean of all these accelerations (m/s^2)."""
    first, second = _sums(steps, dt)
    return missing * first / (dt * second * steps)


def rate_to_place_and_speed(steps: int, dt: float, missing: float, change: float) -> float:
    """Acceleration (m/s^2) of this step, with a change of speed (m/s) until the end.

    In the last step only the speed counts.
    """
    if steps == 1:
        return change / dt
    first, second = _sums(steps, dt)
    determinant = steps * second - first * first
    slope = (steps * missing - first * change) / (dt * determinant)
    base = (second * change - first * missing) / (dt * determinant)
    return base + slope * (steps - 0.5) * dt


def _sums(steps: int, dt: float) -> tuple[float, float]:
    """Sums over the steps of the time left after the middle of each step, and of its square."""
    return 0.5 * steps * steps * dt, dt * dt * (steps**3 / 3.0 - steps / 12.0)

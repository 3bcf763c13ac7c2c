"""Shapes: the course of a quantity on the way to its value (DSL 8.9.1.2)."""

from __future__ import annotations

from dataclasses import dataclass

from osc2tx_runtime.world.profiles import DynamicProfile

__all__ = ["CommonAccelerationShape", "CommonLateralShape", "CommonShape", "CommonSpeedShape"]


@dataclass(frozen=True, slots=True)
class CommonShape:
    """What the common shapes share.

    Attributes:
        rate_profile: Course of the first derivative of the quantity.
        rate_peak: Its peak.
        target: Value to be reached, where the modifier gives none.
    """

    rate_profile: DynamicProfile = "none"
    rate_peak: float | None = None
    target: float | None = None


@dataclass(frozen=True, slots=True)
class CommonSpeedShape(CommonShape):
    """Of a speed (m/s); the rate is the acceleration (m/s^2)."""


@dataclass(frozen=True, slots=True)
class CommonAccelerationShape(CommonShape):
    """Of an acceleration (m/s^2); the rate is the jerk (m/s^3)."""


@dataclass(frozen=True, slots=True)
class CommonLateralShape(CommonShape):
    """Of a place across the lane (m); the rate is the lateral speed (m/s)."""

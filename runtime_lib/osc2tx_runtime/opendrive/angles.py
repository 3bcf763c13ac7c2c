"""Angles of directions."""

import math

__all__ = ["wrap"]


def wrap(angle: float) -> float:
    """An angle in (-pi, pi]."""
    return math.pi - (math.pi - angle) % math.tau

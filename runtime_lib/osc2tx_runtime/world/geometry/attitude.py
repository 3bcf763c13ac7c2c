"""Pitch and roll of actors: from the road, or as commanded (DSL 8.3, 8.14.2).

Angles follow ISO 8855, applied in the order yaw, pitch, roll: nose up is a negative pitch, left
side up a positive roll.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from osc2tx_runtime.opendrive import Pose

from .curve import turn_between


class Tilt(NamedTuple):
    """Pitch and roll (rad); None: not commanded."""

    pitch: float | None = None
    roll: float | None = None

    def over(self, ground: tuple[float, float]) -> tuple[float, float]:
        """Pitch and roll; open values are those of the ground."""
        pitch, roll = ground
        return pitch if self.pitch is None else self.pitch, roll if self.roll is None else self.roll


LEVEL = Tilt()
"""As the road."""


def tilt_on(surface: Pose, heading: float) -> tuple[float, float]:
    """Pitch and roll (rad) on a surface at a heading (rad).

    Args:
        surface: Pose of a lane at the position, with the tilt in its own direction.
        heading: Heading of the actor (rad).
    """
    if not (surface.pitch or surface.roll):
        return 0.0, 0.0
    turn = turn_between(surface.h, heading)
    if turn == 0.0:
        return surface.pitch, surface.roll
    sine = math.sin(surface.pitch) * math.cos(surface.roll)
    # The normal of the surface, in the axes of the lane, then of the actor.
    ahead, left = sine, -math.sin(surface.roll)
    up = math.cos(surface.pitch) * math.cos(surface.roll)
    ahead, left = (
        ahead * math.cos(turn) + left * math.sin(turn),
        left * math.cos(turn) - ahead * math.sin(turn),
    )
    return math.atan2(ahead, up), math.atan2(-left, math.hypot(ahead, up))

"""Pitch and roll of actors: from the road, or as commanded (DSL 8.3, 8.14.2).

Angles follow ISO 8855, applied in the order yaw, pitch, roll: a raised nose has a negative pitch, a
left side that is raised a positive roll.
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
        """Pitch and roll, the open ones from the ground."""
        pitch, roll = ground
        return pitch if self.pitch is None else self.pitch, roll if self.roll is None else self.roll


LEVEL = Tilt()
"""As the road has it."""


def tilt_on(surface: Pose, heading: float) -> tuple[float, float]:
    """Pitch and roll (rad) of what lies on a surface, with a heading (rad) of its own.

    Args:
        surface: Pose of a lane at the place: how it is tilted in its own direction.
        heading: Where the actor points to.
    """
    if not (surface.pitch or surface.roll):
        return 0.0, 0.0
    turn = turn_between(surface.h, heading)
    if turn == 0.0:
        return surface.pitch, surface.roll
    sine = math.sin(surface.pitch) * math.cos(surface.roll)
    # What stands upright on the surface, seen in the axes of the lane, then of the actor.
    ahead, left = sine, -math.sin(surface.roll)
    up = math.cos(surface.pitch) * math.cos(surface.roll)
    ahead, left = (
        ahead * math.cos(turn) + left * math.sin(turn),
        left * math.cos(turn) - ahead * math.sin(turn),
    )
    return math.atan2(ahead, up), math.atan2(-left, math.hypot(ahead, up))

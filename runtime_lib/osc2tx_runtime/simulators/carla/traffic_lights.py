"""Traffic lights: a light of CARLA shows one of red, yellow, green and off."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx_runtime.enums import BulbState
from osc2tx_runtime.world.traffic_light_lamps import Lamp

__all__ = ["lamps_for", "state_for"]

STATES = (("Red", "red"), ("Yellow", "yellow"), ("Green", "green"))
"""State and color, from the one that stops to the one that lets go."""

DARK = ("is_off", "unknown")


def state_for(lamps: Sequence[Lamp], shown: Sequence[BulbState]) -> str:
    """Return the state that stands for lamps; yellow with red is yellow."""
    lit = {lamp.color for lamp, state in zip(lamps, shown, strict=True) if state not in DARK}
    if "yellow" in lit:
        return "Yellow"
    return next((state for state, color in STATES if color in lit), "Off")


def lamps_for(lamps: Sequence[Lamp], state: str) -> tuple[BulbState, ...] | None:
    """Return what the lamps of a light do in a state; None if nobody knows."""
    if state == "Unknown":
        return None
    color = dict(STATES).get(state)
    return tuple("is_on" if lamp.color == color else "is_off" for lamp in lamps)

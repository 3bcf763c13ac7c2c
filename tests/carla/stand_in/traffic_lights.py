"""Traffic lights: each goes through its own cycle; groups have one light here."""

from __future__ import annotations

from .actors import Light

RED, YELLOW, GREEN = 0, 1, 2
NEXT = {RED: GREEN, GREEN: YELLOW, YELLOW: RED}


def cycle(light: Light, dt: float) -> None:
    """Go on by a step; lights that are off or frozen stay as they are."""
    if light.frozen or light.state not in NEXT:
        return
    light.since += dt
    if light.since >= light.times[light.state] - 1e-9:
        light.state, light.since = NEXT[light.state], 0.0

"""Monitors of the orientation (DSL 8.9.9, 8.9.10)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Orient, Yaw
from osc2tx_runtime.domain.monitoring.conditions import Condition, Reading
from osc2tx_runtime.domain.monitoring.registry import monitors
from osc2tx_runtime.domain.placing.pose_resolution import heading_base, tilt_of
from osc2tx_runtime.world.geometry.curve import turn_between

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Phase


@monitors("yaw")
def yaw(modifier: Yaw, phase: Phase) -> Iterator[Condition]:
    """The heading against the road, north, or a reference."""
    if modifier.shape is not None and modifier.at == "all":
        return
    yield _heading(modifier, phase, modifier.angles())


@monitors("orientation")
def orientation(modifier: Orient, phase: Phase) -> Iterator[Condition]:
    """The angles that are given."""
    angles = modifier.angles()
    if angles is not None and not (modifier.shape is not None and modifier.at == "all"):
        yield _heading(modifier, phase, angles)
    for index, name in enumerate(("pitch", "roll")):
        if getattr(modifier, name) is not None:
            measure = _tilt(modifier, phase, index, name)
            yield Condition("orientation", f"its {name}", "angle", modifier.at, measure)


def _heading(modifier: Yaw | Orient, phase: Phase, angles: tuple[float, float]) -> Condition:
    low, high = angles
    world, me = phase.world, phase.me
    middle, half = 0.5 * (low + high), 0.5 * (high - low)

    def measure() -> Reading:
        here = me()
        turned = turn_between(heading_base(world, modifier, here) + middle, here.h)
        return middle + turned, middle - half, middle + half

    return Condition(modifier.name, "its heading", "angle", modifier.at, measure, _degrees)


def _tilt(modifier: Orient, phase: Phase, index: int, name: str) -> Callable[[], Reading | None]:
    world, me = phase.world, phase.me

    def measure() -> Reading | None:
        here = me()
        wanted = tilt_of(world, [modifier], here)[index]
        return None if wanted is None else (getattr(here, name), wanted, wanted)

    return measure


def _degrees(reading: Reading) -> str:
    value, low, high = map(math.degrees, reading)
    wanted = f"{low:.1f}" if low == high else f"from {low:.1f} to {high:.1f}"
    return f"its heading is {value:.1f}, not {wanted} degrees"

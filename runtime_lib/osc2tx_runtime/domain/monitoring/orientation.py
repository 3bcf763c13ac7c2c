"""Monitors of the orientation (DSL 8.9.9, 8.9.10)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Orient, Yaw
from osc2tx_runtime.domain.monitoring.conditions import Condition, Reading
from osc2tx_runtime.domain.monitoring.registry import monitors
from osc2tx_runtime.domain.monitoring.shaped_values import is_course, limits, moment
from osc2tx_runtime.domain.placing.pose_resolution import heading_base, tilt_of
from osc2tx_runtime.world.geometry.curve import turn_between

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Phase


@monitors("yaw")
def yaw(modifier: Yaw, phase: Phase) -> Iterator[Condition]:
    """The heading relative to the road, north, or a reference."""
    yield _heading(modifier, phase, limits(modifier, phase, Yaw.angles))


@monitors("orientation")
def orientation(modifier: Orient, phase: Phase) -> Iterator[Condition]:
    """The given angles."""
    if modifier.yaw is not None:
        yield _heading(modifier, phase, limits(modifier, phase, _turns))
    for index, name in enumerate(("pitch", "roll")):
        if getattr(modifier, name) is not None:
            measure = _tilt(modifier, phase, index, name)
            yield Condition("orientation", f"its {name}", "angle", modifier.at, measure)


def _turns(modifier: Orient) -> tuple[float, float]:
    angles = modifier.angles()
    assert angles is not None
    return angles


def _heading(
    modifier: Yaw | Orient, phase: Phase, angles: Callable[[], tuple[float, float]]
) -> Condition:
    world, me = phase.world, phase.me
    reference = modifier.relative_to
    other = None if reference is None else phase.track(reference.id, modifier.projected)
    before: float | None = None  # the base, one state ago

    def measure() -> Reading:
        nonlocal before
        here, (low, high) = me(), angles()
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        base = heading_base(world, modifier, here, None if other is None else other())
        turn = 0.0 if before is None else turn_between(before, base)
        if reference is None and abs(turn) > 0.5 * math.pi:
            base += math.pi  # it crosses to lanes of oncoming traffic
        before = base
        turned = turn_between(base + middle, here.h)
        return middle + turned, middle - half, middle + half

    when, course = moment(modifier), is_course(modifier)
    return Condition(
        modifier.name, "its heading", "angle", when, measure, _degrees, is_target=course
    )


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

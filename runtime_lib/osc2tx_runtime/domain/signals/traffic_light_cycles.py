"""Evaluation of traffic light cycles: the phase at a time (DSL 8.15.6)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from osc2tx_runtime.domain.signals.lamp_states import states_of
from osc2tx_runtime.domain.signals.traffic_lights import TrafficLightCycle, TrafficLightPhase
from osc2tx_runtime.enums import BulbState
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.surroundings.traffic_light_lamps import Lamp


class Moment(NamedTuple):
    """The phase of a cycle at a time.

    Attributes:
        number: Number of the phase, from 0.
        phase: The phase.
    """

    number: int
    phase: TrafficLightPhase


def check_cycle(cycle: TrafficLightCycle) -> None:
    """Rejects cycles that cannot be played.

    Raises:
        ScenarioError: There is no phase, a phase without duration, or more than one group.
    """
    if not cycle.phases:
        raise ScenarioError("a traffic_light_cycle without phases cannot be played")
    if any(not phase.duration > 0.0 for phase in cycle.phases):
        raise ScenarioError("a traffic_light_phase needs a duration of more than 0 s")
    group = cycle.phases[0].group
    if not all(phase.group.is_same(group) for phase in cycle.phases):
        raise ScenarioError("the phases of a traffic_light_cycle are about different groups")


def period_of(cycle: TrafficLightCycle) -> float:
    """Duration of all phases (s)."""
    return math.fsum(phase.duration for phase in cycle.phases)


def moment_of(cycle: TrafficLightCycle, time: float) -> Moment:
    """Phase at a time (s) since the start of playing; the next phase begins when one ends."""
    left = (time - cycle.start_offset + 1e-9) % period_of(cycle)
    for number, phase in enumerate(cycle.phases):
        if left < phase.duration:
            return Moment(number, phase)
        left -= phase.duration
    return Moment(len(cycle.phases) - 1, cycle.phases[-1])


def time_of(
    cycle: TrafficLightCycle, states: Sequence[BulbState], lamps: Sequence[Lamp]
) -> float | None:
    """First time (s) in a cycle without offset at which lamps have these states; None if never."""
    begin = 0.0
    for phase in cycle.phases:
        if states_of(phase.bulbs_state, lamps, phase.group.name) == tuple(states):
            return begin
        begin += phase.duration
    return None

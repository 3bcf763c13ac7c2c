"""Phases and cycles of traffic lights (DSL 8.15.6)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from osc2tx_runtime.domain.signals.traffic_lights import Bulbs, TrafficLightGroup, states_of
from osc2tx_runtime.enums import BulbState
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.traffic_light_lamps import Lamp

__all__ = ["Moment", "TrafficLightCycle", "TrafficLightPhase"]


@dataclass(frozen=True, slots=True)
class TrafficLightPhase:
    """What a group shows for a while.

    Attributes:
        group: The group.
        bulbs_state: What each of its boxes shows.
        duration: For how long (s).
    """

    group: TrafficLightGroup
    bulbs_state: Bulbs
    duration: float


class Moment(NamedTuple):
    """Which phase of a cycle holds at a time.

    Attributes:
        number: Number of the phase, from 0.
        phase: The phase.
    """

    number: int
    phase: TrafficLightPhase


@dataclass(frozen=True, slots=True)
class TrafficLightCycle:
    """Phases of one group, in order of time, again and again.

    Attributes:
        phases: The phases.
        synchronization_group_id: Cycles with the same id keep in step.
        start_offset: Seconds from the start of playing until the first phase begins; before it
            runs the end of the cycle.
    """

    phases: Sequence[TrafficLightPhase]
    synchronization_group_id: int | None = None
    start_offset: float = 0.0

    def check(self) -> None:
        """Refuses cycles that cannot be played.

        Raises:
            ScenarioError: There is no phase, one of no length, or more than one group.
        """
        if not self.phases:
            raise ScenarioError("a traffic_light_cycle without phases cannot be played")
        if any(not phase.duration > 0.0 for phase in self.phases):
            raise ScenarioError("a traffic_light_phase needs a duration of more than 0 s")
        group = self.phases[0].group
        if not all(phase.group.is_same(group) for phase in self.phases):
            raise ScenarioError("the phases of a traffic_light_cycle are about different groups")

    @property
    def period(self) -> float:
        """Length of all phases (s)."""
        return math.fsum(phase.duration for phase in self.phases)

    def at(self, time: float) -> Moment:
        """Phase at a time (s) since the start of playing; a phase begins where one ends."""
        left = (time - self.start_offset + 1e-9) % self.period
        for number, phase in enumerate(self.phases):
            if left < phase.duration:
                return Moment(number, phase)
            left -= phase.duration
        return Moment(len(self.phases) - 1, self.phases[-1])

    def time_of(self, states: Sequence[BulbState], lamps: Sequence[Lamp]) -> float | None:
        """First time (s) in a cycle without offset at which lamps are so; None if never."""
        begin = 0.0
        for phase in self.phases:
            if states_of(phase.bulbs_state, lamps, phase.group.name) == tuple(states):
                return begin
            begin += phase.duration
        return None

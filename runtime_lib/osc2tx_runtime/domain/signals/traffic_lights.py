"""Declared traffic lights: bulbs, groups, phases, cycles (DSL 8.15).

A `traffic_light` is a dynamic signal of the map, a `traffic_light_group` one of its controllers;
`map_id` is their OpenDRIVE id.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.map.objects import MapObject
from osc2tx_runtime.domain.points_and_poses import Pose
from osc2tx_runtime.domain.signals.lamp_states import Bulbs, Shown, TrafficLightBulb, states_of
from osc2tx_runtime.enums import SemanticTrafficLightState
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import Signal
from osc2tx_runtime.world.surroundings.traffic_light_lamps import Lamp, meaning_of
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext
    from osc2tx_runtime.world.surroundings.traffic_light_states import Signals

__all__ = [
    "Bulbs",
    "Shown",
    "TrafficLight",
    "TrafficLightBulb",
    "TrafficLightControl",
    "TrafficLightCycle",
    "TrafficLightGroup",
    "TrafficLightPhase",
    "declared_cycles",
    "states_of",
]


class TrafficLight(MapObject):
    """A traffic light with its lamps.

    Args:
        map_id: Id of the signal in the map.
        bulbs: Its lamps, top to bottom or left to right; default: those of its type.
        group: Its group; default: that of the map.
    """

    word = "traffic_light"

    def __init__(
        self,
        *,
        map_id: str | None = None,
        bulbs: Sequence[TrafficLightBulb] | None = None,
        group: TrafficLightGroup | None = None,
    ) -> None:
        super().__init__(map_id)
        self._given = None if bulbs is None else tuple(bulbs)
        self._group = group

    def find(self, signals: Signals) -> str:
        """Check that the map has the signal; return its id.

        Raises:
            ScenarioError: The map does not have it, or its lamps are unknown.
        """
        signal = self.required_id()
        if self._given is not None:
            signals.describe(signal, [Lamp(bulb.color, bulb.icon) for bulb in self._given])
        signals.lamps(signal)
        return signal

    @property
    def bulbs(self) -> tuple[TrafficLightBulb, ...]:
        """Lamps with their present states."""
        signals = self._signals
        signal = self.find(signals)
        lamps, states = signals.lamps(signal), signals.states(signal)
        return tuple(
            TrafficLightBulb(lamp.color, lamp.icon, state=state)
            for lamp, state in zip(lamps, states, strict=True)
        )

    @property
    def group(self) -> TrafficLightGroup:
        """Its group; by default that of the map, evaluated on access."""
        return self._group or TrafficLightGroup(light=self)

    @property
    def pose(self) -> Pose:
        """Pose of its lower edge, with the heading of its traffic."""
        signal, road_map = self._found(), self.context.world.map
        at = road_map.road_pose(signal.road, signal.s, signal.t)
        turn = math.pi if signal.orientation == "-" else 0.0
        yaw = math.remainder(at.h + turn + signal.h_offset, math.tau)
        return Pose(at.x, at.y, at.z + signal.z_offset, yaw=yaw)

    @property
    def height(self) -> float:
        """Height of the box (m)."""
        return self._found().height

    @property
    def width(self) -> float:
        """Width of the box (m)."""
        return self._found().width

    def _found(self) -> Signal:
        """The signal of the map."""
        wanted = self.find(self._signals)
        return next(each for each in self.context.world.map.signals() if each.id == wanted)

    def lights(self, signals: Signals) -> tuple[str, ...]:
        """Signals of its group."""
        if self._group is not None:
            return self._group.lights(signals)
        signal = self.find(signals)
        group = signals.group_of(signal)
        return (signal,) if group is None else signals.members(group)

    def state_equal(self, bulbs: Bulbs) -> bool:
        """Whether the lamps show the same as the argument."""
        signals = self._signals
        signal = self.find(signals)
        wanted = states_of(bulbs, signals.lamps(signal), f"traffic light {signal}")
        return signals.states(signal) == wanted

    def semantic_state_to_state(self, state: SemanticTrafficLightState) -> Shown:
        """The lamps of the light for a meaning."""
        return Shown(state)

    def state_to_semantic_state(self, bulbs: Bulbs) -> SemanticTrafficLightState:
        """Meaning of lamps; `non_functional` if no traffic rule covers them."""
        if isinstance(bulbs, Shown):
            return bulbs.meaning
        signals = self._signals
        signal = self.find(signals)
        lamps = signals.lamps(signal)
        return meaning_of(lamps, states_of(bulbs, lamps, f"traffic light {signal}"))


class TrafficLightGroup(MapObject):
    """Traffic lights that always show the same state.

    Args:
        map_id: Id of the controller in the map.
        traffic_lights: Its lights; default: the signals of the controller.
        light: Instead of both: a light of the group.
    """

    word = "traffic_light_group"

    def __init__(
        self,
        *,
        map_id: str | None = None,
        traffic_lights: Sequence[TrafficLight] | None = None,
        light: TrafficLight | None = None,
    ) -> None:
        super().__init__(map_id)
        self._given = None if traffic_lights is None else tuple(traffic_lights)
        self._light = light

    @property
    def context(self) -> ExecutionContext:
        """The run."""
        return super().context if self._light is None else self._light.context

    @property
    def map_id(self) -> str | None:
        """OpenDRIVE id.

        Raises:
            ScenarioError: The light is in no group of the map.
        """
        if self._light is None:
            return self._map_id
        found = self._signals.group_of(self._light.required_id())
        if found is None:
            raise ScenarioError(
                f"traffic light {self._light.map_id} belongs to no group of the map"
            )
        return found

    @property
    def name(self) -> str:
        """Its name in messages."""
        if self._light is not None:
            return f"group of {self._light.required_id()}"
        if self._given is None:
            return f"group {self.required_id()}"
        return f"group of {', '.join(light.required_id() for light in self._given)}"

    def lights(self, signals: Signals) -> tuple[str, ...]:
        """Signals of the group.

        Raises:
            ScenarioError: The map does not have it.
        """
        if self._light is not None:
            return self._light.lights(signals)
        if self._given is not None:
            return tuple(light.find(signals) for light in self._given)
        return signals.members(self.required_id())

    @property
    def traffic_lights(self) -> tuple[TrafficLight, ...]:
        """Its lights."""
        if self._given is not None:
            return self._given
        found = tuple(TrafficLight(map_id=each) for each in self.lights(self._signals))
        for light in found:
            light.bind(self.context)
        return found

    def is_same(self, other: TrafficLightGroup) -> bool:
        """Whether both are the same group."""
        if self is other:
            return True
        return self._map_id is not None and self._map_id == other._map_id

    @property
    def cycle(self) -> TrafficLightCycle:
        """The state that the `traffic_light_control` of the map requires.

        Raises:
            ScenarioError: It has no cycle of the group.
        """
        signals = self._signals
        own = set(self.lights(signals))
        for cycle in declared_cycles(self.context):
            if cycle.phases and own & set(cycle.phases[0].group.lights(signals)):
                return cycle
        raise ScenarioError(f"{self.name} has no cycle in the traffic_light_control of the map")

    @property
    def bulbs(self) -> tuple[TrafficLightBulb, ...]:
        """The lamps of all its lights with their present states."""
        return tuple(bulb for light in self.traffic_lights for bulb in light.bulbs)

    def state_equal(self, bulbs: Bulbs) -> bool:
        """Whether each light shows the same as the argument."""
        return all(light.state_equal(bulbs) for light in self.traffic_lights)


@dataclass(frozen=True, slots=True)
class TrafficLightPhase:
    """The state of a group for a duration.

    Attributes:
        group: The group.
        bulbs_state: The state of each of its lights.
        duration: Duration (s).
    """

    group: TrafficLightGroup
    bulbs_state: Bulbs
    duration: float


@dataclass(frozen=True, slots=True)
class TrafficLightCycle:
    """Phases of one group in order, repeated.

    Attributes:
        phases: The phases.
        synchronization_group_id: Cycles with the same id are synchronized.
        start_offset: Seconds from the start of playing until the first phase begins; before it
            runs the end of the cycle.
    """

    phases: Sequence[TrafficLightPhase]
    synchronization_group_id: int | None = None
    start_offset: float = 0.0


class TrafficLightControl:
    """The owner of the cycles of traffic lights: the map.

    Attributes:
        traffic_light_control: The cycles.
    """

    traffic_light_control: list[TrafficLightCycle]


def declared_cycles(context: ExecutionContext) -> tuple[TrafficLightCycle, ...]:
    """The cycles that the map of a run has in its `traffic_light_control`."""
    actors = context.actors.values()
    maps = (each for each in actors if isinstance(each, TrafficLightControl))
    return tuple(cycle for each in maps for cycle in each.traffic_light_control)

"""Traffic lights as scenarios name them (DSL 8.15): lamps, boxes, groups.

A `traffic_light` is a dynamic signal of the map, a `traffic_light_group` one of its controllers;
`map_id` is their OpenDRIVE id.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.lamps import (
    BulbColor,
    BulbState,
    Lamp,
    Meaning,
    lamps_that_mean,
    meaning_of,
)

if TYPE_CHECKING:
    from osc2tx_runtime.context import ExecutionContext
    from osc2tx_runtime.world.signals import Signals

__all__ = [
    "Bulbs",
    "MapObject",
    "Shown",
    "TrafficLight",
    "TrafficLightBulb",
    "TrafficLightGroup",
    "states_of",
]


@dataclass(frozen=True, slots=True)
class TrafficLightBulb:
    """A lamp.

    Attributes:
        color: Its color.
        icon: The symbol on it.
        map_id: Its id in the map; maps have none.
        icon_positive: The symbol shines, on dark ground.
        state: What it does now.
    """

    color: BulbColor
    icon: str = "circle"
    map_id: str | None = None
    icon_positive: bool = True
    state: BulbState = "unknown"


@dataclass(frozen=True, slots=True)
class Shown:
    """What a box shows when it means something; its lamps are known once there is a map.

    Attributes:
        meaning: The meaning.
    """

    meaning: Meaning


Bulbs = Sequence[TrafficLightBulb] | Sequence[BulbState] | Shown
"""Lamps in their states, plain states, or what they are to mean."""


def states_of(bulbs: Bulbs, lamps: Sequence[Lamp], what: str) -> tuple[BulbState, ...]:
    """States of the lamps of a box, in their order.

    Raises:
        ScenarioError: They do not fit the lamps of the box.
    """
    if isinstance(bulbs, Shown):
        states = lamps_that_mean(lamps, bulbs.meaning)
        if states is None:
            raise ScenarioError(f"{what} has no lamps that mean {bulbs.meaning}")
        return states
    if len(bulbs) != len(lamps):
        raise ScenarioError(f"{what} has {len(lamps)} lamps, not {len(bulbs)}")
    return tuple(bulb.state if isinstance(bulb, TrafficLightBulb) else bulb for bulb in bulbs)


class MapObject:
    """Something of the map; its live members can be read while the scenario runs.

    Attributes:
        map_id: OpenDRIVE id.
        source: Where it is declared.
    """

    word = ""

    def __init__(self, map_id: str | None) -> None:
        self.map_id = map_id
        self.source: str | None = None
        self._context: ExecutionContext | None = None

    def bind(self, context: ExecutionContext) -> None:
        """Joins a run."""
        self._context = context

    @property
    def _signals(self) -> Signals:
        if self._context is None:
            raise ScenarioError(f"{self.word} {self.map_id} is read before the scenario runs")
        return self._context.world.signals

    def required_id(self) -> str:
        """The OpenDRIVE id.

        Raises:
            ScenarioError: It has none.
        """
        if self.map_id is None:
            raise ScenarioError(
                f"a {self.word} is in no map without its id: keep(it.map_id == ...)"
            )
        return self.map_id


class TrafficLight(MapObject):
    """A box of lamps.

    Args:
        map_id: Id of the signal in the map.
        bulbs: Its lamps, top to bottom or left to right; default: those of its type.
        group: The group it belongs to; default: that of the map.
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
        """Id of the signal, once the map is known to have it.

        Raises:
            ScenarioError: The map does not have it, or its lamps are not known.
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
        """The group it belongs to."""
        if self._group is not None:
            return self._group
        found = self._signals.group_of(self.required_id())
        if found is None:
            raise ScenarioError(f"traffic light {self.map_id} belongs to no group of the map")
        group = TrafficLightGroup(map_id=found)
        group._context = self._context
        return group

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

    def semantic_state_to_state(self, state: Meaning) -> Shown:
        """What the box shows when it means this."""
        return Shown(state)

    def state_to_semantic_state(self, bulbs: Bulbs) -> Meaning:
        """What lamps mean; `non_functional` where no rule of traffic covers them."""
        if isinstance(bulbs, Shown):
            return bulbs.meaning
        signals = self._signals
        signal = self.find(signals)
        lamps = signals.lamps(signal)
        return meaning_of(lamps, states_of(bulbs, lamps, f"traffic light {signal}"))


class TrafficLightGroup(MapObject):
    """Boxes that always show the same.

    Args:
        map_id: Id of the controller in the map.
        traffic_lights: Its boxes; default: the signals of the controller.
    """

    word = "traffic_light_group"

    def __init__(
        self,
        *,
        map_id: str | None = None,
        traffic_lights: Sequence[TrafficLight] | None = None,
    ) -> None:
        super().__init__(map_id)
        self._given = None if traffic_lights is None else tuple(traffic_lights)

    @property
    def name(self) -> str:
        """What messages call it."""
        if self._given is None:
            return f"group {self.required_id()}"
        return f"group of {', '.join(light.required_id() for light in self._given)}"

    def lights(self, signals: Signals) -> tuple[str, ...]:
        """Signals of the group.

        Raises:
            ScenarioError: The map does not have it.
        """
        if self._given is not None:
            return tuple(light.find(signals) for light in self._given)
        return signals.members(self.required_id())

    @property
    def traffic_lights(self) -> tuple[TrafficLight, ...]:
        """Its boxes."""
        if self._given is not None:
            return self._given
        found = tuple(TrafficLight(map_id=each) for each in self.lights(self._signals))
        for light in found:
            light._context = self._context
        return found

    @property
    def bulbs(self) -> tuple[TrafficLightBulb, ...]:
        """The lamps of all its boxes with their present states."""
        return tuple(bulb for light in self.traffic_lights for bulb in light.bulbs)

    def state_equal(self, bulbs: Bulbs) -> bool:
        """Whether every box shows the same as the argument."""
        return all(light.state_equal(bulbs) for light in self.traffic_lights)

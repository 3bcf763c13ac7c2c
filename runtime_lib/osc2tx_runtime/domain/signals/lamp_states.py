"""States of traffic light bulbs and their meanings (DSL 8.15.2)."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx_runtime.enums import BulbColor, BulbIcon, BulbState, SemanticTrafficLightState
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.surroundings.traffic_light_lamps import Lamp, lamps_that_mean
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class TrafficLightBulb:
    """A lamp.

    Attributes:
        color: Its color.
        icon: The symbol on it.
        map_id: Its id in the map; maps have none.
        icon_positive: Whether the symbol shines on a dark ground.
        state: Its present state.
    """

    color: BulbColor
    icon: BulbIcon = "circle"
    map_id: str | None = None
    icon_positive: bool = True
    state: BulbState = "unknown"


@dataclass(frozen=True, slots=True)
class Shown:
    """The lamps for a meaning of a light, known once the map is loaded.

    Attributes:
        meaning: The meaning.
    """

    meaning: SemanticTrafficLightState


Bulbs = Sequence[TrafficLightBulb | BulbState] | Shown
"""Lamps in their states, plain states, or a meaning."""


def states_of(bulbs: Bulbs, lamps: Sequence[Lamp], what: str) -> tuple[BulbState, ...]:
    """States of the lamps of a light, in their order.

    Raises:
        ScenarioError: They do not fit the lamps of the light.
    """
    if isinstance(bulbs, Shown):
        states = lamps_that_mean(lamps, bulbs.meaning)
        if states is None:
            raise ScenarioError(f"{what} has no lamps that mean {bulbs.meaning}")
        return states
    if len(bulbs) != len(lamps):
        raise ScenarioError(f"{what} has {len(lamps)} lamps, not {len(bulbs)}")
    return tuple(bulb.state if isinstance(bulb, TrafficLightBulb) else bulb for bulb in bulbs)

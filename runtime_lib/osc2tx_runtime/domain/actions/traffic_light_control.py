"""Actions of traffic light controllers (DSL 8.15.9).

What a light shows lasts until it is switched again. A box or group the map does not have, lamps
that do not fit, and cycles that cannot be played are refused before the scenario starts.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Unpack

from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.enums import BulbColor, BulbIcon, BulbState, SemanticTrafficLightState
from osc2tx_runtime.language.action import ActionOptions
from osc2tx_runtime.language.registry import action

from .light_switching import AllLamps, OneLamp, Saying, Switch

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import TrafficLightController
    from osc2tx_runtime.domain.signals.traffic_lights import Bulbs, TrafficLight, TrafficLightGroup
    from osc2tx_runtime.world.traffic_light_states import Signals

__all__ = [
    "SetBulbState",
    "SetGroupBulbState",
    "SetGroupSemanticState",
    "SetGroupState",
    "SetSemanticState",
    "SetState",
]


def _alone(light: TrafficLight) -> Callable[[Signals], tuple[str, ...]]:
    return lambda signals: (light.find(signals),)


@action("traffic_light_controller", "set_bulb_state", ends="instant", needs=("traffic_lights",))
class SetBulbState(Switch):
    """Switch one lamp of a box, chosen by its color and symbol."""

    def __init__(
        self,
        actor: TrafficLightController,
        *modifiers: Modifier,
        traffic_light: TrafficLight,
        bulb_color: BulbColor,
        bulb_kind: BulbIcon,
        bulb_state: BulbState,
        sync: bool = False,
        **options: Unpack[ActionOptions],
    ) -> None:
        lamp = OneLamp(bulb_color, bulb_kind, bulb_state)
        super().__init__(actor, modifiers, _alone(traffic_light), sync, lamp, options)


@action("traffic_light_controller", "set_state", ends="instant", needs=("traffic_lights",))
class SetState(Switch):
    """Switch all lamps of a box, in their order."""

    def __init__(
        self,
        actor: TrafficLightController,
        *modifiers: Modifier,
        traffic_light: TrafficLight,
        state: Bulbs,
        sync: bool = False,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, _alone(traffic_light), sync, AllLamps(state), options)


@action("traffic_light_controller", "set_semantic_state", ends="instant", needs=("traffic_lights",))
class SetSemanticState(Switch):
    """Let a box say something; ignored if it has no lamps for it."""

    def __init__(
        self,
        actor: TrafficLightController,
        *modifiers: Modifier,
        traffic_light: TrafficLight,
        state: SemanticTrafficLightState,
        sync: bool = False,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, _alone(traffic_light), sync, Saying(state), options)


@action(
    "traffic_light_controller", "set_group_bulb_state", ends="instant", needs=("traffic_lights",)
)
class SetGroupBulbState(Switch):
    """Switch one lamp in every box of the group that a light belongs to."""

    def __init__(
        self,
        actor: TrafficLightController,
        *modifiers: Modifier,
        traffic_light: TrafficLight,
        bulb_color: BulbColor,
        bulb_kind: BulbIcon,
        bulb_state: BulbState,
        sync: bool = False,
        **options: Unpack[ActionOptions],
    ) -> None:
        lamp = OneLamp(bulb_color, bulb_kind, bulb_state)
        super().__init__(actor, modifiers, traffic_light.lights, sync, lamp, options)


@action("traffic_light_controller", "set_group_state", ends="instant", needs=("traffic_lights",))
class SetGroupState(Switch):
    """Switch all lamps of every box of a group."""

    def __init__(
        self,
        actor: TrafficLightController,
        *modifiers: Modifier,
        group: TrafficLightGroup,
        state: Bulbs,
        sync: bool = False,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, group.lights, sync, AllLamps(state), options)


@action(
    "traffic_light_controller",
    "set_group_semantic_state",
    ends="instant",
    needs=("traffic_lights",),
)
class SetGroupSemanticState(Switch):
    """Let every box of a group say something; boxes without lamps for it ignore it."""

    def __init__(
        self,
        actor: TrafficLightController,
        *modifiers: Modifier,
        traffic_light_group: TrafficLightGroup,
        state: SemanticTrafficLightState,
        sync: bool = False,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, traffic_light_group.lights, sync, Saying(state), options)

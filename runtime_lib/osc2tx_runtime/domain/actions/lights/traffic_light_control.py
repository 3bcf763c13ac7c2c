"""Actions of traffic light controllers (DSL 8.15.9).

The state of a light lasts until it is switched again. Lights and groups that the map does not have,
unsuitable lamps, and invalid cycles are rejected before the scenario starts.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Unpack

from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.domain.signals.traffic_light_cycles import check_cycle, moment_of
from osc2tx_runtime.domain.signals.traffic_lights import states_of
from osc2tx_runtime.enums import BulbColor, BulbIcon, BulbState, SemanticTrafficLightState
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.language.actions.registry import action
from osc2tx_runtime.language.tree.base import Status

from .light_switching import AllLamps, OneLamp, Saying, SignalAction, Switch

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import TrafficLightController
    from osc2tx_runtime.domain.signals.traffic_lights import (
        Bulbs,
        TrafficLight,
        TrafficLightCycle,
        TrafficLightGroup,
    )
    from osc2tx_runtime.world.surroundings.traffic_light_states import Signals


@action("traffic_light_controller", "play_cycles", ends="open", needs=("traffic_lights",))
class PlayCycles(SignalAction):
    """Repeat cycles until another action switches one of the lights.

    Args:
        actor: The controller.
        *modifiers: None are taken.
        cycles: At most one for each light.
        **options: Duration and label.
    """

    def __init__(
        self,
        actor: TrafficLightController,
        *modifiers: Modifier,
        cycles: Sequence[TrafficLightCycle],
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.cycles = cycles  # cycles of a file are only available at setup
        self.playing: tuple[tuple[TrafficLightCycle, tuple[str, ...]], ...] = ()
        self._phases: dict[str, int] = {}

    def find(self) -> None:
        """Find the lights, and check that the cycles fit them."""
        signals = self.signals
        playing: dict[str, TrafficLightCycle] = {}
        found = []
        for cycle in self.cycles:
            check_cycle(cycle)
            lights = cycle.phases[0].group.lights(signals)
            for signal in lights:
                if signal in playing:
                    raise ScenarioError(f"two cycles are about traffic light {signal}")
                playing[signal] = cycle
                for phase in cycle.phases:
                    states_of(phase.bulbs_state, signals.lamps(signal), phase.group.name)
            found.append((cycle, lights))
        if not found:
            raise ScenarioError("there is no cycle to play")
        self.playing = tuple(found)

    def on_start(self) -> None:
        """Shows the first phases."""
        self._phases = {}
        self._play()

    def on_update(self) -> Status:
        """Shows the present phase; ends if another action has switched a light."""
        if self.elapsed_steps == 0:
            return Status.RUNNING
        lights = [signal for _, each in self.playing for signal in each]
        if any(self.signals.shown_by(signal) is not self for signal in lights):
            return Status.SUCCESS
        self._play()
        return Status.RUNNING

    def _play(self) -> None:
        """Switches the lights whose phase begins."""
        for cycle, lights in self.playing:
            moment = moment_of(cycle, self.elapsed)
            for signal in lights:
                if self._phases.get(signal) == moment.number:
                    continue
                self._phases[signal] = moment.number
                lamps = self.signals.lamps(signal)
                states = states_of(moment.phase.bulbs_state, lamps, moment.phase.group.name)
                # A separate kind of effect: an action that switches the light does not conflict
                # with it. It comes later (the kinds are applied by name) and ends this action.
                self.switch("cycle of light", signal, dict(enumerate(states)))


def _alone(light: TrafficLight) -> Callable[[Signals], tuple[str, ...]]:
    return lambda signals: (light.find(signals),)


@action("traffic_light_controller", "set_bulb_state", ends="instant", needs=("traffic_lights",))
class SetBulbState(Switch):
    """Switch one lamp of a traffic light, chosen by its color and symbol."""

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
    """Switch all lamps of a traffic light, in their order."""

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
    """Set the semantic state of a traffic light; ignored if it has no lamps for it."""

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
    """Switch one lamp of each traffic light in the group of a light."""

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
    """Switch all lamps of each traffic light in a group."""

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
    """Set the semantic state of each traffic light in a group.

    Lights without lamps for it ignore it.
    """

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

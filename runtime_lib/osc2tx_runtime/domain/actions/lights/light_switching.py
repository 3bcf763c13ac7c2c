"""Base classes of the traffic light actions: find the lights, switch their lamps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.domain.signals.traffic_light_cycles import check_cycle, moment_of, time_of
from osc2tx_runtime.domain.signals.traffic_lights import declared_cycles, states_of
from osc2tx_runtime.enums import BulbColor, BulbIcon, BulbState, SemanticTrafficLightState
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.actions.action import Action, ActionOptions
from osc2tx_runtime.language.tree.base import Status
from osc2tx_runtime.world.surroundings.traffic_light_lamps import lamps_that_mean, meaning_of
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import TrafficLightController
    from osc2tx_runtime.domain.signals.traffic_lights import Bulbs, TrafficLightCycle
    from osc2tx_runtime.world.surroundings.traffic_light_lamps import Lamp
    from osc2tx_runtime.world.surroundings.traffic_light_states import Signals


class SignalAction(Action):
    """Base class of the traffic light actions."""

    @property
    def signals(self) -> Signals:
        """The lights of the world."""
        return self.context.world.signals

    def setup(self, **kwargs: Any) -> None:
        """Checks that the map has the lights to switch."""
        super().setup(**kwargs)
        try:
            self.find()
        except ScenarioError as error:
            error.message = f"{self.action_name}: {error.message}"
            error.source = error.source or self.source or None
            raise

    def find(self) -> None:
        """Find the lights on the map.

        Raises:
            ScenarioError: The map does not have them.
        """
        raise NotImplementedError

    def switch(self, kind: str, signal: str, states: Mapping[int, BulbState]) -> None:
        """Request new states of lamps of a light, by their numbers in it."""
        for lamp, state in states.items():
            apply = partial(self._switch, signal, lamp, state)
            self.context.effect((f"{kind} {signal} lamp {lamp}",), self, state, apply)

    def _switch(self, signal: str, lamp: int, state: BulbState) -> None:
        if self.signals.show(signal, lamp, state, self):
            self.note(signal, self.signals.states(signal))

    def note(self, signal: str, states: Sequence[BulbState], ignored: str | None = None) -> None:
        """Write meaning and lamps of a light to the trace, and meanings that it cannot show."""
        meaning = meaning_of(self.signals.lamps(signal), states)
        self.context.trace.signal(signal, meaning, states, ignored)


@dataclass(frozen=True, slots=True)
class OneLamp:
    """One lamp of a light, chosen by its color and symbol."""

    color: BulbColor
    icon: BulbIcon
    state: BulbState

    def states(self, signal: str, lamps: Sequence[Lamp]) -> Mapping[int, BulbState]:
        """The color of the lamp."""
        found = [i for i, lamp in enumerate(lamps) if lamp == (self.color, self.icon)]
        if not found:
            has = ", ".join(f"{lamp.color} {lamp.icon}" for lamp in lamps)
            raise ScenarioError(
                f"traffic light {signal} has no lamp {self.color} {self.icon}; it has {has}"
            )
        return dict.fromkeys(found, self.state)


@dataclass(frozen=True, slots=True)
class AllLamps:
    """All lamps of a light, in their order."""

    state: Bulbs

    def states(self, signal: str, lamps: Sequence[Lamp]) -> Mapping[int, BulbState]:
        """The given states."""
        return dict(enumerate(states_of(self.state, lamps, f"traffic light {signal}")))


@dataclass(frozen=True, slots=True)
class Saying:
    """A semantic state; lights that cannot show it keep their states (DSL 8.15.9.3)."""

    state: SemanticTrafficLightState

    def states(self, signal: str, lamps: Sequence[Lamp]) -> Mapping[int, BulbState] | None:
        """The states that mean it."""
        states = lamps_that_mean(lamps, self.state)
        return None if states is None else dict(enumerate(states))


class Switch(SignalAction):
    """Switches the lamps of lights instantly.

    Args:
        actor: The actor.
        modifiers: None are accepted.
        lights: The lights.
        sync: Also switch the lights that are synchronized with them.
        shown: The state to show.
        options: Duration and label.
    """

    def __init__(
        self,
        actor: TrafficLightController,
        modifiers: tuple[Modifier, ...],
        lights: Callable[[Signals], tuple[str, ...]],
        sync: bool,
        shown: OneLamp | AllLamps | Saying,
        options: ActionOptions,
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.lights = lights
        self.sync = sync
        self.shown = shown

    def find(self) -> None:
        """Find the lights, and check whether they can show the state."""
        for signal in self.lights(self.signals):
            self.new_states(signal)
        if self.sync:
            self._cycles()

    def new_states(self, signal: str) -> Mapping[int, BulbState] | None:
        """New states of lamps by their numbers; None if the light cannot show the state."""
        return self.shown.states(signal, self.signals.lamps(signal))

    def on_start(self) -> None:
        """Switches the lamps, also those of synchronized lights."""
        for signal in self.lights(self.signals):
            states = self.new_states(signal)
            if states is None:
                apply = partial(self._ignore, signal)
                self.context.effect((f"ignored {signal}",), self, None, apply)
                continue
            self.switch("traffic light", signal, states)
            if self.sync:
                now = self.signals.states(signal)
                self._in_step(signal, [states.get(lamp, old) for lamp, old in enumerate(now)])

    def on_update(self) -> Status:
        """Ends in the same step."""
        return Status.SUCCESS

    def _ignore(self, signal: str) -> None:
        self.note(signal, self.signals.states(signal), str(self.shown.state))

    def _cycles(self) -> tuple[TrafficLightCycle, ...]:
        cycles = declared_cycles(self.context)
        if not cycles:
            raise ScenarioError(
                "sync needs to know which lights keep in step: keep(it.traffic_light_control =="
                " [...]) of the map"
            )
        for cycle in cycles:
            check_cycle(cycle)
        return cycles

    def _in_step(self, signal: str, states: Sequence[BulbState]) -> None:
        """Switches the lights of the same synchronization group to their states at that time."""
        signals, cycles = self.signals, self._cycles()
        own = next((c for c in cycles if signal in c.phases[0].group.lights(signals)), None)
        time = None if own is None else time_of(own, states, signals.lamps(signal))
        if own is None or time is None or own.synchronization_group_id is None:
            return  # no state is known to be consistent with it
        switched = self.lights(signals)
        for cycle in cycles:
            if cycle is own or cycle.synchronization_group_id != own.synchronization_group_id:
                continue
            phase = moment_of(cycle, own.start_offset + time).phase
            for other in phase.group.lights(signals):
                if other not in switched:
                    new = states_of(phase.bulbs_state, signals.lamps(other), phase.group.name)
                    self.switch("traffic light", other, dict(enumerate(new)))

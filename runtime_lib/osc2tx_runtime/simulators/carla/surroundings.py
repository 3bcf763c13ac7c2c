"""Lights, weather, friction and traffic lights: written where they change."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from osc2tx_runtime.world.scene import Scene

from .cast import CastMember, Command
from .client_process import ClientProcess
from .traffic_lights import lamps_for, state_for
from .vehicle_lights import FLAGS
from .weather import losses_of, weather_of

__all__ = ["CarlaSurroundings"]

TYRE_FRICTION = 3.5
"""Of CARLA's vehicles: what holds on a dry road."""


class CarlaSurroundings:
    """What is around the actors, and what shines on them.

    Args:
        client: A connected one.
    """

    def __init__(self, client: ClientProcess) -> None:
        self._client = client
        self._lit: dict[str, int] = {}
        self._environment: Mapping[str, float] = {}
        self._adhesion = 1.0
        self._signals: frozenset[str] = frozenset()
        self._shown: dict[str, str] = {}

    def begin(self) -> None:
        """Find the traffic lights."""
        self._signals = frozenset(self._client.ask("traffic_lights"))

    def commands(self, scene: Scene, members: Mapping[str, CastMember]) -> Iterator[Command]:
        """Bring the surroundings of the next step about; yields what goes with its batch."""
        self._set_weather(scene)
        self._set_traffic_lights(scene)
        yield from self._vehicle_lights(scene, members)

    def _set_weather(self, scene: Scene) -> None:
        environment = dict(scene.environment)
        if environment != self._environment:
            before, weather = weather_of(self._environment), weather_of(environment)
            self._environment = environment
            changed = dict(weather.items() - before.items())
            if changed:
                self._client.ask("set_weather", changed)
            for loss in losses_of(environment):
                scene.warn(loss)
        if scene.adhesion != self._adhesion:
            self._adhesion = scene.adhesion
            friction = None if scene.adhesion == 1.0 else TYRE_FRICTION * scene.adhesion
            self._client.ask("set_friction", friction)

    def _vehicle_lights(self, scene: Scene, members: Mapping[str, CastMember]) -> Iterator[Command]:
        for actor, lights in scene.lights.items():
            member = members[actor]
            flags = FLAGS[lights.lit]
            if member.is_vehicle and flags != self._lit.get(actor, 0):
                self._lit[actor] = flags
                yield ("lights", member.actor, flags)

    def _set_traffic_lights(self, scene: Scene) -> None:
        """The first switch by the scenario stops all cycles: CARLA stops all or none."""
        signals = scene.signals
        for name in sorted(self._signals):
            if signals.shown_by(name) is None:
                continue
            if not self._shown:
                self._client.ask("freeze_lights")
            state = state_for(signals.lamps(name), signals.states(name))
            if self._shown.get(name) != state:
                self._shown[name] = state
                self._client.ask("set_light", name, state)

    def observe(self, scene: Scene, states: Mapping[str, Any]) -> None:
        """Tell the scenario what the lights show that it has not switched."""
        signals = scene.signals
        for name, state in states.items():
            if name in self._shown or name not in self._signals:
                continue
            lamps = lamps_for(signals.lamps(name), state)
            if lamps is not None and lamps != signals.states(name):
                signals.observe(name, lamps)

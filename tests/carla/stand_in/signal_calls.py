"""Calls about traffic lights. Methods have the calls' names."""

from __future__ import annotations

from .actors import Light
from .rpc import CallError
from .simulation import Simulation
from .traffic_lights import GREEN, RED, YELLOW


class SignalCalls:
    """States, times, freezing."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation

    def _light(self, actor: int) -> Light:
        light = self._simulation.actor(actor).light
        if light is None:
            raise CallError(f"actor {actor} is no traffic light")
        return light

    def set_traffic_light_state(self, actor: int, state: int) -> None:
        light = self._light(actor)
        light.state, light.since = state, 0.0

    def set_traffic_light_red_time(self, actor: int, seconds: float) -> None:
        self._light(actor).times[RED] = seconds

    def set_traffic_light_yellow_time(self, actor: int, seconds: float) -> None:
        self._light(actor).times[YELLOW] = seconds

    def set_traffic_light_green_time(self, actor: int, seconds: float) -> None:
        self._light(actor).times[GREEN] = seconds

    def freeze_traffic_light(self, actor: int, frozen: bool) -> None:
        self.freeze_all_traffic_lights(frozen)  # so the real one: not only this light

    def freeze_all_traffic_lights(self, frozen: bool) -> None:
        for _, light in self._simulation.lights():
            light.frozen = frozen

    def reset_all_traffic_lights(self) -> None:
        for _, light in self._simulation.lights():
            light.state, light.since = RED, 0.0

    def get_group_traffic_lights(self, actor: int) -> list[int]:
        self._light(actor)
        return [actor]

"""Weather, light, and their effects: friction, automatic lights."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from osc2tx_runtime.world.grip.friction import RoadCondition, road_condition
from osc2tx_runtime.world.protocol import (
    FOG_LIGHT_RANGE,
    LOW_BEAM_SUN_ELEVATION,
    LightMode,
    LightState,
)
from osc2tx_runtime.world.surroundings.sun_and_moon import Sky


class Surroundings:
    """The environment.

    Args:
        dt: Length of a step (s).

    Attributes:
        road: Condition of the roads up to the next step.
        sky: Astronomical positions of sun and moon; None: not stated.
        values: The environment at the present step.
    """

    def __init__(self, dt: float) -> None:
        self.road: RoadCondition = "dry"
        self._now: dict[str, float] = {}
        self._pinned: set[str] = set()
        self.sky: Sky | None = None
        self._dt, self._steps = dt, 0
        self.values: Mapping[str, float] = MappingProxyType(self._now)

    def begin_under(self, sky: Sky) -> None:
        """Moves sun and moon from step 0, unless an action sets them."""
        self.sky = sky
        self._move_lights(0)

    def set(self, values: Mapping[str, float]) -> None:
        """Changes values; the others are unchanged."""
        self._now.update(values)
        self._pinned.update(values)
        self.road = road_condition(self._now)

    @property
    def sight(self) -> float:
        """Visual range (m) at the present step."""
        return self._now.get("visual_range", math.inf)

    @property
    def automatic_light(self) -> LightMode:
        """State of lights in mode `auto`."""
        elevation = self._now.get("sun_elevation", LOW_BEAM_SUN_ELEVATION)
        dark = elevation < LOW_BEAM_SUN_ELEVATION
        foggy = self._now.get("visual_range", math.inf) < FOG_LIGHT_RANGE
        return "low_beam" if dark or foggy else "off"

    def step(self) -> None:
        """Advances to the next step."""
        self._steps += 1
        if self.sky is not None:
            self._move_lights(self._steps)

    def _move_lights(self, steps: int) -> None:
        assert self.sky is not None
        computed = self.sky.values(steps * self._dt)
        self._now.update({k: v for k, v in computed.items() if k not in self._pinned})


class Lights:
    """Lights of the vehicles.

    Attributes:
        all: By actor.
    """

    def __init__(self) -> None:
        self._now: dict[str, LightState] = {}
        self.all: Mapping[str, LightState] = MappingProxyType(self._now)

    def add(self, actor: str) -> None:
        """Adds a vehicle, with its lights off."""
        self._now[actor] = LightState()

    def of(self, actor: str) -> LightState:
        """Lights of a vehicle at the present step."""
        return self._now.get(actor, LightState())

    def switch(self, actor: str, mode: LightMode, automatic: LightMode) -> LightState:
        """Switches lights; returns their new states."""
        lights = LightState(mode, automatic if mode == "auto" else mode)
        self._now[actor] = lights
        return lights

    def follow(self, automatic: LightMode) -> Mapping[str, LightState]:
        """Switches automatic lights; returns the changed ones."""
        lights = LightState("auto", automatic)
        switched = {
            actor: lights
            for actor, now in self._now.items()
            if now.mode == "auto" and now != lights
        }
        self._now.update(switched)
        return switched

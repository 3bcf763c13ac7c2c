"""Lights, weather, friction and traffic lights: written when they change."""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from osc2tx_runtime.enums import BulbState
from osc2tx_runtime.world.plant.scene import Scene
from osc2tx_runtime.world.protocol import EXTERNAL, LightMode
from osc2tx_runtime.world.surroundings.traffic_light_lamps import Lamp

from .cast import CastMember, Command
from .client_process import ClientProcess
from .motion_lights import MotionLights

STATES = (("Red", "red"), ("Yellow", "yellow"), ("Green", "green"))
"""State and color, from stop to go."""

DARK = ("is_off", "unknown")


def state_for(lamps: Sequence[Lamp], shown: Sequence[BulbState]) -> str:
    """Return the state for lamps; yellow with red is yellow."""
    lit = {lamp.color for lamp, state in zip(lamps, shown, strict=True) if state not in DARK}
    if "yellow" in lit:
        return "Yellow"
    return next((state for state, color in STATES if color in lit), "Off")


def lamps_for(lamps: Sequence[Lamp], state: str) -> tuple[BulbState, ...] | None:
    """Return the lamps of a light in a state; None if they are unknown."""
    if state == "Unknown":
        return None
    color = dict(STATES).get(state)
    return tuple("is_on" if lamp.color == color else "is_off" for lamp in lamps)


LONGEST_ID = 32
"""Greatest length (bytes) of the id of a signal in snapshots (`ActorDynamicState.h`)."""


def same_ids(ours: Iterable[str], theirs: Iterable[str]) -> Mapping[str, str]:
    """Return the ids of lights on the server by those on the map.

    Longer ids are truncated: a common prefix of several ids of the map is ambiguous, and ignored.
    """
    found = {_cut(each): each for each in theirs}
    alike = Counter(map(_cut, ours := list(ours)))
    return {
        each: found[_cut(each)] for each in ours if found.get(_cut(each)) and alike[_cut(each)] == 1
    }


def _cut(name: str) -> bytes:
    return name.encode()[:LONGEST_ID]


POSITION, LOW_BEAM, HIGH_BEAM = 1, 2, 4

FLAGS: Mapping[LightMode, int] = {
    "off": 0,
    "daytime": POSITION,  # CARLA has no daytime running lights
    "position": POSITION,
    "low_beam": POSITION | LOW_BEAM,
    "high_beam": POSITION | LOW_BEAM | HIGH_BEAM,
}
"""Flags of `carla.VehicleLightState` by shining light."""


HOUR = 3600.0
MM = 1000.0


def _percent(value: float) -> float:
    return min(max(value, 0.0), 100.0)


def _rain(intensity: float) -> dict[str, float]:
    """From m/s of water: 50 mm/h, a cloudburst, is the maximum in CARLA."""
    percent = _percent(2.0 * intensity * MM * HOUR)
    wet = _percent(30.0 + percent) if percent else 0.0
    return {"precipitation": percent, "precipitation_deposits": wet, "wetness": wet}


def _fog(visual_range: float) -> dict[str, float]:
    """Dense at a visual range of 50 m, clear from 5 km."""
    density = 0.0 if visual_range >= 5000.0 else _percent(5000.0 / max(visual_range, 1.0))
    return {"fog_density": density, "fog_distance": 0.0}


FIELDS: Mapping[str, Callable[[float], Mapping[str, float]]] = {
    "sun_elevation": lambda rad: {"sun_altitude_angle": math.degrees(rad)},
    "sun_azimuth": lambda rad: {"sun_azimuth_angle": math.degrees(rad) % 360.0},
    "cloudiness": lambda okta: {"cloudiness": _percent(12.5 * okta)},
    "rain_intensity": _rain,
    "visual_range": _fog,
    "wind_speed": lambda speed: {"wind_intensity": _percent(speed / 0.3)},
}
"""Name of a value of the environment -> fields of `carla.WeatherParameters`."""


APPROXIMATED: Mapping[str, str] = {
    "sun_azimuth": "the azimuth of the sun counts from a direction of CARLA's own, not from north",
    "rain_intensity": "rain is a percentage in CARLA: 50 mm/h are its most",
    "visual_range": "fog is a percentage in CARLA: dense where one sees 50 m",
    "wind_speed": "wind is a percentage in CARLA: 30 m/s are its most",
}
MISSING: Mapping[str, str] = {
    "snow_intensity": "CARLA shows no snow",
    "temperature": "CARLA has no temperature",
    "pressure": "CARLA has no air pressure",
    "relative_humidity": "CARLA has no humidity",
    "wind_direction": "wind has no direction in CARLA",
}
"""Quantities that CARLA lacks: their effects and conditions hold, but are not visible."""


def losses_of(environment: Mapping[str, float]) -> tuple[str, ...]:
    """Return the parts of an environment that CARLA does not show, or only approximates."""
    losses = {**APPROXIMATED, **MISSING}
    return tuple(losses[name] for name in losses if environment.get(name))


def weather_of(environment: Mapping[str, float]) -> Mapping[str, float]:
    """Return the fields of CARLA's weather for an environment in SI units."""
    fields: dict[str, float] = {}
    for name, value in environment.items():
        if name in FIELDS:
            fields.update(FIELDS[name](value))
    return fields


TYRE_FRICTION = 3.5
"""Friction of CARLA's vehicles on a dry road."""


class CarlaSurroundings:
    """The surroundings of the actors, and their lights.

    Args:
        client: A connected session.
    """

    def __init__(self, client: ClientProcess) -> None:
        self._client = client
        self._lit: dict[str, int] = {}
        self._moving: defaultdict[str, MotionLights] = defaultdict(MotionLights)
        self._environment: Mapping[str, float] = {}
        self._adhesion = 1.0
        self._signals: Mapping[str, str] = {}  # ids of the map -> ids of the server
        self._shown: dict[str, str] = {}

    def begin(self, scene: Scene, *, ticks: bool) -> None:
        """Find the traffic lights; their cycles begin with the run if it makes the steps."""
        there = self._client.ask("traffic_lights")
        self._signals = same_ids([each.id for each in scene.map.signals() if each.dynamic], there)
        if self._signals and ticks:
            self._client.ask("reset_lights")

    def commands(self, scene: Scene, members: Mapping[str, CastMember]) -> Iterator[Command]:
        """Set the surroundings of the next step; yield the commands of its batch."""
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
        for actor, member in members.items():
            if not member.is_vehicle or member.removed:
                continue
            lights = scene.lights.get(actor)
            flags = 0 if lights is None else FLAGS[lights.lit]
            if member.control not in EXTERNAL:  # their own drivers switch brake lights
                flags |= self._moving[actor].after(scene.setpoints[actor])
            if flags != self._lit.get(actor, 0):
                self._lit[actor] = flags
                yield ("lights", member.actor, flags)

    def _set_traffic_lights(self, scene: Scene) -> None:
        """The first switch by the scenario stops all cycles: CARLA stops all or none."""
        signals = scene.signals
        for name, theirs in sorted(self._signals.items()):
            if signals.shown_by(name) is None:
                continue
            if not self._shown:
                self._client.ask("freeze_lights")
            state = state_for(signals.lamps(name), signals.states(name))
            if self._shown.get(name) != state:
                self._shown[name] = state
                self._client.ask("set_light", theirs, state)

    def observe(self, scene: Scene, states: Mapping[str, Any]) -> None:
        """Report to the scenario the states of lights that it has not switched."""
        signals = scene.signals
        for name, theirs in self._signals.items():
            if name in self._shown:
                continue
            lamps = lamps_for(signals.lamps(name), states[theirs])
            if lamps is not None and lamps != signals.states(name):
                signals.observe(name, lamps)

"""Weather in CARLA's words.

Rain, fog and wind are percentages without a unit there, so they are approximated. CARLA has
nothing for snow, temperature, pressure, humidity, the moon and the direction of the wind;
conditions on them and their effects on the motion hold all the same.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

__all__ = ["losses_of", "weather_of"]

HOUR = 3600.0
MM = 1000.0


def _percent(value: float) -> float:
    return min(max(value, 0.0), 100.0)


def _rain(intensity: float) -> dict[str, float]:
    """From m/s of water: 50 mm/h, a cloudburst, is all that CARLA has."""
    percent = _percent(2.0 * intensity * MM * HOUR)
    wet = _percent(30.0 + percent) if percent else 0.0
    return {"precipitation": percent, "precipitation_deposits": wet, "wetness": wet}


def _fog(visual_range: float) -> dict[str, float]:
    """Dense where one sees 50 m; clear from 5 km on."""
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
"""What is only heard of in the scenario: its effects and conditions hold, nobody sees it."""


def losses_of(environment: Mapping[str, float]) -> tuple[str, ...]:
    """Return what of an environment CARLA does not show, or not so."""
    losses = {**APPROXIMATED, **MISSING}
    return tuple(losses[name] for name in losses if environment.get(name))


def weather_of(environment: Mapping[str, float]) -> Mapping[str, float]:
    """Return the fields of CARLA's weather for an environment in SI units."""
    fields: dict[str, float] = {}
    for name, value in environment.items():
        if name in FIELDS:
            fields.update(FIELDS[name](value))
    return fields

"""Weather values that expressions read (DSL 8.10), SI units.

Values that no action has set are nan, so no comparison with them holds. Without an action, rain and
snow are zero and the visual range is infinite.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Literal

from osc2tx_runtime.world.measuring.measured import Measured
from osc2tx_shared.classes import dataclass

_UNTOUCHED = {"rain_intensity": 0.0, "snow_intensity": 0.0, "visual_range": math.inf}


@dataclass(frozen=True, slots=True)
class Air:
    """The air near the ground.

    Attributes:
        temperature: K.
        pressure: Pa.
        relative_humidity: 0 to 1.
    """

    temperature: float = math.nan
    pressure: float = math.nan
    relative_humidity: float = math.nan


@dataclass(frozen=True, slots=True)
class Precipitation:
    """Rain or snow.

    Attributes:
        intensity: Water column per time (m/s).
    """

    intensity: float = _UNTOUCHED["rain_intensity"]


@dataclass(frozen=True, slots=True)
class Wind:
    """The wind.

    Attributes:
        speed: m/s.
        direction: Where it comes from (rad from +y, clockwise).
    """

    speed: float = math.nan
    direction: float = math.nan


@dataclass(frozen=True, slots=True)
class Fog:
    """Fog.

    Attributes:
        visual_range: Visual range (m).
    """

    visual_range: float = _UNTOUCHED["visual_range"]


@dataclass(frozen=True, slots=True)
class Clouds:
    """Clouds.

    Attributes:
        cloudiness: Okta; 9: sky obscured.
    """

    cloudiness: float = math.nan


@dataclass(frozen=True, slots=True)
class Weather:
    """All values of the weather."""

    air: Air = Air()
    rain: Precipitation = Precipitation()
    snow: Precipitation = Precipitation()
    wind: Wind = Wind()
    fog: Fog = Fog()
    clouds: Clouds = Clouds()


@dataclass(frozen=True, slots=True)
class GeodeticPosition:
    """A point on the globe (WGS 84).

    Attributes:
        latitude: rad, to the north.
        longitude: rad, to the east.
    """

    latitude: float
    longitude: float


@dataclass(frozen=True, slots=True)
class CelestialPosition:
    """Position of the sun or the moon.

    Attributes:
        azimuth: rad from +y, clockwise.
        elevation: rad above the horizon.
    """

    azimuth: float
    elevation: float


class CelestialLightSource:
    """The sun or the moon.

    Args:
        position: Returns its position at the present step.
        name: `sun` or `moon`.
    """

    def __init__(
        self, position: Callable[[], CelestialPosition], name: Literal["sun", "moon"]
    ) -> None:
        self._position = position
        self.name = name

    @property
    def position(self) -> CelestialPosition:
        """Its present position."""
        return self._position()


def weather_of(values: Mapping[str, float]) -> Weather:
    """Return the weather by the values of an environment, see `World.environment`."""

    def measured(name: str) -> float:
        return Measured(values.get(name, _UNTOUCHED.get(name, math.nan)))

    return Weather(
        Air(*map(measured, ("temperature", "pressure", "relative_humidity"))),
        Precipitation(measured("rain_intensity")),
        Precipitation(measured("snow_intensity")),
        Wind(measured("wind_speed"), measured("wind_direction")),
        Fog(measured("visual_range")),
        Clouds(measured("cloudiness")),
    )


def celestial_position(
    name: Literal["sun", "moon"], values: Mapping[str, float]
) -> CelestialPosition:
    """Return the position of the sun or the moon by the values of an environment."""
    azimuth, elevation = (values.get(f"{name}_{angle}") for angle in ("azimuth", "elevation"))
    return CelestialPosition(
        Measured(math.nan if azimuth is None else azimuth),
        Measured(math.nan if elevation is None else elevation),
    )

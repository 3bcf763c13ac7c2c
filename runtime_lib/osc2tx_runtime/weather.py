"""The weather as scenarios read it (DSL 8.10): values of the present step, SI units.

What no action has set is not known: it is nan, so no comparison with it holds. Only rain and snow
do not fall then, and fog hides nothing.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Literal

__all__ = [
    "Air",
    "CelestialLightSource",
    "CelestialPosition",
    "Clouds",
    "Fog",
    "Precipitation",
    "Weather",
    "Wind",
]

_UNTOUCHED = {"rain_intensity": 0.0, "snow_intensity": 0.0, "visual_range": math.inf}


class _Part:
    """A part of the environment."""

    def __init__(self, values: Mapping[str, float]) -> None:
        self._values = values

    def _value(self, name: str) -> float:
        return self._values.get(name, _UNTOUCHED.get(name, math.nan))


class Air(_Part):
    """The air near the ground."""

    @property
    def temperature(self) -> float:
        """Temperature (K)."""
        return self._value("temperature")

    @property
    def pressure(self) -> float:
        """Pressure (Pa)."""
        return self._value("pressure")

    @property
    def relative_humidity(self) -> float:
        """Relative humidity, 0 to 1."""
        return self._value("relative_humidity")


class Precipitation(_Part):
    """Rain or snow.

    Args:
        values: Of the environment.
        kind: Which.
    """

    def __init__(self, values: Mapping[str, float], kind: Literal["rain", "snow"]) -> None:
        super().__init__(values)
        self._kind = kind

    @property
    def intensity(self) -> float:
        """Water column per time (m/s)."""
        return self._value(f"{self._kind}_intensity")


class Wind(_Part):
    """The wind."""

    @property
    def speed(self) -> float:
        """Speed (m/s)."""
        return self._value("wind_speed")

    @property
    def direction(self) -> float:
        """Where it comes from (rad from +y, clockwise)."""
        return self._value("wind_direction")


class Fog(_Part):
    """Fog."""

    @property
    def visual_range(self) -> float:
        """How far one sees (m)."""
        return self._value("visual_range")


class Clouds(_Part):
    """Clouds."""

    @property
    def cloudiness(self) -> float:
        """Okta."""
        return self._value("cloudiness")


class Weather(_Part):
    """All of it."""

    @property
    def air(self) -> Air:
        """The air."""
        return Air(self._values)

    @property
    def rain(self) -> Precipitation:
        """Rain."""
        return Precipitation(self._values, "rain")

    @property
    def snow(self) -> Precipitation:
        """Snow."""
        return Precipitation(self._values, "snow")

    @property
    def wind(self) -> Wind:
        """The wind."""
        return Wind(self._values)

    @property
    def fog(self) -> Fog:
        """Fog."""
        return Fog(self._values)

    @property
    def clouds(self) -> Clouds:
        """Clouds."""
        return Clouds(self._values)


class CelestialPosition(_Part):
    """Where the sun or the moon stands.

    Args:
        values: Of the environment.
        name: `sun` or `moon`.
    """

    def __init__(self, values: Mapping[str, float], name: str) -> None:
        super().__init__(values)
        self._name = name

    @property
    def azimuth(self) -> float:
        """Rad from +y, clockwise."""
        return self._value(f"{self._name}_azimuth")

    @property
    def elevation(self) -> float:
        """Rad above the horizon."""
        return self._value(f"{self._name}_elevation")


class CelestialLightSource:
    """The sun or the moon.

    Args:
        name: `sun` or `moon`.
        values: Gives the values of the environment at the present step.
    """

    def __init__(
        self, name: Literal["sun", "moon"], values: Callable[[], Mapping[str, float]]
    ) -> None:
        self.name = name
        self._values = values

    @property
    def position(self) -> CelestialPosition:
        """Where it stands now."""
        return CelestialPosition(self._values(), self.name)

"""Positions of sun and moon (DSL 8.10.2).

The series are those for low precision of the Astronomical Almanac: good to 0.01 degrees for the sun
and to 0.3 degrees for the moon between 1950 and 2050. Refraction is ignored.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from osc2tx_shared.classes import dataclass

_J2000 = 946_728_000.0
"""Unix time (s) of 2000-01-01 12:00, the epoch of the series."""

_DAY = 86_400.0
_CENTURY = 36_525.0  # days

# Degrees: factor of a sine, its angle at J2000, and how much this grows in a century.
_Terms = tuple[tuple[float, float, float], ...]

_MOON_LONGITUDE: _Terms = (
    (6.29, 134.9, 477_198.85),
    (-1.27, 259.2, -413_335.38),
    (0.66, 235.7, 890_534.23),
    (0.21, 269.9, 954_397.70),
    (-0.19, 357.5, 35_999.05),
    (-0.11, 186.6, 966_404.05),
)
_MOON_LATITUDE: _Terms = (
    (5.13, 93.3, 483_202.03),
    (0.28, 228.2, 960_400.87),
    (-0.28, 318.3, 6_003.18),
    (-0.17, 217.6, -407_332.20),
)
# Likewise with cosines: the parallax of the moon.
_MOON_PARALLAX = 0.9508
_MOON_PARALLAXES: _Terms = (
    (0.0518, 134.9, 477_198.85),
    (0.0095, 259.2, -413_335.38),
    (0.0078, 235.7, 890_534.23),
    (0.0028, 269.9, 954_397.70),
)


@dataclass(frozen=True, slots=True)
class Sky:
    """The sky over a place.

    Attributes:
        latitude: rad, to the north.
        longitude: rad, to the east.
        begin: Unix time (s) at the start of the run.
    """

    latitude: float
    longitude: float
    begin: float

    def values(self, elapsed: float) -> Mapping[str, float]:
        """Return azimuth (rad from north, clockwise) and elevation (rad) of sun and moon.

        Args:
            elapsed: Seconds since the start of the run.
        """
        days = (self.begin + elapsed - _J2000) / _DAY
        sun = self._seen(days, _sun_longitude(days), 0.0)
        moon = self._seen(days, *_moon(days))
        parallax = _MOON_PARALLAX + _sum(_MOON_PARALLAXES, days, math.cos)
        return {
            "sun_azimuth": sun[0],
            "sun_elevation": sun[1],
            "moon_azimuth": moon[0],
            "moon_elevation": moon[1] - math.radians(parallax) * math.cos(moon[1]),
        }

    def _seen(self, days: float, longitude: float, latitude: float) -> tuple[float, float]:
        """Return azimuth and elevation of a position (rad) on the ecliptic."""
        tilt = math.radians(23.439 - 4e-7 * days)
        x = math.cos(latitude) * math.cos(longitude)
        y, z = math.cos(latitude) * math.sin(longitude), math.sin(latitude)
        y, z = y * math.cos(tilt) - z * math.sin(tilt), y * math.sin(tilt) + z * math.cos(tilt)
        sidereal = math.radians((280.46061837 + 360.98564736629 * days) % 360.0)
        # Turned so that x points to the meridian of the place, then tilted to its horizon.
        turn = sidereal + self.longitude
        x, y = x * math.cos(turn) + y * math.sin(turn), y * math.cos(turn) - x * math.sin(turn)
        north = z * math.cos(self.latitude) - x * math.sin(self.latitude)
        up = z * math.sin(self.latitude) + x * math.cos(self.latitude)
        return math.atan2(y, north) % math.tau, math.atan2(up, math.hypot(y, north))


def _sun_longitude(days: float) -> float:
    mean = 280.460 + 0.9856474 * days
    anomaly = math.radians(357.528 + 0.9856003 * days)
    return math.radians(mean + 1.915 * math.sin(anomaly) + 0.020 * math.sin(2.0 * anomaly))


def _moon(days: float) -> tuple[float, float]:
    mean = 218.32 + 481_267.883 * days / _CENTURY
    longitude = mean + _sum(_MOON_LONGITUDE, days, math.sin)
    return math.radians(longitude % 360.0), math.radians(_sum(_MOON_LATITUDE, days, math.sin))


def _sum(terms: _Terms, days: float, wave: Callable[[float], float]) -> float:
    centuries = days / _CENTURY
    return sum(
        factor * wave(math.radians((angle + rate * centuries) % 360.0))
        for factor, angle, rate in terms
    )

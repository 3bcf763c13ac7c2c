"""Map projections of `geoReference`: WGS 84 to map coordinates.

The transverse Mercator projection is implemented here: the series of Krüger up to the fourth order
of the third flattening, with errors below a millimetre within 3000 km of the central meridian.
Universal transverse Mercator (UTM) is the same with the constants of its zone.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from osc2tx_runtime.plain_numbers import to_float
from osc2tx_shared.classes import dataclass

SEMI_MAJOR = 6_378_137.0
"""Semi-major axis of WGS 84 (m)."""
FLATTENING = 1.0 / 298.257_223_563

_N = FLATTENING / (2.0 - FLATTENING)
# Radius (m) of a sphere with meridians of the same length.
_RECTIFYING = SEMI_MAJOR / (1.0 + _N) * (1.0 + _N**2 / 4.0 + _N**4 / 64.0)
_ALPHA = (
    _N / 2.0 - 2.0 * _N**2 / 3.0 + 5.0 * _N**3 / 16.0 + 41.0 * _N**4 / 180.0,
    13.0 * _N**2 / 48.0 - 3.0 * _N**3 / 5.0 + 557.0 * _N**4 / 1440.0,
    61.0 * _N**3 / 240.0 - 103.0 * _N**4 / 140.0,
    49_561.0 * _N**4 / 161_280.0,
)
_ECCENTRICITY = math.sqrt(FLATTENING * (2.0 - FLATTENING))
_WIDEST = math.radians(80.0)  # of longitude beside the central meridian

# Parameter values of the ellipsoid of WGS 84 (GRS 80: 0.1 mm less).
_ELLIPSOIDS = frozenset({"WGS84", "GRS80"})
# Parameters that change the meaning of others, with the accepted values.
_USUAL: Mapping[str, frozenset[str]] = {
    "a": frozenset({"6378137", "6378137.0"}),
    "rf": frozenset({"298.257223563", "298.257222101"}),
    "pm": frozenset({"0", "greenwich"}),
    "axis": frozenset({"enu"}),
    "nadgrids": frozenset({"@null"}),
    "towgs84": frozenset({"0,0,0", "0,0,0,0,0,0,0"}),
    **dict.fromkeys(("R", "R_A", "R_V", "b", "f", "es", "e", "lon_wrap"), frozenset()),
}
_UTM_SCALE, _UTM_EAST, _UTM_NORTH = 0.9996, 500_000.0, 10_000_000.0


class GeoReferenceError(ValueError):
    """A map has no georeference, or an unsupported one."""


@dataclass(frozen=True, slots=True)
class TransverseMercator:
    """A transverse Mercator projection of WGS 84.

    Attributes:
        latitude: Of the origin (rad).
        longitude: Of the central meridian (rad).
        scale: On the central meridian.
        east: False easting (m).
        north: False northing (m).
    """

    latitude: float = 0.0
    longitude: float = 0.0
    scale: float = 1.0
    east: float = 0.0
    north: float = 0.0

    def project(self, latitude: float, longitude: float) -> tuple[float, float]:
        """Easting and northing (m) of a geodetic position (rad).

        Raises:
            GeoReferenceError: It is not a position, or far from the central meridian.
        """
        beside = math.remainder(longitude - self.longitude, math.tau)
        if abs(latitude) > 0.5 * math.pi or abs(beside) > _WIDEST:
            raise GeoReferenceError(
                f"latitude {math.degrees(latitude):g}, longitude {math.degrees(longitude):g}"
                " degrees is out of reach of the projection of the map"
            )
        east, north = _on_sphere(latitude, beside)
        _, origin = _on_sphere(self.latitude, 0.0)
        return self.east + self.scale * east, self.north + self.scale * (north - origin)


def _on_sphere(latitude: float, beside: float) -> tuple[float, float]:
    """Easting and northing (m) at scale 1, from the equator and the central meridian."""
    sine = math.sin(latitude)
    if abs(sine) == 1.0:
        return 0.0, _RECTIFYING * latitude
    conformal = math.sinh(math.atanh(sine) - _ECCENTRICITY * math.atanh(_ECCENTRICITY * sine))
    xi = math.atan2(conformal, math.cos(beside))
    eta = math.atanh(math.sin(beside) / math.hypot(1.0, conformal))
    east, north = eta, xi
    for order, alpha in enumerate(_ALPHA, 1):
        east += alpha * math.cos(2 * order * xi) * math.sinh(2 * order * eta)
        north += alpha * math.sin(2 * order * xi) * math.cosh(2 * order * eta)
    return _RECTIFYING * east, _RECTIFYING * north


@dataclass(frozen=True, slots=True)
class GeoReference:
    """Georeference of a map.

    Attributes:
        text: The parameters of `geoReference`, `+proj=tmerc +lat_0=...`; empty without any.
        offset: Offset of the map relative to the projection: x, y (m) and heading (rad).
    """

    text: str = ""
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def project(self, latitude: float, longitude: float) -> tuple[float, float]:
        """Map coordinates (m) of a geodetic position (rad).

        Raises:
            GeoReferenceError: The map has no projection, or an unsupported one.
        """
        east, north = self._projection().project(latitude, longitude)
        x, y, turn = self.offset
        c, n = math.cos(turn), math.sin(turn)
        east, north = east - x, north - y
        return east * c + north * n, north * c - east * n

    def _projection(self) -> TransverseMercator:
        words = (word.lstrip("+").partition("=") for word in self.text.split())
        given = {name: value for name, _, value in words}
        name = given.get("proj", "")
        if not self.text:
            raise GeoReferenceError("it has no `geoReference`")
        if name not in _PROJECTIONS:
            known = " and ".join(_PROJECTIONS)
            said = f"the projection `{name}`" if name else f"no projection (`{self.text}`)"
            raise GeoReferenceError(f"its `geoReference` has {said}; {known} are known")
        for word in ("datum", "ellps"):
            if given.get(word, "WGS84") not in _ELLIPSOIDS:
                raise GeoReferenceError(f"its `geoReference` is not on WGS 84 (+{word})")
        for word, usual in _USUAL.items():
            if word in given and given[word] not in usual:
                raise GeoReferenceError(
                    f"its `geoReference` has `+{word}={given[word]}`, which is not understood"
                )
        if given.get("units", "m") != "m" or "to_meter" in given:
            raise GeoReferenceError("its `geoReference` is not in metres")
        return _PROJECTIONS[name](given)


def _number(given: Mapping[str, str], names: tuple[str, ...], default: float) -> float:
    text = next((given[name] for name in names if name in given), None)
    if text is None:
        return default
    try:
        return to_float(text)
    except ValueError:
        message = f"`+{names[0]}={text}` of its `geoReference` is not a number"
        raise GeoReferenceError(message) from None


def _tmerc(given: Mapping[str, str]) -> TransverseMercator:
    return TransverseMercator(
        math.radians(_number(given, ("lat_0",), 0.0)),
        math.radians(_number(given, ("lon_0",), 0.0)),
        _number(given, ("k_0", "k"), 1.0),
        _number(given, ("x_0",), 0.0),
        _number(given, ("y_0",), 0.0),
    )


def _utm(given: Mapping[str, str]) -> TransverseMercator:
    """Only the zone counts; other parameters have no effect on UTM."""
    zone = _number(given, ("zone",), 0.0)
    if zone not in range(1, 61):
        raise GeoReferenceError("its `geoReference` has no UTM zone from 1 to 60")
    north = _UTM_NORTH if "south" in given else 0.0
    return TransverseMercator(0.0, math.radians(6.0 * zone - 183.0), _UTM_SCALE, _UTM_EAST, north)


_PROJECTIONS: Mapping[str, Callable[[Mapping[str, str]], TransverseMercator]] = {
    "tmerc": _tmerc,
    "utm": _utm,
}

"""The projection of maps, against what defines it and against published coordinates."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from osc2tx_runtime.opendrive import (
    GeoReference,
    GeoReferenceError,
    RoadMap,
    TransverseMercator,
    read_map_text,
)
from tests.runtime.opendrive.small_maps import map_text, road_text, shape

A, F = 6_378_137.0, 1.0 / 298.257_223_563
E2 = F * (2.0 - F)


def meridian_arc(latitude: float) -> float:
    """Metres from the equator: the radius of curvature of the meridian, summed up."""
    places, weights = np.polynomial.legendre.leggauss(40)
    at = 0.5 * latitude * (places + 1.0)
    radius = A * (1.0 - E2) / (1.0 - E2 * np.sin(at) ** 2) ** 1.5
    return float(0.5 * latitude * np.sum(weights * radius))


@pytest.mark.parametrize("degrees", [-80.0, -33.0, 0.0, 0.001, 48.1, 60.0, 89.0])
def test_true_along_the_central_meridian(degrees: float) -> None:
    """A transverse Mercator projection keeps lengths on its central meridian."""
    projection = TransverseMercator(longitude=0.1)
    east, north = projection.project(math.radians(degrees), 0.1)
    assert east == pytest.approx(0.0, abs=1e-9)
    assert north == pytest.approx(meridian_arc(math.radians(degrees)), abs=1e-3)


@pytest.mark.parametrize(
    ("latitude", "longitude"), [(0.1, 0.02), (0.8, -0.05), (-0.6, 0.08), (1.2, 0.03)]
)
def test_angles_are_kept(latitude: float, longitude: float) -> None:
    """Steps to the north and to the east stay at a right angle and equally stretched."""
    projection, step = TransverseMercator(), 1e-6
    curve = 1.0 - E2 * math.sin(latitude) ** 2
    along = A * (1.0 - E2) / curve**1.5  # m per radian to the north
    across = A * math.cos(latitude) / math.sqrt(curve)

    def moved(north: float, east: float) -> tuple[float, float]:
        a = projection.project(latitude + north, longitude + east)
        b = projection.project(latitude - north, longitude - east)
        return (a[0] - b[0]) / (2.0 * step), (a[1] - b[1]) / (2.0 * step)

    (nx, ny), (ex, ey) = moved(step, 0.0), moved(0.0, step)
    assert (nx / along, ny / along) == pytest.approx((-ey / across, ex / across), abs=1e-7)


def test_a_tower_in_its_zone() -> None:
    """The CN Tower: 43 38 33.24 N, 79 23 13.7 W is zone 17, 630084 m east, 4833438 m north."""
    reference = GeoReference("+proj=utm +zone=17 +ellps=WGS84 +units=m")
    latitude, longitude = 43 + 38 / 60 + 33.24 / 3600, -(79 + 23 / 60 + 13.7 / 3600)
    found = reference.project(math.radians(latitude), math.radians(longitude))
    assert found == pytest.approx((630084.0, 4833438.0), abs=1.0)
    south = GeoReference("+proj=utm +zone=17 +south").project(0.0, math.radians(-81.0))
    assert south == pytest.approx((500_000.0, 10_000_000.0))


def test_false_origin_scale_and_offset() -> None:
    text = "+proj=tmerc +lat_0=49 +lon_0=8 +k_0=0.5 +x_0=100 +y_0=-20 +datum=WGS84 +units=m"
    latitude, longitude = math.radians(49.5), math.radians(8.0)
    north = 0.5 * (meridian_arc(latitude) - meridian_arc(math.radians(49.0))) - 20.0
    found = GeoReference(text).project(latitude, longitude)
    assert found == pytest.approx((100.0, north), abs=1e-3)
    # The file is moved by (10, 20), then turned by a right angle.
    turned = GeoReference(text, (10.0, 20.0, 0.5 * math.pi)).project(latitude, longitude)
    assert turned == pytest.approx((north - 20.0, -90.0), abs=1e-3)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "it has no `geoReference`"),
        ("+lat_0=49 +lon_0=8", "no projection"),
        ("+proj=merc", "the projection `merc`; tmerc and utm are known"),
        ("+proj=tmerc +datum=potsdam", r"not on WGS 84 \(\+datum\)"),
        ("+proj=tmerc +ellps=bessel", r"not on WGS 84 \(\+ellps\)"),
        ("+proj=tmerc +units=us-ft", "not in metres"),
        ("+proj=tmerc +lat_0=north", "`\\+lat_0=north` of its `geoReference` is not a number"),
        ("+proj=tmerc +R=6371000", r"`\+R=6371000`, which is not understood"),
        ("+proj=tmerc +a=6377397.155", r"`\+a=6377397.155`"),
        ("+proj=tmerc +a=6378137 +rf=299.15", r"`\+rf=299.15`"),
        ("+proj=tmerc +pm=paris", r"`\+pm=paris`"),
        ("+proj=utm +zone=61", "no UTM zone from 1 to 60"),
    ],
)
def test_what_is_not_understood_is_said(text: str, reason: str) -> None:
    with pytest.raises(GeoReferenceError, match=reason):
        GeoReference(text).project(0.1, 0.1)


@pytest.mark.parametrize(("latitude", "longitude"), [(2.0, 0.0), (0.0, 1.5)])
def test_places_out_of_reach(latitude: float, longitude: float) -> None:
    with pytest.raises(GeoReferenceError, match="out of reach"):
        TransverseMercator().project(latitude, longitude)


def test_a_map_knows_where_it_is(own: Callable[[str], RoadMap]) -> None:
    assert own("highway").geo_reference.project(0.0, 0.0) == pytest.approx((0.0, 0.0))
    text = map_text(road_text(shape("line", 9.0), 9.0)).replace(
        "<header/>",
        "<header><geoReference> +proj=tmerc </geoReference><offset x='3' y='4'/></header>",
    )
    assert read_map_text(text).geo_reference == GeoReference("+proj=tmerc", (3.0, 4.0, 0.0))

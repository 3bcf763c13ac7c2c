"""Roads that are not even across: shapes, strips of a surface, and lanes that stay level."""

from __future__ import annotations

import math

import pytest

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from tests.runtime.opendrive.small_maps import WIDTH, make_map, road_text, shape

LINE, ARC = shape("line", 100.0), shape('arc curvature="0.02"', 100.0)
SIDES = (2, 1, -1, -2)


def lanes(level: bool = False) -> str:
    """Four lanes 3 m wide, the outer ones level or not."""

    def lane(number: int) -> str:
        is_level = "true" if level and abs(number) == 2 else "false"
        return f'<lane id="{number}" type="driving" level="{is_level}">{WIDTH}</lane>'

    left, right = (lane(2) + lane(1), lane(-1) + lane(-2))
    middle = '<center><lane id="0" type="none"/></center>'
    return f'<laneSection s="0"><left>{left}</left>{middle}<right>{right}</right></laneSection>'


def across(s: float, t: float, a: float, b: float = 0.0, c: float = 0.0) -> str:
    return f'<shape s="{s}" t="{t}" a="{a}" b="{b}" c="{c}" d="0"/>'


def over_s(tag: str, *records: str) -> str:
    return f"<{tag}>{''.join(f'<coefficients {record}/>' for record in records)}</{tag}>"


def one(profile: str, *, geometry: str = LINE, level: bool = False, more: str = "") -> RoadMap:
    extra = f"{more}<lateralProfile>{profile}</lateralProfile>"
    return make_map(road_text(geometry, 100.0, lanes=lanes(level), extra=extra))


def height(road_map: RoadMap, s: float, t: float) -> float:
    return road_map.road_pose("1", s, t).z


def slopes(road_map: RoadMap, place: LanePosition) -> tuple[float, float]:
    """Rise along and across the direction of travel by differences of positions (m/m)."""
    here = road_map.pose(place)
    found = []
    for turn in (0.0, 0.5 * math.pi):
        x, y = math.cos(here.h + turn), math.sin(here.h + turn)
        ahead, behind = (
            road_map.locate(here.x + k * x, here.y + k * y, hint=place) for k in (1e-3, -1e-3)
        )
        assert ahead is not None and behind is not None
        found.append((road_map.pose(ahead).z - road_map.pose(behind).z) / 2e-3)
    return found[0], found[1]


CROWN = across(0, -9, 0.18, -0.04) + across(0, 0, 0.0, 0.02, 0.003) + across(40, -9, 0.9)


def test_shapes_are_linear_between_their_places() -> None:
    road = one(CROWN)
    # At s = 0: 0.18 - 0.04 (t + 9) on the right, 0.02 t + 0.003 t^2 on the left; 0.9 from 40 m on.
    first = {-6.0: 0.18 - 0.12, -1.0: 0.18 - 0.32, 2.0: 0.04 + 0.012, 5.0: 0.1 + 0.075}
    for t, z in first.items():
        for s, share in ((0.0, 0.0), (10.0, 0.25), (30.0, 0.75), (40.0, 1.0), (90.0, 1.0)):
            assert height(road, s, t) == pytest.approx(z + (0.9 - z) * share), (s, t)
    assert not road.remarks


def test_the_road_is_flat_before_its_first_shape() -> None:
    road = one(across(40, -9, 0.5))
    assert [height(road, s, -2.0) for s in (0.0, 39.9, 40.0, 60.0)] == [0.0, 0.0, 0.5, 0.5]


@pytest.mark.parametrize("geometry", [LINE, ARC])
def test_vehicles_lean_and_climb_with_the_surface(geometry: str) -> None:
    hill = '<elevationProfile><elevation s="0" a="2" b="0.05" c="0" d="0"/></elevationProfile>'
    road = one(CROWN, geometry=geometry, more=hill)
    for lane in SIDES:
        for s in (5.0, 20.0, 70.0):
            place = LanePosition("1", lane, s, 0.3)
            pose, (along, aside) = road.pose(place), slopes(road, place)
            assert math.tan(-pose.pitch) == pytest.approx(along, abs=1e-5), place
            assert math.tan(pose.roll) == pytest.approx(aside, abs=1e-5), place
            assert pose.z == pytest.approx(height(road, s, _t(lane, 0.3)))


def _t(lane: int, offset: float) -> float:
    side = 1.0 if lane > 0 else -1.0
    return side * 3.0 * (abs(lane) - 0.5) - side * offset


STRIPS = (
    over_s("tOffset", 's="0" a="0.5"', 's="50" a="0.5" b="0.02"')
    + "<surfaceStrips>"
    + '<strip id="1">'
    + over_s("width", 's="0" a="2" b="0.01"')
    + over_s("constant", 's="0" a="0.1"')
    + over_s("linear", 's="0" a="0.02" b="0.001"')
    + over_s("quadratic", 's="0" a="0.003"')
    + '</strip><strip id="2" mode="relative">'
    + over_s("linear", 's="0" a="-0.04"')
    + '</strip><strip id="-1">'
    + over_s("width", 's="0" a="3"')
    + over_s("linear", 's="0" a="0.05"')
    + '</strip><strip id="-2" mode="independent">'
    + over_s("constant", 's="0" a="-0.2"')
    + over_s("cubic", 's="0" a="0.001"')
    + "</strip></surfaceStrips>"
)


def by_the_standard(s: float, t: float) -> float:
    """Section 10.5.4 written down for `STRIPS`."""
    effective = t - (0.5 if s < 50.0 else 0.5 + 0.02 * (s - 50.0))
    width = 2.0 + 0.01 * s

    def inner_left(dt: float) -> float:
        return 0.1 + (0.02 + 0.001 * s) * dt + 0.003 * dt**2

    if effective > width:
        return inner_left(width) - 0.04 * (effective - width)
    if effective > 0.0:
        return inner_left(effective)
    if effective >= -3.0:
        return 0.05 * effective
    return -0.2 + 0.001 * (effective + 3.0) ** 3


def test_strips_of_a_surface() -> None:
    road = one(f"<crossSectionSurface>{STRIPS}</crossSectionSurface>")
    for s in (0.0, 12.0, 49.0, 51.0, 99.0):
        for t in (-5.9, -3.0, -1.0, 0.4, 1.0, 2.0, 3.0, 5.9):
            assert height(road, s, t) == pytest.approx(by_the_standard(s, t)), (s, t)
    for lane in SIDES:
        for s in (20.0, 70.0):
            place = LanePosition("1", lane, s, 0.1)
            pose, (along, aside) = road.pose(place), slopes(road, place)
            assert math.tan(-pose.pitch) == pytest.approx(along, abs=1e-5), place
            assert math.tan(pose.roll) == pytest.approx(aside, abs=1e-5), place


BANK = '<superelevation s="0" a="0.1" b="0" c="0" d="0"/>'


@pytest.mark.parametrize(
    ("profile", "edges"),
    [
        (BANK, (-3.0 * math.sin(0.1), 3.0 * math.sin(0.1))),
        (across(0, -9, 0.9, -0.1), (0.3, -0.3)),
    ],
)
def test_level_lanes_have_the_height_of_the_edge_inside(
    profile: str, edges: tuple[float, float]
) -> None:
    road, banked = one(profile, level=True), one(profile)
    for lane, z in zip((-2, 2), edges, strict=True):
        for offset in (-1.0, 0.0, 1.0):
            place = LanePosition("1", lane, 30.0, offset)
            pose = road.pose(place)
            assert (pose.z, pose.roll, pose.pitch) == pytest.approx((z, 0.0, 0.0))
            assert pose[:2] == pytest.approx(banked.pose(place)[:2])  # the projection stays
            assert abs(banked.pose(place).roll) > 0.09
        inside = LanePosition("1", lane // 2, 30.0)
        assert road.pose(inside) == banked.pose(inside)

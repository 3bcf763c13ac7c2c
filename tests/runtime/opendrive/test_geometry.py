"""Each kind of geometry, and the profiles on top of it, against closed forms."""

import math

import pytest

from osc2tx_runtime.opendrive import LanePosition
from tests.runtime.opendrive.small_maps import LANES, make_map, one_road, road_text, shape


def fresnel(a: float, length: float) -> tuple[float, float]:
    """End of a clothoid with curvature 2 a s, by the power series of the Fresnel integrals."""
    x = y = 0.0
    for n in range(60):
        power = a**n * length ** (2 * n + 1) / (math.factorial(n) * (2 * n + 1))
        if n % 2 == 0:
            x += (-1) ** (n // 2) * power
        else:
            y += (-1) ** (n // 2) * power
    return x, y


@pytest.mark.parametrize("s", [0.0, 1.0, 57.0, 100.0])
def test_line(s: float) -> None:
    road = make_map(road_text(shape("line", 100.0, x=5.0, y=-2.0, h=0.3), 100.0))
    pose = road.road_pose("1", s, 2.0)
    assert pose.x == pytest.approx(5.0 + s * math.cos(0.3) - 2.0 * math.sin(0.3), abs=1e-12)
    assert pose.y == pytest.approx(-2.0 + s * math.sin(0.3) + 2.0 * math.cos(0.3), abs=1e-12)
    assert pose.h == pytest.approx(0.3)


@pytest.mark.parametrize("radius", [20.0, -35.0, 5e6])
def test_arc_is_a_circle(radius: float) -> None:
    road = one_road(f'arc curvature="{1.0 / radius!r}"', 80.0)
    for s in (0.0, 13.0, 80.0):
        pose = road.road_pose("1", s, 0.0)
        assert pose.x == pytest.approx(radius * math.sin(s / radius), abs=1e-8)
        assert pose.y == pytest.approx(radius * (1 - math.cos(s / radius)), abs=1e-8)
        assert math.sin(pose.h - s / radius) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("rate", [1e-4, -4e-4, 1e-3])
def test_spiral_is_an_euler_spiral(rate: float) -> None:
    road = one_road(f'spiral curvStart="0" curvEnd="{100.0 * rate!r}"', 100.0)
    for s in (0.0, 3.0, 41.0, 70.0, 100.0):
        x, y = fresnel(rate / 2.0, s)
        pose = road.road_pose("1", s, 0.0)
        assert (pose.x, pose.y) == pytest.approx((x, y), abs=1e-9)
        assert math.sin(pose.h - rate * s * s / 2.0) == pytest.approx(0.0, abs=1e-12)


def test_spiral_with_equal_curvatures_is_an_arc() -> None:
    spiral = one_road('spiral curvStart="0.02" curvEnd="0.02"', 50.0)
    arc = one_road('arc curvature="0.02"', 50.0)
    straight = one_road('spiral curvStart="0" curvEnd="0"', 50.0)
    assert spiral.road_pose("1", 33.0, 1.0) == arc.road_pose("1", 33.0, 1.0)
    assert straight.road_pose("1", 33.0, 1.0).x == pytest.approx(33.0)


def arc_length(slope_c: float, slope_d: float, end: float) -> float:
    """Length of y = c x^2 + d x^3 from 0 to `end`, by a fine midpoint rule."""
    count = 20000
    step = end / count
    return sum(
        math.hypot(1.0, (2 * slope_c + 3 * slope_d * u) * u) * step
        for u in ((i + 0.5) * step for i in range(count))
    )


def test_poly3_walks_by_arc_length() -> None:
    c, d, u = 0.01, -5e-5, 60.0
    length = arc_length(c, d, 80.0)
    road = one_road(f'poly3 a="0" b="0" c="{c}" d="{d}"', length)
    pose = road.road_pose("1", arc_length(c, d, u), 0.0)
    assert (pose.x, pose.y) == pytest.approx((u, c * u**2 + d * u**3), abs=1e-5)
    assert pose.h == pytest.approx(math.atan(2 * c * u + 3 * d * u * u), abs=1e-6)


@pytest.mark.parametrize("normalized", [True, False])
def test_param_poly3_walks_by_arc_length(normalized: bool) -> None:
    c, d, end = 0.01, -5e-5, 80.0
    length = arc_length(c, d, end)
    span = 1.0 if normalized else length
    k = end / span  # u = k p
    kind = (
        f'paramPoly3 pRange="{"normalized" if normalized else "arcLength"}" '
        f'aU="0" bU="{k!r}" cU="0" dU="0" '
        f'aV="0" bV="0" cV="{c * k * k!r}" dV="{d * k**3!r}"'
    )
    road = one_road(kind, length)
    for u in (0.0, 7.0, 60.0, end):
        pose = road.road_pose("1", arc_length(c, d, u), 0.0)
        assert (pose.x, pose.y) == pytest.approx((u, c * u**2 + d * u**3), abs=1e-5)


def test_zero_length_geometry_is_stepped_over() -> None:
    pieces = (
        shape("line", 10.0)
        + shape("line", 0.0, s=10.0, x=10.0)
        + shape('arc curvature="0.1"', 5.0, s=10.0, x=10.0)
    )
    road = make_map(road_text(pieces, 15.0))
    assert road.road_pose("1", 10.0, 0.0).x == pytest.approx(10.0)
    assert road.road_pose("1", 15.0, 0.0).h == pytest.approx(0.5)


def test_elevation_gives_height_and_pitch() -> None:
    extra = '<elevationProfile><elevation s="20" a="1" b="0.1" c="0" d="0"/></elevationProfile>'
    road = one_road("line", 100.0, extra=extra)
    along = road.pose(LanePosition("1", -1, 60.0))
    against = road.pose(LanePosition("1", 1, 60.0))
    assert along.z == pytest.approx(5.0)
    assert along.pitch == pytest.approx(-math.atan(0.1))  # nose up is negative (ISO 8855)
    assert against.pitch == pytest.approx(math.atan(0.1))


def test_superelevation_gives_height_and_roll() -> None:
    extra = '<lateralProfile><superelevation s="0" a="0.2" b="0" c="0" d="0"/></lateralProfile>'
    road = one_road("line", 100.0, extra=extra)
    right = road.pose(LanePosition("1", -1, 50.0))
    left = road.pose(LanePosition("1", 1, 50.0))
    assert (right.y, right.z) == pytest.approx((-1.5 * math.cos(0.2), -1.5 * math.sin(0.2)))
    assert (right.roll, left.roll) == pytest.approx((0.2, -0.2))  # right side down is positive
    found = road.locate(50.0, right.y)
    assert found is not None and found.offset == pytest.approx(0.0, abs=1e-9)


def lanes_with(content: str, offset: str = "") -> str:
    return (
        f'{offset}<laneSection s="0"><center><lane id="0" type="none"/></center>'
        f'<right><lane id="-1" type="driving">{content}</lane></right></laneSection>'
    )


def test_width_polynomial_gives_slope_to_the_heading() -> None:
    lanes = lanes_with('<width sOffset="10" a="2" b="0.2" c="0" d="0"/>')
    road = one_road("line", 50.0, lanes=lanes)
    assert road.lane_width("1", -1, 20.0) == pytest.approx(4.0)
    pose = road.pose(LanePosition("1", -1, 20.0))
    assert pose.y == pytest.approx(-2.0)
    assert pose.h == pytest.approx(-math.atan(0.1))


def test_border_counts_from_the_lane_offset() -> None:
    lanes = lanes_with(
        '<border sOffset="0" a="-3" b="0" c="0" d="0"/>',
        '<laneOffset s="0" a="1" b="0" c="0" d="0"/>',
    )
    road = one_road("line", 50.0, lanes=lanes)
    assert road.lane_width("1", -1, 20.0) == pytest.approx(3.0)
    assert road.pose(LanePosition("1", -1, 20.0)).y == pytest.approx(-0.5)


def test_lane_without_width_has_width_zero() -> None:
    assert one_road("line", 50.0, lanes=lanes_with("")).lane_width("1", -1, 20.0) == 0.0


def test_left_hand_traffic_turns_the_direction_not_the_ids() -> None:
    road = one_road("line", 50.0, rule="LHT", lanes=LANES)
    assert (road.travel_direction("1", 1), road.travel_direction("1", -1)) == (1, -1)
    assert road.lanes("1", 10.0) == (1,)
    assert road.pose(LanePosition("1", 1, 10.0, 0.5)).y == pytest.approx(2.0)
    assert road.pose(LanePosition("1", -1, 10.0, 0.5)).y == pytest.approx(-2.0)
    assert road.pose(LanePosition("1", -1, 10.0)).h == pytest.approx(math.pi)

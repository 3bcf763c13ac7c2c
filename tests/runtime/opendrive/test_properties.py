"""Properties that hold for every map; checked on our own maps."""

import math
from collections.abc import Callable

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from osc2tx_runtime.opendrive import DRIVING, LanePosition, RoadMap

NAMES = ("crossing", "curve", "highway", "left_hand", "merge", "urban_crossing")
Own = Callable[[str], RoadMap]


def place(road_map: RoadMap, pick: float, share: float, offset: float) -> LanePosition:
    """A place on some driving lane, away from the lane's ends."""
    lanes = [
        lane
        for road in road_map.roads.values()
        for section in road.sections
        for lane in section.lanes.values()
        if lane.type in DRIVING
    ]
    lane = lanes[int(pick * (len(lanes) - 1))]
    span = lane.section.end - lane.section.begin
    s = lane.section.begin + (0.02 + 0.96 * share) * span
    half = 0.4 * road_map.lane_width(lane.road.id, lane.id, s)
    return LanePosition(lane.road.id, lane.id, s, offset * half)


unit = st.floats(0.0, 1.0)
places = st.tuples(st.sampled_from(NAMES), unit, unit, st.floats(-1.0, 1.0))


@given(where=places)
def test_locate_inverts_pose(own: Own, where: tuple[str, float, float, float]) -> None:
    road_map = own(where[0])
    p = place(road_map, *where[1:])
    assume(road_map.roads[p.road].junction is None)
    assume(road_map.lane_width(p.road, p.lane, p.s) > 0.5)
    pose = road_map.pose(p)
    for hint in (None, p):
        found = road_map.locate(pose.x, pose.y, hint=hint)
        assert found is not None
        assert (found.road, found.lane) == (p.road, p.lane)
        assert found.s == pytest.approx(p.s, abs=1e-6)
        assert found.offset == pytest.approx(p.offset, abs=1e-6)
    line, beside = (road_map.road_pose(p.road, p.s, t) for t in (0.0, 1.0))
    across = beside.x - line.x, beside.y - line.y
    t = (pose.x - line.x) * across[0] + (pose.y - line.y) * across[1]
    again = road_map.road_pose(p.road, p.s, t / math.hypot(*across) ** 2)
    assert math.hypot(again.x - pose.x, again.y - pose.y) < 1e-6


@given(where=places, a=st.floats(-80.0, 80.0), b=st.floats(0.0, 1.0))
def test_advance_is_additive(
    own: Own, where: tuple[str, float, float, float], a: float, b: float
) -> None:
    road_map = own(where[0])
    p = place(road_map, *where[1:])
    once = road_map.advance(p, a)
    first = road_map.advance(p, b * a)
    second = road_map.advance(first.position, a - b * a)
    assert first.travelled + second.travelled == pytest.approx(once.travelled, abs=1e-6)
    one, two = road_map.pose(once.position), road_map.pose(second.position)
    assert math.hypot(one.x - two.x, one.y - two.y) < 1e-5


@given(where=places, a=st.floats(0.0, 200.0))
def test_advance_length_is_the_distance_walked(
    own: Own, where: tuple[str, float, float, float], a: float
) -> None:
    road_map = own(where[0])
    p = place(road_map, *where[1:])
    total = road_map.advance(p, a)
    count = 200
    before, here = road_map.pose(p), p
    walked = 0.0
    for _ in range(count):
        here = road_map.advance(here, total.travelled / count).position
        pose = road_map.pose(here)
        walked += math.hypot(pose.x - before.x, pose.y - before.y)
        before = pose
    # Chords are a little shorter; on the taper the offset is carried parallel only to first order.
    assert walked == pytest.approx(total.travelled, rel=2e-3, abs=1e-6)


@given(one=places, other=st.tuples(unit, unit))
def test_route_distance_is_antisymmetric(
    own: Own, one: tuple[str, float, float, float], other: tuple[float, float]
) -> None:
    road_map = own(one[0])
    a, b = place(road_map, *one[1:]), place(road_map, *other, 0.0)
    forth, back = road_map.route_distance(a, b), road_map.route_distance(b, a)
    if forth is None or back is None:
        assert forth is back
    else:
        assert forth == -back


@given(where=places, distance=st.floats(0.1, 120.0))
def test_route_distance_agrees_with_advance(
    own: Own, where: tuple[str, float, float, float], distance: float
) -> None:
    road_map = own(where[0])
    p = place(road_map, *where[1:3], 0.0)
    moved = road_map.advance(p, distance)
    assert road_map.route_distance(p, moved.position) == pytest.approx(moved.travelled, abs=1e-6)
    route = road_map.route_to(moved.position)
    assert route.distance(p) == pytest.approx(moved.travelled, abs=1e-6)
    along = road_map.advance(p, distance, route)
    assert along.position.road == moved.position.road

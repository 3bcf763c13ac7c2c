"""Lanes that are driven the other way, and roads that branch off within another one."""

from __future__ import annotations

import math

import pytest

from osc2tx_runtime.opendrive import LaneKey, LanePosition, RoadMap
from tests.runtime.opendrive.small_maps import LANES, make_map, road_text, shape
from tests.runtime.opendrive.test_what_maps_say import lane, links, section

LINE = shape("line", 100.0)


def reversed_lane(number: int, link: str = "") -> str:
    return lane(number, link=link).replace(" type", ' direction="reversed" type')


def two_roads(rule: str = "RHT") -> RoadMap:
    """Two roads in a row with two lanes on each side; the inner left ones are reversed."""
    left = lane(2, link=links(2, 2)) + reversed_lane(1, links(1, 1))
    lanes = section(0, left, lane(-1, link=links(-1, -1)) + lane(-2, link=links(-2, -2)))
    after = '<successor elementType="road" elementId="2" contactPoint="start"/>'
    before = '<predecessor elementType="road" elementId="1" contactPoint="end"/>'
    second = shape("line", 100.0, x=100.0)
    return make_map(
        road_text(LINE, 100.0, lanes=lanes, link=after, rule=rule),
        road_text(second, 100.0, identity="2", lanes=lanes, link=before, rule=rule),
    )


@pytest.mark.parametrize(("rule", "sign"), [("RHT", 1), ("LHT", -1)])
def test_a_reversed_lane_runs_the_other_way(rule: str, sign: int) -> None:
    road = two_roads(rule)
    assert not road.remarks
    ways = {number: road.travel_direction("1", number) for number in (2, 1, -1, -2)}
    assert ways == {2: -sign, 1: sign, -1: sign, -2: sign}
    heading = road.pose(LanePosition("1", 1, 50.0)).h
    assert math.cos(heading) == pytest.approx(sign)
    begin, end = ("1", "2") if sign > 0 else ("2", "1")
    assert road.successors(LaneKey(begin, 0, 1)) == (LaneKey(end, 0, 1),)
    assert road.successors(LaneKey(end, 0, 2)) == (LaneKey(begin, 0, 2),)
    moved = road.advance(LanePosition("1", 1, 50.0), sign * 80.0)
    assert moved.position == LanePosition("2", 1, 30.0)


def test_one_changes_over_the_middle_onto_a_reversed_lane() -> None:
    road = two_roads()
    assert road.lanes("1", 50.0) == (-2, -1, 1)
    assert road.lanes("1", 50.0, like=2) == (2,)
    assert road.neighbour(LanePosition("1", -1, 50.0), "left") == LanePosition("1", 1, 50.0)
    assert road.neighbour(LanePosition("1", 1, 50.0), "right", 2) == LanePosition("1", -2, 50.0)
    assert road.neighbour(LanePosition("1", 1, 50.0), "left") is None
    assert road.neighbour(LanePosition("1", 2, 50.0), "left") is None
    goal = LanePosition("2", 1, 30.0)
    for number in (-2, -1, 1):
        assert road.route_distance(LanePosition("1", number, 50.0), goal) == pytest.approx(80.0)
    assert road.route_distance(LanePosition("1", 2, 50.0), goal) is None


def test_a_lane_that_turns_round_within_its_road_is_named() -> None:
    lanes = section(0, lane(1), lane(-1)) + section(50, lane(1), reversed_lane(-1))
    road = make_map(road_text(LINE, 100.0, lanes=lanes))
    (remark,) = road.remarks
    assert remark == "line 1: `lane` -1 is reversed in some sections only: it is not reversed"
    assert road.travel_direction("1", -1) == 1


# --- Virtual junctions ----------------------------------------------------------------------------

RADIUS = 10.0
QUARTER = 0.5 * math.pi * RADIUS
ONE_LANE = section(0, "", lane(-1, link='<predecessor id="-1"/><successor id="-1"/>'))


def with_driveways() -> RoadMap:
    """A road along x; from 50 m on it one goes right to a yard, and comes back at 70 m.

    Lane offsets put the lanes of the branches on that of the road, at t = -1.5 m.
    """
    out = '<predecessor elementType="road" elementId="1" elementS="50" elementDir="+"/>'
    out += '<successor elementType="road" elementId="9" contactPoint="start"/>'
    back = '<predecessor elementType="road" elementId="8" contactPoint="end"/>'
    back += '<successor elementType="road" elementId="1" elementS="70" elementDir="+"/>'
    right = f'arc curvature="{-1.0 / RADIUS!r}"'
    into = shape(right, QUARTER, x=50.0)
    away = shape("line", 30.0, x=60.0, y=-RADIUS, h=-0.5 * math.pi)
    come = shape("line", 30.0, x=60.0, y=-RADIUS - 30.0, h=0.5 * math.pi)
    onto = shape(right, QUARTER, x=60.0, y=-RADIUS, h=0.5 * math.pi)
    junction = (
        '<junction id="5" type="virtual" mainRoad="1" sStart="50" sEnd="70" orientation="+">'
        '<connection id="0" incomingRoad="1" connectingRoad="2" contactPoint="start">'
        '<laneLink from="-1" to="-1"/></connection>'
        '<connection id="1" incomingRoad="8" connectingRoad="4" contactPoint="start">'
        '<laneLink from="-1" to="-1"/></connection></junction>'
    )
    to_junction = '<successor elementType="junction" elementId="5"/>'
    from_two = '<predecessor elementType="road" elementId="2" contactPoint="end"/>'
    return make_map(
        road_text(LINE, 100.0, lanes=LANES),
        road_text(into, QUARTER, identity="2", lanes=ONE_LANE, link=out, junction="5"),
        road_text(onto, QUARTER, identity="4", lanes=ONE_LANE, link=back, junction="5"),
        road_text(come, 30.0, identity="8", lanes=ONE_LANE, link=to_junction),
        road_text(away, 30.0, identity="9", lanes=ONE_LANE, link=from_two),
        rest=junction,
    )


def test_ways_leave_a_road_within_it_and_come_back() -> None:
    road = with_driveways()
    assert not road.remarks
    assert road.seams() == ()
    begin, yard = LanePosition("1", -1, 20.0), LanePosition("9", -1, 12.0)
    # On the inside of the bend, 1.5 m nearer to its middle.
    bend = 0.5 * math.pi * (RADIUS - 1.5)
    assert road.route_distance(begin, yard) == pytest.approx(30.0 + bend + 12.0)
    route = road.route_to(yard)
    assert road.advance(begin, 30.0 + bend + 5.0, route).position.road == "9"
    back = LanePosition("8", -1, 10.0)
    goal = LanePosition("1", -1, 90.0)
    assert road.route_distance(back, goal) == pytest.approx(20.0 + bend + 20.0)
    assert road.advance(back, 20.0 + bend + 5.0).position[:2] == ("1", -1)
    assert road.advance(back, 20.0 + bend + 5.0).position.s == pytest.approx(75.0)


def test_the_road_itself_goes_straight_on() -> None:
    road = with_driveways()
    plain = make_map(road_text(LINE, 100.0))
    for number, s in ((-1, 20.0), (1, 90.0)):
        place = LanePosition("1", number, s)
        for way in (10.0, 30.0, 45.0, 60.0, -15.0, 500.0):
            found, expected = road.advance(place, way), plain.advance(place, way)
            assert found.travelled == pytest.approx(expected.travelled)
            assert found.position == pytest.approx(expected.position)
        assert road.pose(place) == plain.pose(place)
        assert road.lane_width("1", number, 55.0) == 3.0
    assert (
        road.route_distance(LanePosition("1", 1, 90.0), LanePosition("9", -1, 12.0)) is None
    )  # the other carriageway has no branch

"""Lanes of oncoming traffic as targets: their centres are those of the map, whatever the map is."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import ActorSpec, EmbeddedWorld
from osc2tx_runtime.world.commands import KeepLane, LaneChange, LaneOffset
from osc2tx_runtime.world.geometry.function_profiles import Computed
from osc2tx_runtime.world.geometry.lane_neighbours import (
    lane_beside,
    lanes_to_left,
    seen_along,
    width_at,
)
from tests.runtime.opendrive.small_maps import one_road

MakeSpec = Callable[..., ActorSpec]
CarOn = Callable[[RoadMap, int], EmbeddedWorld]
LATERAL = "lateral"


def lanes(**widths: float) -> str:
    """Two driving lanes each way of 3 m; others by their names, `p1` for lane 1, `m1` for -1."""

    def lane(number: int) -> str:
        width = widths.get(f"m{-number}" if number < 0 else f"p{number}", 3.0)
        shape = f'<width sOffset="0" a="{width}" b="0" c="0" d="0"/>'
        return f'<lane id="{number}" type="driving">{shape}</lane>'

    return (
        f'<laneSection s="0"><left>{lane(2)}{lane(1)}</left>'
        '<center><lane id="0" type="none"/></center>'
        f"<right>{lane(-1)}{lane(-2)}</right></laneSection>"
    )


STRAIGHT = one_road("line", 600.0, lanes=lanes())
UNEVEN = one_road("line", 600.0, lanes=lanes(p1=5.0, p2=4.0))
BEND = one_road('arc curvature="0.01"', 500.0, lanes=lanes())
LEFT_HAND = one_road("line", 600.0, lanes=lanes(), rule="LHT")


@pytest.fixture
def car_on(make_spec: MakeSpec) -> CarOn:
    """A car that drives in a lane of road 1 at 15 m/s, far from its end."""

    def make(road_map: RoadMap, lane: int) -> EmbeddedWorld:
        world = EmbeddedWorld(road_map, 0.05)
        world.add(make_spec("a"))
        s = 100.0 if road_map.travel_direction("1", lane) > 0 else 400.0
        world.place("a", LanePosition("1", lane, s), 15.0)
        return world

    return make


def drive(world: EmbeddedWorld, seconds: float) -> None:
    for _ in range(round(seconds / world.dt)):
        world.step()


def across(world: EmbeddedWorld) -> float:
    """Its distance (m) to the left of the reference line, as geometry has it."""
    state = world.state("a")
    assert state.lane_position is not None
    line = world.map.road_pose("1", state.lane_position.s, 0.0)
    return (state.y - line.y) * math.cos(line.h) - (state.x - line.x) * math.sin(line.h)


@pytest.mark.parametrize(
    ("road_map", "lane", "change", "t"),
    [
        pytest.param(STRAIGHT, -1, 1, 1.5, id="the next one"),
        pytest.param(STRAIGHT, -2, 2, 1.5, id="from the outer lane"),
        pytest.param(STRAIGHT, -1, 2, 4.5, id="the one behind it"),
        pytest.param(STRAIGHT, 1, 1, -1.5, id="the other way"),
        pytest.param(UNEVEN, -1, 1, 2.5, id="a wide one"),
        pytest.param(UNEVEN, -1, 2, 7.0, id="behind a wide one"),
        pytest.param(BEND, -1, 1, 1.5, id="in a bend"),
        pytest.param(LEFT_HAND, -1, -1, 1.5, id="where one drives on the left"),
        pytest.param(LEFT_HAND, 1, -1, -1.5, id="and the other way"),
    ],
)
def test_out_and_back(car_on: CarOn, road_map: RoadMap, lane: int, change: int, t: float) -> None:
    world = car_on(road_map, lane)
    began, heading = across(world), world.state("a").h
    world.command("a", LATERAL, LaneChange(change))
    drive(world, 6.0)
    assert world.progress("a", LATERAL).done
    assert across(world) == pytest.approx(t, abs=1e-6)
    assert world.state("a").lane == math.copysign(1, lane)  # it still belongs to its own side
    if road_map is not BEND:
        assert world.state("a").h == pytest.approx(heading)
    world.command("a", LATERAL, LaneChange(-change))
    drive(world, 6.0)
    assert across(world) == pytest.approx(began, abs=1e-6)


def test_it_stays_there_and_its_offset_counts_from_there(car_on: CarOn) -> None:
    world = car_on(UNEVEN, -1)
    world.command("a", LATERAL, LaneChange(1, offset=0.5))
    drive(world, 6.0)
    assert across(world) == pytest.approx(3.0, abs=1e-6)
    world.command("a", LATERAL, KeepLane())
    drive(world, 2.0)
    assert across(world) == pytest.approx(3.0, abs=1e-6)
    world.command("a", LATERAL, LaneOffset(0.0))
    drive(world, 6.0)
    assert across(world) == pytest.approx(2.5, abs=1e-6)


def test_an_own_course_counts_from_there(car_on: CarOn) -> None:
    world = car_on(STRAIGHT, -1)
    course = Computed(lambda t: -3.0 + 0.75 * t, 4.0)
    world.command("a", LATERAL, LaneChange(1, course=course))
    for seconds in range(1, 5):
        drive(world, 1.0)
        assert across(world) == pytest.approx(1.5 + course.value(seconds), abs=1e-6)


@pytest.mark.parametrize(("seconds", "t"), [(1.0, -1.5), (2.0, 1.5)])
def test_cut_short_it_goes_to_the_lane_it_is_in(car_on: CarOn, seconds: float, t: float) -> None:
    world = car_on(STRAIGHT, -1)
    world.command("a", LATERAL, LaneChange(1, duration=3.0))
    drive(world, seconds)
    assert (across(world) < 0.0) is (t < 0.0)
    world.command("a", LATERAL, KeepLane())
    drive(world, 5.0)
    assert across(world) == pytest.approx(t, abs=1e-6)


def test_lanes_are_counted_over_both_directions() -> None:
    own, oncoming = LanePosition("1", -2, 100.0), LanePosition("1", 2, 100.0)
    assert lanes_to_left(STRAIGHT, own, oncoming) == 3
    assert lanes_to_left(STRAIGHT, oncoming, own) == 3
    there = lane_beside(STRAIGHT, own, 3)
    assert there == LanePosition("1", -1, 100.0, 6.0)
    assert lanes_to_left(STRAIGHT, there, own) == -3
    assert lanes_to_left(STRAIGHT, own, there) == 3
    assert lane_beside(STRAIGHT, own, 4) is None
    assert lane_beside(UNEVEN, LanePosition("1", -1, 0.0, 4.0), 0) == LanePosition(
        "1", -1, 0.0, 4.0
    )
    assert width_at(UNEVEN, LanePosition("1", -1, 0.0, 4.0)) == 5.0


def test_back_from_there_in_a_junction() -> None:
    """Its road has no lanes of oncoming traffic there; one still comes back to the lane beside."""
    one_way = lanes().replace('id="1" type="driving"', 'id="1" type="none"')
    crossing = one_road("line", 60.0, lanes=one_way, junction="7")
    there = LanePosition("1", -1, 20.0, 2.8)
    assert lane_beside(crossing, there, 0) == LanePosition("1", -1, 20.0, 3.0)
    assert lane_beside(crossing, there, -1) == LanePosition("1", -1, 20.0)
    assert lane_beside(crossing, there, -2) == LanePosition("1", -2, 20.0)
    assert lane_beside(crossing, there, 1) is None


def test_what_lies_between_ends_the_lanes() -> None:
    divided = lanes().replace('id="1" type="driving"', 'id="1" type="median"')
    road_map = one_road("line", 600.0, lanes=divided)
    own = LanePosition("1", -1, 100.0)
    assert lane_beside(road_map, own, 1) is None
    with pytest.raises(
        ScenarioError, match="lane 2 of road 1 is not a driving lane beside lane -1"
    ):
        lanes_to_left(road_map, own, LanePosition("1", 2, 100.0))


@pytest.mark.parametrize(
    ("place", "heading", "seen"),
    [
        (LanePosition("1", 1, 50.0, 0.2), 0.1, LanePosition("1", -1, 50.0, 2.8)),
        (LanePosition("1", 2, 50.0, -0.5), 0.0, LanePosition("1", -1, 50.0, 6.5)),
        (LanePosition("1", -2, 50.0, 0.0), math.pi, LanePosition("1", 1, 50.0, 6.0)),
        (LanePosition("1", 1, 50.0, 0.2), math.pi, LanePosition("1", 1, 50.0, 0.2)),
        (LanePosition("1", -2, 50.0, 0.4), 1.5, LanePosition("1", -2, 50.0, 0.4)),
    ],
)
def test_who_drives_there_sees_it_beside_its_own_lane(
    place: LanePosition, heading: float, seen: LanePosition
) -> None:
    assert seen_along(STRAIGHT, place, heading) == pytest.approx(seen)

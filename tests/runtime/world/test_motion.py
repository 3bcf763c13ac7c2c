"""The embedded world: motion is exact, independent of the step, and hands over smoothly."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import pytest

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import ActorSpec, ActorState, EmbeddedWorld
from osc2tx_runtime.world.commands import Command, LaneChange, LaneOffset, SpeedChange
from osc2tx_runtime.world.lateral.execution import HEADING_LIMIT, LANE_CHANGE_TIME

CarWorld = Callable[..., EmbeddedWorld]
LONGITUDINAL, LATERAL = "longitudinal", "lateral"


def history(world: EmbeddedWorld, seconds: float) -> list[ActorState]:
    states = [world.state("a")]
    for _ in range(round(seconds / world.dt)):
        world.step()
        states.append(world.state("a"))
    return states


@pytest.mark.parametrize(
    "command",
    [
        SpeedChange(20.0, "constant", 2.0),
        SpeedChange(20.0, "smooth"),
        SpeedChange(0.0, "asap"),
        SpeedChange(16.0),
    ],
    ids=lambda c: c.profile,
)
def test_speed_does_not_depend_on_the_step(car_world: CarWorld, command: SpeedChange) -> None:
    runs = {}
    for dt in (0.01, 0.05):
        world = car_world(dt)
        world.command("a", LONGITUDINAL, command)
        runs[dt] = history(world, 9.0)
    for k, coarse in enumerate(runs[0.05]):
        fine = runs[0.01][5 * k]
        assert coarse.v == pytest.approx(fine.v, abs=1e-9)
        assert coarse.x == pytest.approx(fine.x, abs=0.005)


@pytest.mark.parametrize("profile", ["constant", "smooth", "asap", "none"])
def test_lane_change_does_not_depend_on_the_step(car_world: CarWorld, profile: str) -> None:
    runs = {}
    for dt in (0.01, 0.05):
        world = car_world(dt, speed=20.0)
        world.command("a", LATERAL, LaneChange(1, profile=profile))  # type: ignore[arg-type]
        runs[dt] = history(world, 4.0)
    for k, coarse in enumerate(runs[0.05]):
        fine = runs[0.01][5 * k]
        assert coarse.y == pytest.approx(fine.y, abs=1e-9)
        assert coarse.h == pytest.approx(fine.h, abs=1e-6)


def test_change_ends_in_the_step_in_which_the_closed_form_does(car_world: CarWorld) -> None:
    world = car_world()
    world.command("a", LONGITUDINAL, SpeedChange(20.0, "constant", 2.02))  # 4.9505 s
    done = [k for k in range(1, 120) if (world.step(), world.progress("a", LONGITUDINAL).done)[1]]
    assert done[0] == 100
    assert world.state("a").v == 20.0


def test_lane_change_ends_aligned_on_the_centre(car_world: CarWorld, highway: RoadMap) -> None:
    world = car_world(speed=20.0)
    width = abs(highway.pose(LanePosition("1", -2, 0)).y - highway.pose(LanePosition("1", -1, 0)).y)
    world.command("a", LATERAL, LaneChange(1))
    states = history(world, 5.0)
    end = math.ceil(LANE_CHANGE_TIME * math.sqrt(width / 3.5) / 0.05 - 1e-9)
    assert (states[end].lane, states[end].offset) == (-1, 0.0)
    assert states[end].h == pytest.approx(0.0, abs=1e-9)
    assert states[end - 1].offset != 0.0
    peak = max(abs(s.lateral_speed) for s in states)
    assert peak == pytest.approx(0.5 * math.pi * width / (3.0 * math.sqrt(width / 3.5)), rel=1e-2)


def test_lane_is_the_one_under_the_reference_point(car_world: CarWorld) -> None:
    world = car_world(speed=20.0)
    world.command("a", LATERAL, LaneChange(1))
    lanes = [(s.lane, abs(s.offset or 0.0)) for s in history(world, 4.0)]
    assert lanes[0][0] == -2 and lanes[-1][0] == -1
    assert max(offset for _, offset in lanes) <= 1.9
    assert sorted(lanes, key=lambda e: e[0])[0][0] == -2
    assert [lane for lane, _ in lanes] == sorted(lane for lane, _ in lanes)


def test_speed_is_the_length_of_the_path(car_world: CarWorld) -> None:
    world = car_world(speed=12.0)
    world.command("a", LATERAL, LaneChange(1))
    world.command("a", LONGITUDINAL, SpeedChange(18.0, "smooth"))
    states = history(world, 5.0)
    for a, b in itertools.pairwise(states):
        assert math.dist((a.x, a.y), (b.x, b.y)) == pytest.approx(0.025 * (a.v + b.v), abs=1e-9)


def test_parallel_changes_do_not_disturb_each_other(car_world: CarWorld) -> None:
    def drive(*commands: tuple[str, Command]) -> list[ActorState]:
        world = car_world(speed=15.0)
        for slot, command in commands:
            world.command("a", slot, command)
        return history(world, 5.0)

    speed = (LONGITUDINAL, SpeedChange(20.0, "smooth"))
    lane = (LATERAL, LaneChange(1))
    both, fast, across = drive(speed, lane), drive(speed), drive(lane)
    assert [s.v for s in both] == [s.v for s in fast]
    assert [s.y for s in both] == pytest.approx([s.y for s in across], abs=1e-9)
    assert both[-1].lane == -1 and both[-1].v == 20.0


def test_missing_lane_is_a_reason_and_the_car_drives_on(car_world: CarWorld) -> None:
    world = car_world()
    world.command("a", LATERAL, LaneChange(5))
    states = history(world, 1.0)
    assert world.progress("a", LATERAL).failed == (
        "there are not 5 driving lanes to the left of lane -2 of road 1 at s = 100.0 m"
    )
    assert states[-1].lane == -2 and states[-1].v == 10.0


def test_slow_car_turns_no_further_than_the_limit_and_waits_at_standstill(
    car_world: CarWorld,
) -> None:
    world = car_world(speed=1.0)
    world.command("a", LATERAL, LaneChange(1))
    world.command("a", LONGITUDINAL, SpeedChange(0.0, "constant", None, 2.0))
    states = history(world, 6.0)
    assert max(abs(s.h) for s in states) <= HEADING_LIMIT + 1e-9
    assert states[-1].y == states[45].y
    assert states[-1].h == states[45].h != 0.0
    assert not world.progress("a", LATERAL).done
    world.command("a", LONGITUDINAL, SpeedChange(10.0))
    assert history(world, 8.0)[-1].offset == 0.0


def test_interrupted_lane_change_settles_in_the_lane_it_is_in(car_world: CarWorld) -> None:
    for seconds, lane in ((1.0, -2), (2.0, -1)):
        world = car_world(speed=20.0)
        world.command("a", LATERAL, LaneChange(1))
        history(world, seconds)
        world.command("a", LATERAL, None)
        states = history(world, 6.0)
        assert (states[-1].lane, states[-1].offset) == (lane, 0.0)
        turns = [abs(b.h - a.h) for a, b in itertools.pairwise(states)]
        assert max(turns) < 0.02  # rad per step: the heading does not jump


def test_offset_is_held_after_the_command(car_world: CarWorld) -> None:
    world = car_world(speed=20.0)
    world.command("a", LATERAL, LaneOffset(0.5))
    history(world, 3.0)
    world.command("a", LATERAL, None)
    assert history(world, 2.0)[-1].offset == 0.5


def test_at_a_dead_end_it_brakes_with_a_reason(
    highway: RoadMap, make_spec: Callable[..., ActorSpec]
) -> None:
    world = EmbeddedWorld(highway)
    world.add(make_spec("a"))
    world.place("a", LanePosition("1", -2, highway.roads["1"].length - 20.0), 10.0)
    end = highway.pose(LanePosition("1", -2, highway.roads["1"].length))
    before = world.state("a")
    for _ in range(100):
        world.step()
        now = world.state("a")
        assert (now.v - before.v) / world.dt >= -8.0 - 1e-9
        way = math.hypot(now.x - before.x, now.y - before.y)
        assert way == pytest.approx(0.5 * (now.v + before.v) * world.dt, abs=1e-4)
        before = now
    assert now.v == 0.0
    # Half the speed over v / a + a / jerk; it begins with the step after the end.
    way = math.hypot(now.x - end.x, now.y - end.y)
    assert way == pytest.approx(0.5 * 10.0 * (10.0 / 8.0 + 8.0 / 10.0) + 0.5, abs=0.05)
    assert now.h == end.h
    reason = world.progress("a", LONGITUDINAL).failed
    assert reason == "a has reached the end of lane -2 of road 1"


def test_released_slot_holds_the_speed(car_world: CarWorld) -> None:
    world = car_world()
    world.command("a", LONGITUDINAL, SpeedChange(20.0, "smooth"))
    reached = history(world, 1.5)[-1].v
    world.command("a", LONGITUDINAL, None)
    assert {s.v for s in history(world, 2.0)} == {reached}


def test_person_walks_straight_on(
    load_map: Callable[[str], RoadMap], make_spec: Callable[..., ActorSpec]
) -> None:
    road_map = load_map("crossing")
    start = road_map.pose(LanePosition("1", -1, 100.0))
    world = EmbeddedWorld(road_map)
    world.add(make_spec("a", "person"))
    world.place("a", start, 1.5, heading=start.h + math.pi / 2)
    last = history(world, 4.0)[-1]
    assert math.dist((last.x, last.y), (start.x, start.y)) == pytest.approx(6.0)
    assert math.cos(last.h - start.h) == pytest.approx(0.0, abs=1e-9)


def test_curve_is_followed_at_the_length_of_the_lane(
    load_map: Callable[[str], RoadMap], make_spec: Callable[..., ActorSpec]
) -> None:
    road_map = load_map("curve")
    world = EmbeddedWorld(road_map)
    world.add(make_spec("a"))
    start = LanePosition("1", -2, 150.0)
    world.place("a", start, 20.0)
    world.command("a", LONGITUDINAL, SpeedChange(20.0))
    last = history(world, 10.0)[-1]
    assert last.lane_position is not None
    assert road_map.route_distance(start, last.lane_position) == pytest.approx(200.0, abs=1e-3)
    assert last.lane_position.s - 150.0 != pytest.approx(200.0, abs=0.5)


def test_assigned_speed_is_there_at_once(car_world: CarWorld) -> None:
    world = car_world()
    world.assign("a", speed=3.0)
    assert {s.v for s in history(world, 0.5)} == {3.0}


def test_two_runs_are_equal(car_world: CarWorld) -> None:
    def drive() -> list[ActorState]:
        world = car_world()
        world.command("a", LATERAL, LaneChange(1))
        world.command("a", LONGITUDINAL, SpeedChange(25.0, "asap"))
        return history(world, 10.0)

    assert drive() == drive()

"""Ranges, common shapes, references that move, and angles, in modifiers."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import groupby, pairwise
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Parallel,
    Pose,
    Serial,
    Wait,
    elapsed,
    within,
)
from osc2tx_runtime.domain.map.roads_and_lanes import Lane, MapSegment
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.domain.shapes import (
    CommonAccelerationShape,
    CommonLateralShape,
    CommonSpeedShape,
)
from osc2tx_runtime.modifiers import (
    acceleration,
    change_lane,
    change_speed,
    lane,
    lateral,
    orientation,
    physical_movement,
    position,
    speed,
    yaw,
)
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
JUMP = physical_movement("prefer_non_physical")
STRAIGHT = Path((Pose(60.0, -6.0), Pose(200.0, -6.0)))


# --- ranges ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("modifiers", "v"),
    [
        (lambda s: [speed(speed_range=within(8.0, 14.0))], 10.0),
        (lambda s: [speed(speed_range=within(12.0, 14.0))], 12.0),
        (lambda s: [speed(speed_range=within(6.0, 9.0))], 9.0),
        (lambda s: [speed(speed_range=within(1.0, 3.0), faster_than=s.b)], 13.0),
        (lambda s: [speed(speed_range=within(1.0, 3.0), slower_than=s.b)], 10.0),
        (lambda s: [speed(speed_range=lambda: within(s.b.speed, 20.0))], 12.0),
        (lambda s: [change_speed(speed_range=within(2.0, 4.0))], 12.0),
        (lambda s: [change_speed(speed_range=within(-1.0, 1.0))], 10.0),
        (lambda s: [acceleration(acceleration_range=within(0.5, 2.0))], 13.0),
        (lambda s: [acceleration(acceleration_range=within(-1.0, 1.0))], 10.0),
    ],
)
def test_ranges_of_speeds(run: Run, modifiers: Callable[[TwoCars], list[Any]], v: float) -> None:
    done = run(scenario(lambda s: s.a.drive(*modifiers(s), duration=6.0)))
    assert done.states("a")[-1]["v"] == pytest.approx(v, abs=0.05)


def test_a_speed_stays_in_a_moving_range(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both",
            s.a.drive(speed(speed_range=within(-1.0, 1.0), faster_than=s.b), duration=20.0),
            s.b.change_speed(target=20.0, rate_profile="constant", rate_peak=1.0),
        )

    done = run(scenario(body))
    late = zip(done.states("a"), done.states("b"), strict=True)
    assert all(abs(a["v"] - b["v"]) <= 1.0 + 0.06 for a, b in late if a["t"] > 1.0)
    assert done.states("a")[-1]["v"] == pytest.approx(19.0, abs=0.06)


def test_a_range_of_gaps_is_kept(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return s.a.drive(position(distance_range=within(30.0, 50.0), behind=s.b), duration=30.0)

    done = run(scenario(body))
    gaps = [b["s"] - a["s"] for a, b in zip(done.states("a"), done.states("b"), strict=True)]
    assert gaps[0] == pytest.approx(40.0)
    assert max(gaps) <= 53.5  # it leaves the range by as much as it takes to gain 2 m/s
    assert gaps[-1] == pytest.approx(50.0, abs=0.2)


@pytest.mark.parametrize(
    ("modifier", "offset"),
    [
        (lateral(distance_range=within(-0.5, 0.5)), 0.0),
        (lateral(distance_range=within(0.2, 0.5)), 0.2),
        (lateral(distance_range=within(0.2, 0.5), side="right"), -0.2),
    ],
)
def test_ranges_of_offsets(run: Run, modifier: Any, offset: float) -> None:
    last = run(scenario(lambda s: s.a.drive(modifier, duration=4.0))).states("a")[-1]
    assert last["offset"] == pytest.approx(offset, abs=1e-9)


def test_a_range_at_the_start_is_drawn_from_the_seed(run: Run) -> None:
    class Ranged(TwoCars):
        def placement(self) -> None:
            self.place(
                self.a,
                lane(2),
                position(distance_range=within(50.0, 90.0)),
                speed(speed_range=within(8.0, 12.0)),
            )
            self.place(self.b, lane(3))

        def behavior(self) -> Behaviour:
            return self.a.keep_speed(duration=0.1)

    first, again, other = (run(Ranged, seed=seed).states("a")[0] for seed in (1, 1, 2))
    assert first == again
    assert (first["s"], first["v"]) != (other["s"], other["v"])
    assert 50.0 <= first["s"] <= 90.0 and 8.0 <= first["v"] <= 12.0


def test_follow_lane_within_a_range(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return s.a.follow_lane(offset_range=within(0.3, 0.6), duration=4.0)

    assert run(scenario(body)).states("a")[-1]["offset"] == pytest.approx(0.3, abs=1e-9)


@pytest.mark.parametrize(
    ("options", "time"),
    [
        ({"duration": (2.0, 5.0)}, 3.0),  # what it takes by itself
        ({"duration": (4.0, 5.0)}, 4.0),
        ({"duration": (1.0, 2.7)}, 2.7),
        ({"rate_peak": 1.5}, 0.5 * math.pi * 3.5 / 1.5),
        ({"rate_peak": 1.5, "duration": 3.7}, 3.7),
        ({"rate_profile": "constant", "rate_peak": 0.7}, 5.0),
    ],
)
def test_how_long_a_lane_change_takes(run: Run, options: dict[str, Any], time: float) -> None:
    done = run(scenario(lambda s: s.a.change_lane(side="left", **options)))
    assert done.result.status == "success"
    assert done.result.time == pytest.approx(time, abs=0.051)


def test_a_lane_change_may_jump(run: Run) -> None:
    done = run(scenario(lambda s: s.a.change_lane(JUMP, side="left", offset=0.2)))
    last = done.states("a")[-1]
    assert (done.result.steps, last["lane"], last["offset"]) == (1, -2, pytest.approx(0.2))


@pytest.mark.parametrize("number", [-4, -3, -1])
def test_a_lane_of_the_map(run: Run, number: int) -> None:
    """It changes to another lane than its own, -3, and follows that alone (§8.8.3.2, .3)."""
    target = Lane()
    target.choose(MapSegment("lane", "1", 0, number))
    changes = run(scenario(lambda s: s.a.change_lane(target=target)))
    follows = run(scenario(lambda s: s.a.follow_lane(target=target, offset=0.1, duration=8.0)))
    done, refused = (follows, changes) if number == -3 else (changes, follows)
    assert (done.result.status, done.states("a")[-1]["lane"]) == ("success", number)
    assert (refused.result.status, refused.result.time) == ("failure", 0.0)
    assert number != -3 or done.states("a")[-1]["offset"] == 0.1


# --- shapes ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("modifier", "time", "peak"),
    [
        (speed(20.0, shape=CommonSpeedShape("smooth", 3.0)), 5.24, 3.0),
        (speed(shape=CommonSpeedShape("constant", 2.0, target=20.0)), 5.0, 2.0),
        (speed(20.0, shape=CommonSpeedShape("asap")), 2.9, 4.0),
        (change_speed(10.0, shape=CommonSpeedShape("smooth", 3.0)), 5.24, 3.0),
    ],
)
def test_shape_of_a_speed(run: Run, modifier: Any, time: float, peak: float) -> None:
    states = run(scenario(lambda s: s.a.drive(modifier, duration=8.0))).states("a")
    there = next(e["t"] for e in states if e["v"] == 20.0)
    assert there == pytest.approx(time, abs=0.051)
    assert max(e["a"] for e in states) == pytest.approx(peak, rel=0.01)


def test_shape_of_an_acceleration(run: Run) -> None:
    shaped = acceleration(3.0, shape=CommonAccelerationShape("smooth", 2.25))
    states = run(scenario(lambda s: s.a.drive(shaped, duration=4.0))).states("a")
    assert states[50]["v"] == pytest.approx(10.0 + 3.75)  # 1.875 * 3 / 2.25 = 2.5 s
    assert states[-1]["v"] == pytest.approx(10.0 + 3.75 + 3.0 * 1.5)


@pytest.mark.parametrize(
    "modifier",
    [
        lane(3, shape=CommonLateralShape("smooth", 1.5)),
        change_lane(1, side="left", shape=CommonLateralShape("smooth", 1.5)),
        lateral(4.0, shape=CommonLateralShape("smooth", 1.5)),
        lateral(shape=CommonLateralShape("smooth", 1.5, target=4.0)),
    ],
)
def test_shape_of_a_lateral_place(run: Run, modifier: Any) -> None:
    """4 m with a peak of 1.5 m/s take pi / 2 * 4 / 1.5 s."""
    states = run(scenario(lambda s: s.a.drive(modifier, duration=8.0))).states("a")
    width = states[-1]["y"] - states[0]["y"]
    time = 0.5 * math.pi * width / 1.5
    there = next(e["t"] for e in states if e["y"] == states[-1]["y"])
    assert there == pytest.approx(time, abs=0.051)


# --- references that move ----------------------------------------------------------------------


@pytest.mark.parametrize(("track", "lanes"), [("actual", [-3, -2]), ("projected", [-3])])
def test_in_the_lane_of_one_that_changes_lanes(run: Run, track: Any, lanes: list[int]) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both",
            s.a.drive(lane(same_as=s.b, track=track), duration=10.0),
            Serial("then", Wait(elapsed(2.0)), s.b.change_lane(side="left")),
        )

    done = run(scenario(body))
    assert list(dict.fromkeys(e["lane"] for e in done.states("a"))) == lanes
    assert done.states("a")[-1]["offset"] == 0.0


def test_beside_one_that_changes_lanes_twice(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both",
            s.a.drive(lane(1, side_of=s.b, side="right"), duration=16.0),
            Serial(
                "then",
                Wait(elapsed(4.0)),
                s.b.change_lane(side="left"),
                s.b.change_lane(side="left"),
            ),
        )

    done = run(scenario(body))
    assert [number for number, _ in groupby(e["lane"] for e in done.states("a"))] == [
        -3,
        -4,
        -3,
        -2,
    ]


def test_a_speed_as_another_would_have_it(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both",
            s.a.drive(speed(same_as=s.b, track="projected"), duration=8.0),
            s.b.change_speed(target=20.0),
        )

    assert run(scenario(body)).states("a")[-1]["v"] == 12.0


# --- movement_mode -----------------------------------------------------------------------------


def behind(a: dict[str, Any], b: dict[str, Any]) -> float:
    return float(b["s"] - a["s"])


def across(a: dict[str, Any], b: dict[str, Any]) -> float:
    return float(a["y"] - b["y"])


def fast(a: dict[str, Any], b: dict[str, Any]) -> float:
    return float(a["v"])


@pytest.mark.parametrize(
    ("modifiers", "duration", "quantity"),
    [
        (lambda s: [speed(20.0, movement_mode="monotonous")], 8.0, fast),
        (lambda s: [speed(3.0, at="end", movement_mode="monotonous")], 8.0, fast),
        (lambda s: [speed(4.0, faster_than=s.b, movement_mode="monotonous")], 8.0, fast),
        (lambda s: [position(80.0, behind=s.b, movement_mode="monotonous")], 40.0, behind),
        (lambda s: [position(70.0, behind=s.b, at="end", movement_mode="monotonous")], 9.0, behind),
        (lambda s: [lane(3, movement_mode="monotonous")], 5.0, across),
        (lambda s: [lateral(3.0, side_of=s.b, movement_mode="monotonous")], 9.0, across),
        (lambda s: [lateral(3.0, side_of=s.b, at="end", movement_mode="monotonous")], 5.0, across),
    ],
)
def test_no_detours(
    run: Run,
    modifiers: Callable[[TwoCars], list[Any]],
    duration: float,
    quantity: Callable[[dict[str, Any], dict[str, Any]], float],
) -> None:
    done = run(scenario(lambda s: s.a.drive(*modifiers(s), duration=duration)))
    values = [quantity(a, b) for a, b in zip(done.states("a"), done.states("b"), strict=True)]
    changes = [later - earlier for earlier, later in pairwise(values)]
    assert max(map(abs, changes)) > 1e-3
    assert min(changes) > -2e-4 or max(changes) < 2e-4


# --- headings of vehicles ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("modifier", "angle"),
    [
        (yaw(0.1), 0.1),
        (yaw(angle_range=within(0.1, 0.3)), 0.1),
        (yaw(angle_range=within(-0.2, 0.2)), 0.0),
        (orientation(yaw=-0.1), -0.1),
        (orientation(yaw=-0.1, measure_by="relative_to_road"), -0.1),
    ],
)
def test_a_car_at_an_angle_to_its_lane(run: Run, modifier: Any, angle: float) -> None:
    states = run(scenario(lambda s: s.a.drive(modifier, duration=2.0))).states("a")
    assert states[-1]["h"] == pytest.approx(angle, abs=1e-6)
    gone = states[-1]["y"] - states[0]["y"]
    assert gone == pytest.approx(20.0 * math.sin(angle), abs=1e-4)


def test_a_car_cannot_stand_across_its_lane(run: Run) -> None:
    done = run(scenario(lambda s: s.a.drive(yaw(1.0), duration=2.0)))
    assert "a follows its lane and can turn 28.6 degrees from it, not 57.3" in done.result.reason

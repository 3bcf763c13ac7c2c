"""Modifiers of specific actions, jumps, and what has to hold at the start."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Parallel,
    Person,
    Point,
    Pose,
    Serial,
    Wait,
    elapsed,
    within,
)
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.modifiers import (
    along,
    avoid_collisions,
    change_speed,
    keep_speed,
    lane,
    lateral,
    physical_movement,
    position,
    speed,
    yaw,
)
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
JUMP = physical_movement("prefer_non_physical")
STRAIGHT = Path((Pose(60.0, -6.0), Pose(200.0, -6.0)))


# --- the other side of specific actions --------------------------------------------------------


@pytest.mark.parametrize(
    "act",
    [
        lambda s, *m: s.a.follow_path(*m, absolute=STRAIGHT),
        lambda s, *m: s.a.change_position(*m, target_xyz=Point(200.0, -6.0)),
        lambda s, *m: s.a.follow_lane(*m, duration=8.0),
        lambda s, *m: s.a.change_space_gap(*m, target=1.0, direction="left", reference=s.b),
    ],
)
def test_actions_on_the_way_take_a_speed(run: Run, act: Callable[..., Behaviour]) -> None:
    """From 10 to 14 m/s: 2 m/s^2 with a jerk of 10 m/s^3 take 4 / 2 + 2 / 10 s."""
    states = run(scenario(lambda s: act(s, speed(14.0)))).states("a")
    after = next(e["t"] for e in states if e["v"] == 14.0)
    assert after == pytest.approx(2.2, abs=0.051)


def test_a_replayed_path_takes_a_speed_at_once(run: Run) -> None:
    """It need not be physical (8.8.2.8): the speed is there from the first instant on."""

    def body(s: TwoCars) -> Behaviour:
        return s.a.replay_path(speed(14.0), absolute=STRAIGHT)

    states = run(scenario(body)).states("a")
    assert [e["v"] for e in states[:3]] == [14.0, 14.0, 14.0]


def test_a_lane_change_with_a_speed_at_its_end(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return s.a.change_lane(speed(14.0, at="end"), side="left", duration=5.0)

    done = run(scenario(body))
    last = done.states("a")[-1]
    assert (last["v"], last["lane"], last["offset"], last["t"]) == (14.0, -2, 0.0, 5.0)


def test_it_waits_for_a_speed_at_its_end(run: Run) -> None:
    done = run(scenario(lambda s: s.a.change_lane(speed(30.0, at="end"), side="left")))
    assert done.result.time == pytest.approx(10.2, abs=0.051)  # 20 / 2 + 2 / 10 s; the lane: 3 s


@pytest.mark.parametrize(
    "act",
    [
        lambda s, *m: s.a.change_speed(*m, target=14.0),
        lambda s, *m: s.a.keep_speed(*m, duration=6.0),
        lambda s, *m: s.a.change_acceleration(*m, target=1.0, duration=4.0),
        lambda s, *m: s.a.change_space_headway(*m, target=30.0, direction="behind", reference=s.b),
    ],
)
def test_actions_on_the_speed_take_a_lane(run: Run, act: Callable[..., Behaviour]) -> None:
    last = run(scenario(lambda s: act(s, lane(3, at="end")))).states("a")[-1]
    assert (last["lane"], last["offset"]) == (-2, 0.0)


def test_avoid_collisions_on_any_speed(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both",
            s.a.change_speed(avoid_collisions(True), target=30.0, duration=(0.0, 60.0)),
            s.b.drive(speed(8.0), duration=30.0),
            overlap="any",
        )

    def free(s: TwoCars) -> Behaviour:
        return Parallel("both", s.a.change_speed(target=30.0), s.b.drive(speed(8.0), duration=30.0))

    assert not run(scenario(body), max_time=30.0).result.collisions
    assert run(scenario(free)).result.collisions


def test_keep_speed_is_careful(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both",
            s.a.keep_speed(avoid_collisions(True), duration=20.0),
            s.b.change_speed(target=0.0),
        )

    done = run(scenario(body))
    assert not done.result.collisions
    assert done.states("a")[-1]["v"] < 0.5


@pytest.mark.parametrize(
    ("act", "what"),
    [
        (lambda s: s.a.change_speed(speed(3.0), target=5.0), "modifier Speed"),
        (lambda s: s.a.change_lane(lane(1), side="left"), "modifier Lane"),
        (lambda s: s.a.follow_path(along(STRAIGHT), absolute=STRAIGHT), "modifier Along"),
        (lambda s: s.a.remain_stationary(keep_speed()), "modifier KeepSpeed"),
        (
            lambda s: s.a.change_time_gap(
                speed(3.0), target=5.0, direction="behind", reference=s.b
            ),
            "modifier Speed",
        ),
        (
            lambda s: s.a.keep_space_gap(JUMP, reference=s.b, direction="longitudinal"),
            "cannot be reached instantaneously",
        ),
        (lambda s: s.a.drive(change_speed(1.0, at="start")), "cannot change the speed at the"),
        (lambda s: s.walker.move(lane(2)), "lane is for vehicles, which follow lanes"),
        (
            lambda s: s.walker.change_speed(lateral(0.2), target=1.0),
            "lateral is for vehicles, which follow lanes",
        ),
    ],
)
def test_refused_before_the_start(run: Run, act: Callable[[Any], Behaviour], what: str) -> None:
    class WithWalker(TwoCars):
        def declare(self) -> None:
            super().declare()
            self.walker = Person()

        def behavior(self) -> Behaviour:
            return act(self)

    with pytest.raises(UnsupportedError, match=what):
        run(WithWalker)


# --- physical_movement -------------------------------------------------------------------------


def test_a_speed_may_jump(run: Run) -> None:
    done = run(scenario(lambda s: s.a.change_speed(JUMP, target=30.0)))
    assert (done.result.steps, done.states("a")[-1]["v"]) == (1, 30.0)


def test_an_acceleration_may_jump(run: Run) -> None:
    done = run(scenario(lambda s: s.a.change_acceleration(JUMP, target=9.0)))
    assert (done.result.steps, done.states("a")[-1]["a"]) == (1, pytest.approx(9.0))


def test_limits_hold_where_they_must(run: Run) -> None:
    def fast(s: TwoCars) -> Behaviour:
        return s.a.change_speed(physical_movement("must_be_physical"), target=20.0, duration=2.0)

    assert "requires more than 4 m/s^2" in run(scenario(fast)).result.reason


@pytest.mark.parametrize(
    ("name", "option", "off"),
    [
        ("follow_path", None, 0.1),
        ("follow_path", "prefer_non_physical", 0.0),
        ("replay_path", None, 0.0),
        ("replay_path", "must_be_physical", 0.1),
    ],
)
def test_paths_are_followed_or_replayed(run: Run, name: str, option: Any, off: float) -> None:
    corner = Path((Pose(52.0, -6.0), Pose(80.0, -6.0), Pose(100.0, -2.0), Pose(140.0, -2.0)))
    modifiers = () if option is None else (physical_movement(option),)
    done = run(scenario(lambda s: getattr(s.a, name)(*modifiers, absolute=corner)))
    away = [corner_distance(e) for e in done.states("a") if 85.0 < e["x"] < 99.0]
    assert (max(away) < 1e-6) == (off == 0.0)


def corner_distance(state: dict[str, Any]) -> float:
    return abs(state["y"] + 6.0 - (state["x"] - 80.0) * 0.2) / math.hypot(1.0, 0.2)


# --- at: start ---------------------------------------------------------------------------------


def test_what_holds_at_the_start_is_no_failure(run: Run) -> None:
    """The first phase ends as the second one has to begin."""

    def body(s: TwoCars) -> Behaviour:
        phase = (position(20.0, behind=s.b, at="end"), speed(same_as=s.b, at="end"))
        return Serial(
            "phases",
            s.a.drive(*phase, lane(1, at="end"), duration=6.0),
            s.a.drive(
                position(20.0, behind=s.b, at="start"),
                speed(12.0, at="start"),
                lane(1, at="start"),
                lateral(0.0, at="start"),
                position(10.0, behind=s.b, at="end"),
                speed(14.0, at="end"),
                lane(same_as=s.b, at="end"),
                duration=5.0,
            ),
        )

    done = run(scenario(body))
    assert done.result.status == "success"
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert b["s"] - a["s"] == pytest.approx(10.0, abs=1e-4)
    assert (a["lane"], a["v"]) == (b["lane"], pytest.approx(14.0))


@pytest.mark.parametrize(
    ("modifiers", "reason"),
    [
        (lambda s: [speed(14.0, at="start")], "its speed is 10.00 m/s, not 14.00 m/s"),
        (
            lambda s: [speed(speed_range=within(11.0, 14.0), at="start")],
            "its speed is 10.00 m/s, not from 11.00 to 14.00 m/s",
        ),
        (lambda s: [speed(same_as=s.b, at="start")], "its speed is 10.00 m/s, not 12.00 m/s"),
        (
            lambda s: [position(30.0, behind=s.b, at="start")],
            "its distance behind b is 42.00 m, not 30.00 m",
        ),
        (
            lambda s: [position(time=3.0, behind=s.b, at="start")],
            "its distance behind b is 42.00 m, not 30.00 m",
        ),
        (
            lambda s: [position(80.0, at="start")],
            "its position along its road is 60.00 m, not 80.00 m",
        ),
        (lambda s: [lane(4, at="start")], "in lane -3 of road 1, 2 to the right of the required"),
        (lambda s: [lateral(0.5, at="start")], "left of its lane's centre is 0.00 m, not 0.50 m"),
        (
            lambda s: [lateral(3.0, side_of=s.b, at="start")],
            "its distance left of b is 0.00 m, not 3.00 m",
        ),
        (
            lambda s: [yaw(0.1, at="start")],
            "its heading deviates by -5.7 degrees from the one that yaw requires",
        ),
        (lambda s: [lane(9, at="start")], "road 1 has no lane 9 from the right"),
    ],
)
def test_what_does_not_hold_at_the_start_is_one(
    run: Run, modifiers: Callable[[TwoCars], list[Any]], reason: str
) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial("all", Wait(elapsed(1.0)), s.a.drive(*modifiers(s), duration=2.0))

    done = run(scenario(body))
    assert done.result.status == "failure"
    assert " (two_cars.osc) failed at 1.000 s: " in done.result.reason
    assert reason in done.result.reason


def test_where_it_may_jump_it_is_put_there(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "all",
            Wait(elapsed(1.0)),
            s.a.drive(
                JUMP,
                position(30.0, behind=s.b, at="start"),
                lane(same_as=s.b, at="start"),
                speed(15.0, at="start"),
                keep_speed(),
                duration=2.0,
            ),
        )

    done = run(scenario(body))
    assert done.result.status == "success"
    a, b = done.at("a", 1.0), done.at("b", 1.0)
    assert b["s"] - a["s"] == pytest.approx(30.0, abs=1e-5)
    assert {e["v"] for e in done.states("a") if e["t"] > 0.99} == {15.0}


def test_after_a_jump_the_rest_takes_its_time(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return s.a.drive(
            JUMP,
            lane(4, at="start"),
            position(60.0, at="start"),
            speed(5.0, at="start"),
            duration=1,
        )

    last = run(scenario(body)).states("a")[-1]
    assert (last["lane"], last["v"]) == (-1, 5.0)
    assert last["s"] == pytest.approx(60.0 + 5.0)


def test_a_parallel_jump_is_a_conflict(run: Run) -> None:
    from osc2tx_runtime.errors import SlotConflict

    def body(s: TwoCars) -> Behaviour:
        jump = s.a.drive(JUMP, lane(4, at="start"), duration=1.0)
        return Parallel("both", jump, s.a.change_lane(side="left"))

    with pytest.raises(SlotConflict):
        run(scenario(body))

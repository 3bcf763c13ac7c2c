"""Places, speeds and lanes at the end of an action's duration, against their closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Parallel, Pose, Serial, Wait, elapsed, within
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.modifiers import (
    along,
    distance,
    lane,
    lateral,
    physical_movement,
    position,
    speed,
)
from osc2tx_runtime.world.geometry.guidance import rate_to_place, rate_to_place_and_speed
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]


def driven(steps: int, dt: float, way: float, v: float, end: float | None) -> list[float]:
    """Speeds at the steps of a way in a time."""
    x, speeds = 0.0, [v]
    for left in range(steps, 0, -1):
        missing = way - x - v * left * dt
        if end is None:
            rate = rate_to_place(left, dt, missing)
        else:
            rate = rate_to_place_and_speed(left, dt, missing, end - v)
        x, v = x + v * dt + 0.5 * rate * dt * dt, v + rate * dt
        speeds.append(v)
    assert x == pytest.approx(way, abs=1e-9)
    return speeds


@pytest.mark.parametrize("dt", [0.01, 0.05, 0.2])
def test_least_effort_is_a_line_in_time(dt: float) -> None:
    """10 m/s, 60 m in 4 s: the acceleration falls from 3.75 m/s^2 to 0, to 17.5 m/s."""
    speeds = driven(round(4 / dt), dt, 60.0, 10.0, None)
    for k, v in enumerate(speeds):
        t = k * dt
        assert v == pytest.approx(10.0 + 3.75 * (t - t * t / 8.0), abs=0.2 * dt * dt)


@pytest.mark.parametrize("dt", [0.01, 0.05, 0.2])
def test_least_effort_to_a_place_and_a_speed(dt: float) -> None:
    """The acceleration is a0 + a1 t with both conditions met: 6 * 20 / 16 - 2 * 2 / 4 = 6.5."""
    speeds = driven(round(4 / dt), dt, 60.0, 10.0, 12.0)
    slope = (2.0 * 2.0 / 4.0 - 2.0 * 6.5) / 4.0  # mean of the acceleration is 2 / 4
    for k, v in enumerate(speeds):
        t = k * dt
        assert v == pytest.approx(10.0 + 6.5 * t + 0.5 * slope * t * t, abs=2.0 * dt * dt)
    assert speeds[-1] == pytest.approx(12.0, abs=1e-9)


@pytest.mark.parametrize("dt", [0.01, 0.05])
@pytest.mark.parametrize(
    ("where", "gap"),
    [
        (lambda s: position(30.0, behind=s.b, at="end"), -30.0),
        (lambda s: position(10.0, ahead_of=s.b, at="end"), 10.0),
        (lambda s: position(-10.0, behind=s.b, at="end"), 10.0),
        (lambda s: position(time=2.0, ahead_of=s.b, at="end"), 24.0),
    ],
)
def test_beside_another_exactly_at_the_end(
    run: Run, dt: float, where: Callable[[TwoCars], Any], gap: float
) -> None:
    done = run(scenario(lambda s: s.a.drive(where(s), duration=8.0)), dt=dt)
    assert done.result.status == "success"
    assert done.result.time == pytest.approx(8.0)
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert a["s"] - b["s"] == pytest.approx(gap, abs=1e-5)
    # It starts 40 m behind with 10 m/s, b drives 12 m/s: free end speed is v + 1.5 (D - v T) / T.
    missing = gap + 40.0 + 12.0 * 8.0 - 10.0 * 8.0
    assert a["v"] == pytest.approx(10.0 + 1.5 * missing / 8.0, abs=0.01)


def test_time_behind_another_counts_with_the_own_speed(run: Run) -> None:
    done = run(
        scenario(lambda s: s.a.drive(position(time=1.5, behind=s.b, at="end"), duration=8.0))
    )
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert (b["s"] - a["s"]) / a["v"] == pytest.approx(1.5, abs=0.01)


@pytest.mark.parametrize("dt", [0.01, 0.05])
@pytest.mark.parametrize(
    ("end", "v"),
    [
        (lambda s: speed(14.0, at="end"), 14.0),
        (lambda s: speed(same_as=s.b, at="end"), 12.0),
        (lambda s: speed(1.0, faster_than=s.b, at="end"), 13.0),
    ],
)
def test_cut_in_at_a_place_a_speed_and_a_lane(
    run: Run, dt: float, end: Callable[[TwoCars], Any], v: float
) -> None:
    def body(s: TwoCars) -> Behaviour:
        return s.a.drive(
            position(8.0, ahead_of=s.b, at="end"), end(s), lane(3, at="end"), duration=10.0
        )

    done = run(scenario(body), dt=dt)
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert done.result.status == "success"
    assert a["s"] - b["s"] == pytest.approx(8.0, abs=1e-4)
    assert a["v"] == pytest.approx(v, abs=1e-6)
    assert (a["lane"], a["offset"]) == (b["lane"] + 1, 0.0)


def test_the_other_one_brakes_meanwhile(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both",
            s.a.drive(
                position(20.0, behind=s.b, at="end"), speed(same_as=s.b, at="end"), duration=9
            ),
            s.b.change_speed(target=6.0, rate_profile="smooth", duration=6.0),
        )

    done = run(scenario(body))
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert b["s"] - a["s"] == pytest.approx(20.0, abs=1e-4)
    assert a["v"] == pytest.approx(6.0, abs=1e-6)


def test_the_projected_other_one(run: Run) -> None:
    """b brakes, but only where it would be without that counts."""

    def body(s: TwoCars) -> Behaviour:
        where = position(20.0, behind=s.b, at="end", track="projected")
        return Parallel(
            "both", s.a.drive(where, duration=6), s.b.change_speed(target=2.0, duration=6.0)
        )

    states = run(scenario(body)).states("a")
    assert states[-1]["s"] - states[0]["s"] == pytest.approx(40.0 + 72.0 - 20.0, abs=1e-5)


def test_a_range_of_places_is_entered_at_its_nearest_end(run: Run) -> None:

    def gap(low: float, high: float) -> float:
        def body(s: TwoCars) -> Behaviour:
            where = position(distance_range=within(low, high), behind=s.b, at="end")
            return s.a.drive(where, duration=8.0)

        done = run(scenario(body))
        return float(done.states("b")[-1]["s"] - done.states("a")[-1]["s"])

    assert gap(20.0, 30.0) == pytest.approx(30.0, abs=1e-5)  # unchanged it would be 56 m
    assert gap(50.0, 60.0) == pytest.approx(56.0, abs=1e-5)
    assert gap(70.0, 90.0) == pytest.approx(70.0, abs=1e-5)


@pytest.mark.parametrize("dt", [0.01, 0.05])
def test_a_way_in_a_time_with_a_speed_at_its_end(run: Run, dt: float) -> None:
    def body(s: TwoCars) -> Behaviour:
        return s.a.drive(distance(100.0), speed(14.0, at="end"), duration=8.0)

    states = run(scenario(body), dt=dt).states("a")
    assert states[-1]["s"] - states[0]["s"] == pytest.approx(100.0, abs=1e-5)
    assert states[-1]["v"] == pytest.approx(14.0, abs=1e-9)


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        (
            lambda s: s.a.drive(position(10.0, ahead_of=s.b, at="end"), duration=2.0),
            ") (two_cars.osc) failed at 2.000 s: at the end of its duration it is 46.0 m short of"
            " its target position; its limits are 4 and -8 m/s^2",
        ),
        (
            lambda s: s.a.drive(distance(100.0), speed(40.0, at="end"), duration=3.0),
            "m short of its target position; its limits are 4 and -8 m/s^2",
        ),
    ],
)
def test_too_far(run: Run, body: Callable[[TwoCars], Behaviour], reason: str) -> None:
    done = run(scenario(body))
    assert done.result.status == "failure"
    assert reason in done.result.reason


@pytest.mark.parametrize("dt", [0.01, 0.05])
def test_beside_another_at_the_end(run: Run, dt: float) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "all",
            s.a.change_speed(target=12.0, duration=3.0),
            s.a.drive(lateral(2.5, side_of=s.b, at="end"), duration=4.0),
        )

    done = run(scenario(body), dt=dt)
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert a["y"] - b["y"] == pytest.approx(2.5, abs=1e-4)
    assert done.result.time == pytest.approx(7.0)
    assert math.sin(a["h"]) == pytest.approx(0.0, abs=1e-3)


def test_a_lateral_place_that_takes_longer(run: Run) -> None:
    done = run(scenario(lambda s: s.a.drive(lateral(3.0, side_of=s.b, at="end"), duration=1.0)))
    assert "from its position beside b" in done.result.reason


def test_limits_hold_for_a_speed_at_the_end(run: Run) -> None:
    done = run(
        scenario(lambda s: s.a.drive(speed(20.0, at="end"), physical_movement(), duration=2.0))
    )
    assert "a change from 10.0 to 20.0 m/s in 2 s requires more than 4 m/s^2" in done.result.reason


# --- the end of a phase ------------------------------------------------------------------------


@pytest.mark.parametrize(
    "around",
    [
        lambda s, act: Parallel("phase", act, s.b.drive(), duration=8.0),
        lambda s, act: Parallel("phase", s.b.drive(), Serial("then", act), duration=8.0),
        lambda s, act: Parallel(
            "phase",
            Parallel("both", act, s.b.keep_speed()),
            s.sky.fog(visual_range=90.0),
            duration=8,
        ),
        lambda s, act: Serial("phase", Wait(elapsed(2.0)), act, duration=8.0),
    ],
)
@pytest.mark.parametrize(
    ("modifiers", "gap", "v"),
    [
        (lambda s: [position(20.0, behind=s.b, at="end"), speed(11.0, at="end")], 20.0, 11.0),
        (lambda s: [distance(92.0), speed(12.0, at="end")], None, 12.0),
        (lambda s: [speed(14.0, at="end"), lane(3, at="end")], None, 14.0),
    ],
)
def test_the_end_is_that_of_the_phase(
    run: Run,
    around: Callable[[TwoCars, Behaviour], Behaviour],
    modifiers: Callable[[TwoCars], list[Any]],
    gap: float | None,
    v: float,
) -> None:
    done = run(scenario(lambda s: around(s, s.a.drive(*modifiers(s)))))
    assert (done.result.status, done.result.time) == ("success", 8.0)
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert a["v"] == pytest.approx(v, abs=1e-6)
    if gap is not None:
        assert b["s"] - a["s"] == pytest.approx(gap, abs=1e-4)
    # It has only just got there.
    assert done.states("a")[-3]["v"] != pytest.approx(v, abs=1e-6)


def test_a_goal_that_is_not_there_at_the_end_of_the_phase(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        act = s.a.drive(position(20.0, ahead_of=s.b, at="end"))
        return Parallel("phase", act, s.b.drive(), duration=2.0)

    done = run(scenario(body))
    assert "(two_cars.osc) failed at 2.000 s: at the end of its duration" in done.result.reason


def test_a_path_ends_before_its_phase(run: Run) -> None:
    """Behind its end the car is in its lane again."""
    way = Path((Pose(60.0, -8.75), Pose(80.0, -8.75), Pose(100.0, -7.0)))

    def body(s: TwoCars) -> Behaviour:
        return Parallel("phase", s.a.drive(along(way)), s.b.drive(), duration=12.0)

    done = run(scenario(body))
    assert (done.result.status, done.result.time) == ("success", 12.0)
    assert done.actions("a drive", "end")[0]["t"] < 6.0
    assert done.states("a")[-1]["offset"] == pytest.approx(0.0, abs=0.05)


def test_a_phase_lasts_as_long_as_it_is_to(run: Run) -> None:
    """The other one takes 3 s; what has no end of its own fills the rest."""

    def body(s: TwoCars) -> Behaviour:
        act = s.a.drive(speed(11.0, at="end"))
        return Parallel("phase", act, s.b.change_lane(side="left"), duration=8.0)

    done = run(scenario(body))
    assert (done.result.status, done.result.time) == ("success", 8.0)
    assert done.actions("a drive", "end")[0]["t"] == 8.0
    assert done.states("a")[-1]["v"] == pytest.approx(11.0)


# --- a place at the end, a speed all the time --------------------------------------------------


def test_it_goes_on_until_it_is_there(run: Run) -> None:
    """From 40 m behind at 16 instead of 12 m/s: 30 m take 7.5 s and what gaining speed costs."""
    done = run(scenario(lambda s: s.a.drive(speed(16.0), position(10.0, behind=s.b, at="end"))))
    assert done.result.status == "success"
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert a["v"] == 16.0
    assert 9.8 - 1e-6 <= b["s"] - a["s"] <= 10.1
    lost = 6.0 * (3.0 + 0.2) / 2.0  # 10 to 16 m/s with 2 m/s^2 and a jerk of 10 m/s^3
    assert done.result.time == pytest.approx((30.0 + lost) / 4.0, abs=0.06)


@pytest.mark.parametrize(("gap", "ends"), [(26.0, True), (30.0, False)])
def test_both_have_to_hold_at_the_end(run: Run, gap: float, ends: bool) -> None:
    """After 6 s it is 40 - (6 * 4 - 9.6) = 25.6 m behind."""

    def body(s: TwoCars) -> Behaviour:
        where = position(distance_range=within(gap - 1.0, gap + 1.0), behind=s.b, at="end")
        return Parallel("phase", s.a.drive(speed(16.0), where), s.b.drive(), duration=6.0)

    done = run(scenario(body))
    assert (done.result.status == "success") == ends
    if not ends:
        assert (
            "at its end its distance behind b is 25.60 m, not from 29.00 to 31.00 m"
            in done.result.reason
        )

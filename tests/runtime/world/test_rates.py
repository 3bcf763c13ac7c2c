"""Accelerations, measured against their closed forms."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Serial
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.modifiers import acceleration, distance, physical_movement, position, speed
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
JUMP = physical_movement("prefer_non_physical")


@pytest.mark.parametrize("dt", [0.01, 0.05])
@pytest.mark.parametrize(
    ("options", "time", "peak_jerk", "gain"),
    [
        # from 0 to 3 m/s^2; the gain is the integral: mean times duration (symmetrical courses)
        ({"rate_profile": "constant", "rate_peak": 1.5}, 2.0, 1.5, 3.0),
        ({"rate_profile": "smooth", "rate_peak": 2.25}, 2.5, 2.25, 3.75),
        ({"rate_profile": "smooth", "duration": 4.0}, 4.0, 1.875 * 3 / 4, 6.0),
        ({"rate_profile": "asap"}, 0.3, 10.0, 0.45),
        ({}, 0.6, 5.0, 0.9),
    ],
)
def test_change_acceleration(
    run: Run, dt: float, options: dict[str, Any], time: float, peak_jerk: float, gain: float
) -> None:
    done = run(scenario(lambda s: s.a.change_acceleration(target=3.0, **options)), dt=dt)
    assert done.result.status == "success"
    assert done.result.time == pytest.approx(time, abs=dt + 1e-9)
    states = done.states("a")
    assert states[-1]["v"] == pytest.approx(10.0 + gain + 3.0 * (done.result.time - time), abs=1e-6)
    jerks = [(b["a"] - a["a"]) / dt for a, b in pairwise(states)]
    assert max(jerks[1:-1], default=peak_jerk) == pytest.approx(peak_jerk, rel=0.03)


def test_assign_and_keep_acceleration(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "all",
            s.a.assign_acceleration(acceleration=2.0),
            s.a.keep_acceleration(duration=3.0),
            s.a.keep_speed(duration=1.0),
        )

    states = run(scenario(body)).states("a")
    for state in states:
        time = min(state["t"], 3.0)
        assert state["v"] == pytest.approx(10.0 + 2.0 * time, abs=1e-6)
        assert state["s"] - states[0]["s"] == pytest.approx(
            10.0 * time + time * time + 16.0 * (state["t"] - time), abs=1e-5
        )


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        (
            lambda s: s.a.change_acceleration(target=9.0),
            "an acceleration of 9.00 m/s^2 exceeds its limit of 4 m/s^2",
        ),
        (
            lambda s: s.a.change_acceleration(
                target=-7.0, rate_profile="constant", rate_peak=0.5, duration=(0.0, 20.0)
            ),
            "it comes to a standstill before its acceleration is -7 m/s^2",
        ),
        (
            lambda s: s.a.change_acceleration(target=2.0, rate_peak=1.0, duration=1.0),
            "with rate_peak 1 m/s^3 it takes 2.00 s, not 1 s",
        ),
        (
            lambda s: s.a.drive(speed(20.0, at="end"), physical_movement(), duration=2.0),
            "a change from 10.0 to 20.0 m/s in 2 s requires more than 4 m/s^2",
        ),
        (
            lambda s: s.a.drive(acceleration(5.0), physical_movement(), duration=2.0),
            "an acceleration of 5.00 m/s^2 exceeds its limit of 4 m/s^2",
        ),
        (lambda s: s.a.drive(distance(200.0), duration=4.0), "20.00 m/s^2 exceeds"),
        (
            lambda s: s.a.drive(position(50.0, behind=s.b, at="end"), duration=1.0),
            "at the end of its duration it is 4.0 m beyond its target position;"
            " its limits are 4 and -8 m/s^2",
        ),
    ],
)
def test_what_cannot_be_fails_with_a_reason(
    run: Run, body: Callable[[TwoCars], Behaviour], reason: str
) -> None:
    done = run(scenario(body))
    assert done.result.status == "failure"
    assert reason in done.result.reason


def test_acceleration_at_the_end_of_a_drive(run: Run) -> None:
    done = run(scenario(lambda s: s.a.drive(acceleration(2.0, at="end"), duration=4.0)))
    assert done.result.steps == 80
    states = done.states("a")
    assert states[-1]["v"] == pytest.approx(10.0 + 4.0)  # a grows linearly: half of 2 * 4
    assert states[-1]["a"] == pytest.approx(2.0, abs=0.02)


def test_acceleration_at_the_start_of_a_drive(run: Run) -> None:
    done = run(scenario(lambda s: s.a.drive(acceleration(2.0, at="start"), duration=2.0)))
    states = done.states("a")
    assert states[1]["a"] == pytest.approx(2.0, abs=0.13)
    assert states[-1]["v"] == pytest.approx(10.0 + 0.5 * 2.0 * 2.0 / 5.0)  # to 0 at 5 m/s^3
    assert states[-1]["a"] == 0.0


def test_speed_at_both_ends_of_a_drive(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return s.a.drive(speed(4.0, at="start"), speed(14.0, at="end"), JUMP, duration=5.0)

    states = run(scenario(body)).states("a")
    assert states[1]["v"] == pytest.approx(4.0, abs=0.01)
    assert states[-1]["v"] == 14.0
    assert len(states) == 101


def test_a_speed_at_the_end_ends_a_drive_without_duration(run: Run) -> None:
    done = run(scenario(lambda s: s.a.drive(speed(20.0, at="end"))))
    assert (done.result.status, done.states("a")[-1]["v"]) == ("success", 20.0)


def test_speed_and_acceleration_from_a_start_speed(run: Run) -> None:
    jump = speed(5.0, at="start")
    done = run(scenario(lambda s: s.a.drive(jump, acceleration(1.0), JUMP, duration=4)))
    assert done.states("a")[-1]["v"] == pytest.approx(9.0)


@pytest.mark.parametrize(("way", "end"), [(100.0, 15.0), (40.0, 0.0), (30.0, 0.0)])
def test_a_distance_in_a_time(run: Run, way: float, end: float) -> None:
    states = run(scenario(lambda s: s.a.drive(distance(way), duration=8.0))).states("a")
    assert states[-1]["s"] - states[0]["s"] == pytest.approx(way, abs=0.02)
    assert states[-1]["v"] == pytest.approx(end, abs=1e-6)


def test_a_distance_ends_a_drive(run: Run) -> None:
    states = run(scenario(lambda s: s.a.drive(distance(62.0), speed(14.0)))).states("a")
    way = states[-1]["s"] - states[0]["s"]
    assert 62.0 <= way + 1e-6 < 62.0 + 14.0 * 0.05


def test_a_position_on_the_road_ends_a_drive(run: Run) -> None:
    states = run(scenario(lambda s: s.a.drive(position(distance=120.0, at="end")))).states("a")
    assert 120.0 - 1e-5 <= states[-1]["s"] < 120.5


def test_refused_before_the_start(run: Run) -> None:
    with pytest.raises(UnsupportedError, match="distance constrain the same motion"):
        run(scenario(lambda s: s.a.drive(distance(10.0), speed(3.0), duration=2.0)))
    with pytest.raises(ScenarioError, match="a drive has speed twice"):
        run(scenario(lambda s: s.a.drive(speed(10.0), speed(12.0, at="end"))))

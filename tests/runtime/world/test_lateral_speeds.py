"""Speeds across the lane: all the time, at the start, at the end (DSL 8.9.4)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Parallel, Serial
from osc2tx_runtime.domain.shapes import AnySpeedShape, CommonSpeedShape, OwnShape
from osc2tx_runtime.modifiers import lane, physical_movement, position, speed
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
JUMP = physical_movement("prefer_non_physical")


def across(value: float, **more: Any) -> Any:
    """A speed (m/s) to the left."""
    return speed(value, direction="lateral", **more)


def rate(state: dict[str, Any]) -> float:
    """Speed across the straight lane, which runs along the x axis."""
    return float(state["v"] * math.sin(state["h"]))


def test_reached_at_the_end_of_a_duration(run: Run) -> None:
    """From 0 to 0.5 m/s in 2 s: by the quintic, whose mean is half the end value."""
    act = scenario(lambda s: s.a.drive(across(0.5, at="end"), duration=2.0))
    for dt in (0.05, 0.01):
        states = run(act, dt=dt).states("a")
        assert rate(states[-1]) == pytest.approx(0.5, abs=1e-5)
        way = states[-1]["y"] - states[0]["y"]
        assert way == pytest.approx(0.5, abs=dt * dt)


def test_it_ends_the_action(run: Run) -> None:
    done = run(scenario(lambda s: s.a.drive(across(0.5, at="end"))))
    assert done.result.status == "success"
    assert rate(done.states("a")[-1]) == pytest.approx(0.5, abs=1e-5)


def test_with_a_speed_along_the_lane(run: Run) -> None:
    """Two speeds, one in each direction, are no contradiction."""
    act = scenario(lambda s: s.a.drive(across(0.5), speed(14.0), duration=4.0))
    states = run(act).states("a")
    assert (states[-1]["v"], rate(states[-1])) == pytest.approx((14.0, 0.5), abs=1e-5)


def test_it_has_to_hold_at_the_start(run: Run) -> None:
    """What the action before has left is there; anything else is not."""

    def body(wanted: float) -> Callable[[TwoCars], Behaviour]:
        return lambda s: Serial(
            "drift",
            s.a.drive(across(0.5), duration=2.0),
            s.a.drive(across(wanted, at="start"), duration=2.0),
        )

    assert run(scenario(body(0.5))).result.status == "success"
    done = run(scenario(body(0.1)))
    assert "at its start its lateral speed is 0.50 m/s, not 0.10 m/s" in done.result.reason


def test_it_jumps_at_the_start_and_runs_out(run: Run) -> None:
    act = scenario(lambda s: s.a.drive(across(0.5, at="start"), JUMP, duration=4.0))
    states = run(act).states("a")
    assert rate(states[1]) == pytest.approx(0.5, abs=0.05)
    assert rate(states[-1]) == 0.0
    assert states[-1]["y"] - states[0]["y"] == pytest.approx(0.2, abs=1e-6)  # 0.4 s of it


def test_from_a_start_to_an_end(run: Run) -> None:
    """From 1 m/s at once to -1 m/s in 2 s: back where it was."""
    wishes = (across(1.0, at="start"), across(-1.0, at="end", shape=CommonSpeedShape("smooth")))
    states = run(scenario(lambda s: s.a.drive(*wishes, duration=2.0))).states("a")
    assert len(states) == 1  # it does not go to the left yet, and may not jump
    states = run(scenario(lambda s: s.a.drive(*wishes, JUMP, duration=2.0))).states("a")
    assert rate(states[-1]) == pytest.approx(-1.0, abs=1e-5)


def test_a_car_starts_with_it(run: Run) -> None:
    class Drifting(TwoCars):
        def placement(self) -> None:
            self.place(self.a, lane(2), position(distance=50.0), speed(10.0), across(0.6))
            self.place(self.b, lane(1), position(distance=50.0), speed(10.0))

        def behavior(self) -> Behaviour:
            start = self.a.drive(across(0.6, at="start"))
            return Parallel("both", start, self.b.drive(), duration=3.0)

    states = run(Drifting).states("a")
    assert rate(states[0]) == pytest.approx(0.6)
    assert states[-1]["offset"] == pytest.approx(0.24, abs=1e-6)  # 0.4 s of it


def test_as_another_one(run: Run) -> None:
    """Half as fast across as `b`, which changes lanes."""

    def body(s: TwoCars) -> Behaviour:
        mine = s.a.drive(speed(same_as=s.b, direction="lateral", factor=0.5))
        return Parallel("both", mine, s.b.change_lane(side="left", duration=4.0), overlap="any")

    done = run(scenario(body))
    for before, mine in zip(done.states("b"), done.states("a")[1:], strict=False):
        assert rate(mine) == pytest.approx(0.5 * rate(before), abs=1e-5)


@pytest.mark.parametrize(
    ("shape", "at_two"),
    [
        (CommonSpeedShape("constant", 0.25), 0.5),
        (OwnShape(AnySpeedShape(), lambda _s, t: 0.3 * t, lambda _s: 4.0), 0.6),
    ],
)
def test_by_a_shape(run: Run, shape: Any, at_two: float) -> None:
    act = scenario(lambda s: s.a.drive(speed(1.2, direction="lateral", shape=shape), duration=2.0))
    assert rate(run(act).states("a")[-1]) == pytest.approx(at_two, abs=1e-5)


def test_more_than_tyres_can_do(run: Run) -> None:
    done = run(scenario(lambda s: s.a.drive(across(4.0, at="end"), duration=0.2)))
    assert "from 0.0 to 4.0 m/s in 0.20 s requires more than 12 m/s^2" in done.result.reason


@pytest.mark.parametrize("dt", [0.05, 0.02, 0.01])
def test_a_constant_rate_ends_with_its_lane_change(run: Run, dt: float) -> None:
    """It is aligned with its lane then (§8.8.3.3), so that nothing is taken over by what follows.

    The change takes 1 s, but for what rounding adds to a length that is computed; the next one
    moves by 3.5 m in 3 s, half of it in the first half.
    """
    length = 1.0 + 1e-10
    act = scenario(
        lambda s: Serial(
            "twice",
            s.a.change_lane(num_of_lanes=1, side="left", rate_profile="constant", duration=length),
            s.a.change_lane(num_of_lanes=1, side="right", rate_profile="smooth", duration=3.0),
        )
    )
    states = run(act, dt=dt).states("a")
    first = next(state for state in states if state["t"] == pytest.approx(1.0))
    assert rate(first) == pytest.approx(0.0, abs=1e-9)
    half = next(state for state in states if state["t"] == pytest.approx(2.5))
    assert first["y"] - half["y"] == pytest.approx(0.5 * 3.5, abs=0.02)

"""Shapes that a scenario computes itself: speeds, accelerations, places across, headings."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Parallel, Person, Serial
from osc2tx_runtime.domain.points_and_poses import Point
from osc2tx_runtime.domain.shapes import (
    AnyAccelerationShape,
    AnyLateralShape,
    AnyShape,
    AnySpeedShape,
    CommonAccelerationShape,
    CommonLateralShape,
    CommonPositionShape,
    CommonSpeedShape,
    OwnShape,
)
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.modifiers import (
    acceleration,
    change_lane,
    change_speed,
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


def own(base: Any, compute: Callable[[float], float], duration: float | None = None) -> Any:
    """A shape of a scenario with these methods."""
    length = None if duration is None else (lambda _shape: duration)
    return OwnShape(base, lambda _shape, t: compute(t), length)


SPEED, RATE, ASIDE = AnySpeedShape(), AnyAccelerationShape(), AnyLateralShape()


# --- speed and acceleration -------------------------------------------------------------------


def wave(t: float) -> float:
    """10 m/s, 12 m/s, 8 m/s, ..."""
    return 10.0 + 2.0 * math.sin(t)


@pytest.mark.parametrize("dt", [0.05, 0.01])
def test_a_speed_of_its_own(run: Run, dt: float) -> None:
    act = scenario(lambda s: s.a.drive(speed(shape=own(SPEED, wave)), duration=7.0))
    states = run(act, dt=dt).states("a")
    assert all(state["v"] == pytest.approx(wave(state["t"]), abs=1e-6) for state in states)
    # The way is the integral, by the trapezoidal rule: dt^2 / 12 * 7 s * 2 m/s^2 at most.
    way = 10.0 * 7.0 + 2.0 * (1.0 - math.cos(7.0))
    assert states[-1]["s"] - 50.0 == pytest.approx(way, abs=7.0 * 2.0 * dt * dt / 12.0)


def test_it_ends_when_it_says(run: Run) -> None:
    ramp = own(SPEED, lambda t: 10.0 + t, 4.0)
    done = run(scenario(lambda s: s.a.drive(speed(shape=ramp, at="end"))))
    assert (done.result.time, done.states("a")[-1]["v"]) == pytest.approx((4.0, 14.0))
    stays = run(scenario(lambda s: s.a.drive(speed(shape=ramp), duration=6.0))).states("a")
    assert {state["v"] for state in stays if state["t"] >= 4.0} == {14.0}


@pytest.mark.parametrize(
    ("modifier", "message"),
    [
        (speed(15.0, shape=own(SPEED, lambda t: 10.0 + t, 4.0)), "reaches 14, which is not 15"),
        (speed(shape=own(SPEED, lambda t: 12.0 + t, 4.0)), "has 12.00 m/s, after 10.00 m/s"),
        (speed(shape=own(SPEED, lambda t: 10.0 + 20 * t, 4.0)), "its shape requires 20.00 m/s^2"),
        (speed(shape=own(SPEED, lambda t: 30.0)), "its shape requires 400.00 m/s^2"),
        (
            speed(shape=own(SPEED, wave, 7.0), movement_mode="monotonous"),
            "speed: it would have to reverse after",
        ),
        (
            acceleration(shape=own(RATE, lambda t: t * t - t, 2.0), movement_mode="monotonous"),
            "reverse",
        ),
    ],
)
def test_speeds_that_cannot_be(run: Run, modifier: Any, message: str) -> None:
    try:
        done = run(scenario(lambda s: s.a.drive(modifier, duration=7.0)))
    except ScenarioError as error:
        assert message in error.message
    else:
        assert message in done.result.reason


def test_a_jump_of_its_own(run: Run) -> None:
    step = own(SPEED, lambda t: 10.0 if t < 1.0 else 20.0)
    act = scenario(lambda s: s.a.drive(speed(shape=step), JUMP, duration=2.0))
    states = run(act).states("a")
    assert [states[19]["v"], states[20]["v"]] == [10.0, 20.0]


def test_a_change_of_its_own(run: Run) -> None:
    """The value of `change_speed` is a difference."""
    act = scenario(lambda s: s.a.drive(change_speed(shape=own(SPEED, math.sin)), duration=3.0))
    states = run(act).states("a")
    assert states[40]["v"] == pytest.approx(10.0 + math.sin(2.0), abs=1e-6)


def test_a_difference_of_its_own(run: Run) -> None:
    """So much slower than the other one, which gains 1 m/s^2 itself."""
    shape = own(SPEED, lambda t: 2.0 + math.sin(t))

    def body(s: TwoCars) -> Behaviour:
        mine = s.a.drive(speed(slower_than=s.b, shape=shape))
        return Parallel("both", mine, s.b.drive(acceleration(1.0)), duration=4.0)

    done = run(scenario(body))
    for mine, other in zip(done.states("a"), done.states("b"), strict=True):
        # The first step does not know yet that the other one will gain speed.
        near = 0.06 if mine["t"] < 0.1 else 1e-6
        slower = 2.0 + math.sin(mine["t"])
        assert other["v"] - mine["v"] == pytest.approx(slower, abs=near)


def test_a_common_shape_of_a_difference(run: Run) -> None:
    """From 2 m/s slower to 3 m/s faster at 1 m/s^2: 5 s."""
    shape = CommonSpeedShape("constant", 1.0)

    def body(s: TwoCars) -> Behaviour:
        mine = s.a.drive(speed(3.0, faster_than=s.b, shape=shape, at="end"))
        return Parallel("both", mine, s.b.drive(duration=9.0), overlap="any")

    end = run(scenario(body)).actions("a drive", "end")[0]
    assert end["t"] == pytest.approx(5.0, abs=0.051)


def test_an_acceleration_of_its_own(run: Run) -> None:
    """The speed is the integral: 10 + 1 - cos(t)."""
    act = scenario(lambda s: s.a.drive(acceleration(shape=own(RATE, math.sin)), duration=5.0))
    for state in run(act).states("a"):
        assert state["v"] == pytest.approx(11.0 - math.cos(state["t"]), abs=1e-6)


# --- across the lane --------------------------------------------------------------------------


def test_a_place_of_its_own(run: Run) -> None:
    """It sways by half a metre, then by what is left of the time."""
    sway = own(ASIDE, lambda t: 0.5 * math.sin(t))
    states = run(scenario(lambda s: s.a.drive(lateral(shape=sway), duration=5.0))).states("a")
    for state in states[1:]:
        assert state["offset"] == pytest.approx(0.5 * math.sin(state["t"]), abs=1e-6)


def test_the_distance_counts_as_it_says(run: Run) -> None:
    """To the right, from the right edge of the car to that of the lane (3.5 m wide)."""
    shape = own(ASIDE, lambda t: -0.8 + 0.4 * t, 2.0)
    wish = lateral(side="right", measure_by="right_to_right", shape=shape)
    states = run(scenario(lambda s: s.a.drive(wish, duration=3.0))).states("a")
    right_edge = [1.75 + state["offset"] - 0.95 for state in states]
    assert right_edge[0] == pytest.approx(0.8)
    assert right_edge[-1] == pytest.approx(0.0, abs=1e-6)


def test_a_lane_change_of_its_own(run: Run) -> None:
    """The place counts from the centre of the lane to be in."""
    shape = own(ASIDE, lambda t: -3.5 * (1.0 + math.cos(math.pi * t / 4.0)) / 2.0, 4.0)
    act = scenario(lambda s: s.a.drive(change_lane(side="left", shape=shape), duration=5.0))
    states = run(act).states("a")
    assert states[40]["y"] - states[0]["y"] == pytest.approx(1.75, abs=1e-6)
    assert (states[-1]["lane"], states[-1]["offset"]) == (-2, 0.0)
    away = own(ASIDE, lambda t: t, 1.0)
    done = run(scenario(lambda s: s.a.drive(lane(3, shape=away), duration=5.0)))
    assert "the shape starts 0.00 m left of the centre of its lane, and it is -3.50 m" in (
        done.result.reason
    )


@pytest.mark.parametrize("shape", [CommonLateralShape("smooth"), None])
def test_beside_another_one(run: Run, shape: CommonLateralShape | None) -> None:
    """From 3.5 m to the right of `b` to 3 m, in 4 s; a shape of its own does the same."""
    given: Any = shape or own(ASIDE, lambda t: 3.5 - 0.125 * t, 4.0)

    def body(s: TwoCars) -> Behaviour:
        aside = lateral(3.0, side_of=s.b, side="right", at="end", shape=given)
        return Serial(
            "beside",
            s.b.change_lane(side="left", duration=3.0),
            Parallel("both", s.a.drive(aside, duration=4.0), s.b.drive(duration=4.0)),
        )

    done = run(scenario(body))
    mine, other = done.states("a"), done.states("b")
    assert mine[-1]["y"] - other[-1]["y"] == pytest.approx(-3.0, abs=1e-3)
    assert mine[100]["y"] - other[100]["y"] == pytest.approx(-3.25, abs=1e-3)


# --- headings ---------------------------------------------------------------------------------


def test_a_heading_of_its_own(run: Run) -> None:
    """A person turns as the shape says; a car on a lane follows it up to half a radian."""
    turn = own(AnyShape(), lambda t: 0.3 * math.sin(t))

    class Walking(TwoCars):
        def declare(self) -> None:
            super().declare()
            self.p = Person()

        def placement(self) -> None:
            super().placement()
            self.place(self.p, position(at_point=Point(20.0, 4.0), project_on_route=False))

        def behavior(self) -> Behaviour:
            walk = self.p.walk(yaw(shape=turn), speed(1.0))
            return Parallel("turn", walk, self.a.drive(yaw(shape=turn)), duration=4.0)

    done = run(Walking)
    start = done.states("p")[0]["h"]
    for who in ("p", "a"):
        turned = done.at(who, 2.0)["h"] - (start if who == "p" else 0.0)
        assert math.remainder(turned, math.tau) == pytest.approx(0.3 * math.sin(2.0), abs=1e-6)
    wild = own(AnyShape(), lambda t: t, 2.0)
    done = run(scenario(lambda s: s.a.drive(yaw(shape=wild), duration=2.0)))
    assert "can turn 28.6 degrees from it, not" in done.result.reason


# --- asked by themselves ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("shape", "time", "halfway"),
    [
        (CommonSpeedShape("constant", 2.0, 10.0), 5.0, 5.0),
        (CommonSpeedShape("smooth", 2.0, 10.0), 0.5 * math.pi * 5.0, 5.0),
        (CommonAccelerationShape("smooth", 1.0, -2.0), 1.875 * 2.0, -1.0),
        (CommonLateralShape("constant", 0.5, 3.5), 7.0, 1.75),
        (CommonPositionShape("smooth", 3.0, 30.0), 1.875 * 10.0, 15.0),
    ],
)
def test_common_shapes_count_from_zero(shape: Any, time: float, halfway: float) -> None:
    assert shape.duration() == pytest.approx(time)
    assert shape.compute(0.5 * time) == pytest.approx(halfway)
    assert (shape.compute(0.0), shape.compute(2.0 * time)) == (0.0, shape.target)


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        (CommonSpeedShape("smooth", 2.0), "without a target has no values by itself"),
        (CommonSpeedShape("asap", 2.0, 10.0), "otherwise they depend on the actor"),
        (CommonSpeedShape("smooth", None, 10.0), "has values by itself with a rate_peak"),
    ],
)
def test_common_shapes_that_depend_on_the_actor(shape: Any, message: str) -> None:
    with pytest.raises(ScenarioError, match=message):
        shape.duration()

"""Shapes of positions: where an actor is at any time (DSL 8.9.1.2)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Parallel, Pose, within
from osc2tx_runtime.domain.paths.path_values import Path, Trajectory
from osc2tx_runtime.domain.points_and_poses import Point
from osc2tx_runtime.domain.shapes import (
    AnyPositionShape,
    AnySpeedShape,
    CommonPositionShape,
    CommonSpeedShape,
    OwnShape,
)
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.modifiers import (
    acceleration,
    along,
    along_trajectory,
    distance,
    keep_speed,
    physical_movement,
    position,
    speed,
)
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
JUMP = physical_movement("prefer_non_physical")
MONOTONOUS = "monotonous"


def own(compute: Callable[[float], float], duration: float | None = None) -> OwnShape[Any]:
    """A shape of a scenario with these methods."""
    length = None if duration is None else (lambda _shape: duration)
    return OwnShape(AnyPositionShape(), lambda _shape, t: compute(t), length)


def quintic(t: float, length: float, change: float, rate: float) -> tuple[float, float]:
    """Value and rate of the polynomial that takes over a rate and ends at rest, by its definition.

    a t^3 + b t^4 + c t^5 from the three conditions at the end, solved by elimination.
    """
    d, v, big = change - rate * length, -rate, length
    a = (10 * d - 4 * v * big) / big**3
    b = (-15 * d + 7 * v * big) / big**4
    c = (6 * d - 3 * v * big) / big**5
    value = rate * t + a * t**3 + b * t**4 + c * t**5
    return value, rate + 3 * a * t**2 + 4 * b * t**3 + 5 * c * t**4


# --- of the way -------------------------------------------------------------------------------


def test_a_smooth_way_ends_at_rest_in_time(run: Run) -> None:
    """From 10 m/s, 40 m in 8 s: the quintic, whatever the step."""
    shape = CommonPositionShape("smooth")
    body = scenario(lambda s: s.a.drive(distance(40.0, shape=shape), duration=8.0))
    for dt in (0.05, 0.01):
        states = run(body, dt=dt).states("a")
        for state in states:
            way, rate = quintic(state["t"], 8.0, 40.0, 10.0)
            assert state["s"] - 50.0 == pytest.approx(way, abs=1e-4)
            assert state["v"] == pytest.approx(rate, abs=1e-3)
        assert states[-1]["v"] == pytest.approx(0.0, abs=1e-3)


def test_a_peak_is_reached(run: Run) -> None:
    """A peak of 13 m/s from 10 m/s over 100 m; the length follows from it."""
    shape = CommonPositionShape("smooth", rate_peak=13.0)
    done = run(scenario(lambda s: s.a.drive(distance(100.0, shape=shape))))
    states = done.states("a")
    assert max(state["v"] for state in states) == pytest.approx(13.0, abs=0.01)
    assert states[-1]["s"] == pytest.approx(150.0, abs=0.51)  # the last step is not a whole one
    assert done.result.status == "success"


def test_a_constant_rate(run: Run) -> None:
    """40 m at 10 m/s are 4 s, at the speed it has."""
    shape = CommonPositionShape("constant", rate_peak=10.0)
    done = run(scenario(lambda s: s.a.drive(distance(40.0, shape=shape))))
    assert done.result.time == pytest.approx(4.0)
    assert {state["v"] for state in done.states("a")} == {10.0}


def test_a_jump_of_the_speed_needs_no_physics(run: Run) -> None:
    shape = CommonPositionShape("constant", rate_peak=20.0)
    done = run(scenario(lambda s: s.a.drive(distance(40.0, shape=shape))))
    assert "at its start its shape has 20.00 m/s, after 10.00 m/s" in done.result.reason
    done = run(scenario(lambda s: s.a.drive(distance(40.0, shape=shape), JUMP)))
    assert (done.result.time, done.states("a")[-1]["s"]) == pytest.approx((2.0, 90.0))


def test_as_soon_as_possible_within_the_limits(run: Run) -> None:
    """A car brakes and gains 4 m/s^2 at most here (the smaller of both)."""
    shape = CommonPositionShape("asap", target=60.0)
    states = run(scenario(lambda s: s.a.drive(distance(60.0, shape=shape)))).states("a")
    assert max(abs(state["a"]) for state in states) == pytest.approx(4.0, abs=0.1)


@pytest.mark.parametrize("at", ["all", "end"])
def test_a_place_on_the_lane(run: Run, at: Any) -> None:
    """From s = 50 m to 90 m in 8 s, then it stays."""
    shape = CommonPositionShape("smooth", rate_peak=None, target=90.0)
    place = position(shape=shape, at=at)
    states = run(scenario(lambda s: s.a.drive(place, duration=8.0))).states("a")
    assert states[-1]["s"] == pytest.approx(90.0, abs=0.05)
    if at == "end":
        assert states[80]["s"] == pytest.approx(50.0 + quintic(4.0, 8.0, 40.0, 10.0)[0], abs=1e-3)


def test_a_place_from_a_point(run: Run) -> None:
    """20 m behind the point at s = 110 m."""
    shape = CommonPositionShape("smooth")
    place = position(20.0, behind_point=Point(110.0, -8.75), at="end", shape=shape)
    last = run(scenario(lambda s: s.a.drive(place, duration=8.0))).states("a")[-1]
    assert (last["s"], last["v"]) == pytest.approx((90.0, 0.0), abs=0.01)


def test_a_path_is_followed_on_time(run: Run) -> None:
    """A straight path of 60 m: the shape counts from its start, 10 m before the car."""
    path = Path((Pose(40.0, -8.75), Pose(100.0, -8.75)))
    shape = own(lambda t: 10.0 + 10.0 * t, 5.0)
    done = run(scenario(lambda s: s.a.drive(along(path, shape=shape))))
    assert done.result.time == pytest.approx(5.0)
    assert done.at("a", 3.0)["x"] == pytest.approx(80.0, abs=1e-3)
    short = own(lambda t: 10.0 + 10.0 * t, 4.0)
    done = run(scenario(lambda s: s.a.drive(along(path, shape=short))))
    assert "the shape ends 50 m along the route, which it has to leave after 60" in (
        done.result.reason
    )


# --- of scenarios -----------------------------------------------------------------------------


def test_a_way_of_its_own(run: Run) -> None:
    """10 t + 8 (1 - cos(t / 2)): faster and slower again; every step is where it says."""

    def way(t: float) -> float:
        return 10.0 * t + 8.0 * (1.0 - math.cos(0.5 * t))

    shape = own(way, 6.0)
    states = run(scenario(lambda s: s.a.drive(distance(way(6.0), shape=shape)))).states("a")
    assert len(states) == 121
    for state in states:
        assert state["s"] - 50.0 == pytest.approx(way(state["t"]), abs=1e-4)
        assert state["v"] == pytest.approx(10.0 + 4.0 * math.sin(0.5 * state["t"]), abs=1e-3)


def test_a_way_that_goes_on(run: Run) -> None:
    """Without a duration it lasts as long as the action."""
    shape = own(lambda t: 50.0 + 10.0 * t + 0.5 * t * t)
    states = run(scenario(lambda s: s.a.drive(position(shape=shape), duration=5.0))).states("a")
    assert states[-1]["s"] == pytest.approx(50.0 + 50.0 + 12.5, abs=1e-4)


def test_it_is_asked_for_what_cannot_be(run: Run) -> None:
    steep = own(lambda t: 10.0 * t + 8.0 * t * t, 2.0)
    done = run(scenario(lambda s: s.a.drive(distance(52.0, shape=steep))))
    assert (
        "its shape requires 16.00 m/s^2, which exceeds its limit of 12 m/s^2" in done.result.reason
    )
    must = physical_movement("must_be_physical")
    some = own(lambda t: 10.0 * t + 3.0 * t * t, 2.0)
    done = run(scenario(lambda s: s.a.drive(distance(32.0, shape=some), must)))
    assert "which exceeds its limit of 4 m/s^2" in done.result.reason
    broken = own(lambda t: 1.0 / (t - t), 2.0)
    with pytest.raises(ScenarioError, match="`compute` of the shape has no value: float division"):
        run(scenario(lambda s: s.a.drive(distance(52.0, shape=broken))))
    negative = own(lambda t: t, -1.0)
    with pytest.raises(ScenarioError, match="the duration of the shape is -1 s"):
        run(scenario(lambda s: s.a.drive(distance(52.0, shape=negative))))


# --- of the distance to another actor ---------------------------------------------------------


def both(s: TwoCars, *modifiers: Any, time: float = 8.0, lead: Any = None) -> Behaviour:
    """Car `a` by its modifiers, while `b` goes on or does something else."""
    other = s.b.drive() if lead is None else lead(s)
    return Parallel("both", s.a.drive(*modifiers), other, duration=time)


@pytest.mark.parametrize("dt", [0.05, 0.01])
def test_a_gap_closes_as_it_says(run: Run, dt: float) -> None:
    """From 40 m behind to 20 m in 8 s; it falls back at 2 m/s at first."""

    def body(s: TwoCars) -> Behaviour:
        wish = position(20.0, behind=s.b, at="end", shape=CommonPositionShape("smooth"))
        return both(s, wish)

    done = run(scenario(body), dt=dt)
    for mine, other in zip(done.states("a"), done.states("b"), strict=True):
        gap, rate = quintic(mine["t"], 8.0, -20.0, 2.0)
        assert other["s"] - mine["s"] == pytest.approx(40.0 + gap, abs=1e-3)
        assert other["v"] - mine["v"] == pytest.approx(rate, abs=1e-3)


def test_a_gap_of_its_own(run: Run) -> None:
    """It sways about 40 m; the sign of `behind` is the one of the distance."""
    shape = own(lambda t: 40.0 + 2.0 * t - 2.0 * math.sin(t), 2.0 * math.pi)

    def body(s: TwoCars) -> Behaviour:
        return both(s, position(behind=s.b, shape=shape), time=6.0)

    done = run(scenario(body))
    for mine, other in zip(done.states("a"), done.states("b"), strict=True):
        wanted = 40.0 + 2.0 * mine["t"] - 2.0 * math.sin(mine["t"])
        assert other["s"] - mine["s"] == pytest.approx(wanted, abs=2e-3)


@pytest.mark.parametrize("track", ["actual", "projected"])
def test_it_keeps_up_with_what_the_other_does(run: Run, track: Any) -> None:
    """The other one gains 1 m/s^2; a projected one would go on at 12 m/s."""
    shape = CommonPositionShape("smooth")

    def body(s: TwoCars) -> Behaviour:
        wish = position(25.0, behind=s.b, at="end", track=track, shape=shape)
        return both(s, wish, lead=lambda s: s.b.drive(acceleration(1.0)))

    done = run(scenario(body))
    ahead = done.states("b")[-1]["s"] if track == "actual" else 90.0 + 12.0 * 8.0
    assert ahead - done.states("a")[-1]["s"] == pytest.approx(25.0, abs=0.02)


# --- what goes together -----------------------------------------------------------------------

SHAPE = CommonPositionShape("smooth", target=30.0)


@pytest.mark.parametrize(
    ("modifiers", "message"),
    [
        ([distance(30.0, shape=SHAPE), speed(3.0)], "distance and speed constrain the same motion"),
        (
            [position(shape=SHAPE), keep_speed()],
            "position and keep_speed constrain the same motion",
        ),
        ([position(shape=SHAPE), distance(2.0)], "position and distance constrain the same motion"),
        ([distance(30.0, shape=SHAPE), acceleration(1.0)], "distance and acceleration constrain"),
    ],
)
def test_it_leaves_no_room(run: Run, modifiers: list[Any], message: str) -> None:
    with pytest.raises(UnsupportedError, match=message):
        run(scenario(lambda s: s.a.drive(*modifiers)))


def test_what_is_no_shape_of_it() -> None:
    with pytest.raises(ScenarioError, match="position: a shape of it is an any_position_shape"):
        position(shape=CommonSpeedShape("smooth"))  # type: ignore[arg-type]
    with pytest.raises(ScenarioError, match="distance: a shape of it is an any_position_shape"):
        distance(3.0, shape=OwnShape(AnySpeedShape(), lambda _s, t: t))  # type: ignore[arg-type]
    with pytest.raises(ScenarioError, match="`shape` and `time` exclude each other"):
        position(time=2.0, shape=SHAPE)
    with pytest.raises(TypeError, match="shape"):
        along_trajectory(Trajectory((), ()), shape=SHAPE)  # type: ignore[call-arg]


def test_two_values_for_one_end(run: Run) -> None:
    with pytest.raises(ScenarioError, match="the shape reaches 30, which is not 40"):
        run(scenario(lambda s: s.a.drive(distance(40.0, shape=SHAPE))))


def test_a_shape_says_nothing_of_a_start(run: Run) -> None:
    with pytest.raises(ScenarioError, match="`at: start` leaves no room for `shape`"):
        run(scenario(lambda s: s.a.drive(position(shape=SHAPE, at="start"))))


def test_ranges_are_met_at_their_nearest_end(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        wish = position(distance_range=within(20.0, 30.0), behind=s.b, at="end", shape=LATE)
        return both(s, wish)

    done = run(scenario(body))
    assert done.states("b")[-1]["s"] - done.states("a")[-1]["s"] == pytest.approx(30.0, abs=1e-3)


LATE = CommonPositionShape("smooth")

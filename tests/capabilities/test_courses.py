"""C14, C19, C21, C22, C26: courses over time, gaps in time, pitch and roll."""

import math

import pytest

from tests.capabilities.kit import DT, ROUNDED, Perform, Performance, next_step


def hermite(start: float, end: float, rate: float, duration: float, t: float) -> float:
    """Cubic from a value with a rate to a value at rest."""
    x = t / duration
    first = 2.0 * x**3 - 3.0 * x**2 + 1.0
    slope = duration * (x**3 - 2.0 * x**2 + x)
    return first * start + slope * rate + (1.0 - first) * end


def coming_to_rest(change: float, rate: float, duration: float, t: float) -> float:
    """Way on the quintic that takes over a rate, and has neither rate nor curvature at its end."""
    x = min(t / duration, 1.0)
    moved = rate * duration
    # rest + (1 - x)^3 (a + b x + c x^2), whose value and first two derivatives at 0 are known
    a, b, c = -change, moved - 3.0 * change, 3.0 * moved - 6.0 * change
    return change + (1.0 - x) ** 3 * (a + b * x + c * x * x)


def gap(run: Performance, behind: str, ahead: str, t: float) -> float:
    return run.rear(ahead, t) - run.front(behind, t)


def test_c14_a_gap_takes_the_time_it_is_given(perform: Perform) -> None:
    run = perform("C14_gap_in_time")
    assert run.status == "success"
    first, second = run.spans("follower change_space_gap")
    assert first.length == 8.0
    before = gap(run, "follower", "lead", 0.0)  # the lead goes away at 2 m/s at first
    for t in (2.0, 4.0, 6.0, 8.0):
        wanted = hermite(before, 20.0, 2.0, 8.0, t)
        assert gap(run, "follower", "lead", t) == pytest.approx(wanted, abs=0.01)
    # 10 m at equal speeds, 6 * 10 / T^2 = 2 m/s^2: half of what a car can.
    assert second.length == pytest.approx(math.sqrt(30.0), abs=0.06)
    assert gap(run, "follower", "lead", second.end) == pytest.approx(30.0, abs=0.02)


def test_c19_a_scenario_has_shapes_of_its_own(perform: Perform) -> None:
    run = perform("C19_own_shape")
    assert run.status == "success"
    for line in run.states("swelling"):
        x = line["t"] / 8.0
        assert line["v"] == pytest.approx(10.0 + 16.0 * x * (1.0 - x), abs=ROUNDED)
        if x >= 1.0:
            break
    assert run.span("swelling drive").length == 8.0
    # A fading push: v = v0 + 3 t - t^2 / 4 up to 6 s; the ramp has 2 m/s after one second.
    for line in run.states("starting"):
        t = min(line["t"], 6.0)
        assert line["v"] == pytest.approx(2.0 + 3.0 * t - 0.25 * t * t, abs=ROUNDED)
    # 8 s of the wave and 6 / 2 s of the ramp
    assert run.span("starting drive").length == 11.0
    # 4 h x (1 - x) = 3 m/s at a quarter of the time
    assert run.event("half_way") == pytest.approx(next_step(2.0))


def test_c21_shapes_say_where_a_car_is(perform: Perform) -> None:
    run = perform("C21_position_shape")
    assert run.status == "success"
    for t in (1.0, 3.0, 5.0, 8.0):
        way = run.at("stopping", t)["s"] - run.at("stopping", 0.0)["s"]
        assert way == pytest.approx(coming_to_rest(60.0, 12.0, 8.0, t), abs=1e-3)
        apart = run.at("lead", t)["s"] - run.at("closing", t)["s"]
        assert apart == pytest.approx(40.0 + coming_to_rest(-15.0, 2.0, 8.0, t), abs=1e-3)
        own = run.at("own", t)
        assert own["s"] == pytest.approx(10.0 * t + 4.0 * (t / 4.0) ** 2, abs=1e-4)
        assert own["v"] == pytest.approx(10.0 + 0.5 * t, abs=1e-4)
    assert run.last("stopping")["v"] == pytest.approx(0.0, abs=1e-4)


def test_c22_speeds_across_the_lane(perform: Perform) -> None:
    run = perform("C22_lateral_speeds")
    assert run.status == "success"
    rates = [line["v"] * math.sin(line["h"]) for line in run.states("drifting")]
    assert rates[40:] == pytest.approx([0.6] * 41, abs=2e-5)
    ways = [run.at("drifting", t)["y"] - run.at("drifting", 0.0)["y"] for t in (2.0, 4.0)]
    # half of 2 s at the mean, then 2 s at 0.6 m/s
    assert ways == pytest.approx([0.6, 1.8], abs=0.6 * DT)
    for line in run.states("bulging"):
        x = line["t"] / 4.0
        assert line["offset"] == pytest.approx(3.2 * x * (1.0 - x), abs=1e-6)
    leaning = run.states("leaning")
    assert leaning[0]["v"] * math.sin(leaning[0]["h"]) == pytest.approx(0.5, abs=2e-5)
    assert leaning[-1]["h"] == 0.0


def test_c26_pitch_and_roll_of_roads_and_boxes(perform: Perform) -> None:
    run = perform("C26_pitch_and_roll")
    assert run.status == "success"
    # The slope of the file, 2 c d + 3 d^2 e from s = 80 m on; level before.
    level = [line for line in run.states("car") if line["s"] < 80.0]
    assert level
    assert all("pitch" not in line and line["z"] == 0.0 for line in level)
    hill = [line for line in run.states("car") if 80.5 < line["s"] < 100.0]
    assert hill
    for line in hill:
        d = line["s"] - 80.0
        slope = 2.0 * 0.0003719008 * d - 3.0 * 0.000001127 * d * d
        assert math.tan(-line["pitch"]) == pytest.approx(slope, rel=0.02)
    assert run.event("up_hill") > 0.0
    banked = [line for line in run.states("car") if 150.0 < line["s"] < 190.0]
    assert banked
    assert {round(line["roll"], 3) for line in banked} == {-0.05}
    # The box: 20 and 90 degrees at once, then 180 degrees at half a turn per second.
    turned = run.span("box assign_orientation").end
    state = run.at("box", turned)
    assert (state["h"], state["roll"]) == pytest.approx(
        (math.radians(20.0), math.radians(90.0)), abs=ROUNDED
    )
    rolling = run.spans("box move")[1]
    assert rolling.length == pytest.approx(0.5)
    assert abs(run.last("box")["roll"]) == pytest.approx(math.pi, abs=ROUNDED)
    assert run.at("sign", 0.0)["roll"] == pytest.approx(math.radians(10.0), abs=ROUNDED)

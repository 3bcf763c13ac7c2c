"""C05 to C08: moving, speed, acceleration, standing."""

import math

import pytest

from tests.capabilities.kit import (
    DT,
    ROUNDED,
    Perform,
    Trapezoid,
    cosine,
    cosine_duration,
    next_step,
)


def test_c05_vehicles_drive_things_move_persons_walk(perform: Perform) -> None:
    run = perform("C05_move_drive_walk")
    assert run.status == "success"
    # In lane 2 of 4 from the right: 8.75 m right of the middle.
    car = [(line["x"], line["y"]) for line in run.states("car")]
    assert car[-1] == pytest.approx((50.0 + 20.0 * 10.0, -8.75), abs=ROUNDED)
    # Straight along their headings: `speed` without `at` holds from the start on.
    for actor, v, heading, start in (
        ("ball", 3.0, math.radians(-90), (60.0, -30.0)),
        ("walker", 1.4, math.radians(180), (40.0, -30.0)),
    ):
        last = run.last(actor)
        assert last["v"] == v
        assert last["h"] == pytest.approx(heading, abs=ROUNDED)
        end = (start[0] + math.cos(heading) * v * 10.0, start[1] + math.sin(heading) * v * 10.0)
        assert (last["x"], last["y"]) == pytest.approx(end, abs=ROUNDED)


def test_c06_three_rate_profiles(perform: Perform) -> None:
    run = perform("C06_speed_control")
    assert run.status == "success"
    smooth = cosine_duration(10.0, 2.5)
    hasty = Trapezoid(10.0, acceleration=4.0, jerk=10.0).duration  # a car: 4 m/s^2, 10 m/s^3
    for actor, duration, peak in (
        ("even", 10.0 / 2.5, 2.5),
        ("gentle", smooth, 2.5),
        ("hasty", hasty, 4.0),
    ):
        assert run.span(f"{actor} change_speed").end == next_step(duration)
        states = run.states(actor)
        assert states[-1]["v"] == 20.0
        # `a` is a mean over a step, so a peak within it shows lower by less than 0.1 %.
        assert max(line["a"] for line in states) == pytest.approx(peak, rel=1e-3)
        # All three courses are symmetric: the way is that of the mean speed.
        way = 15.0 * duration + 20.0 * (states[-1]["t"] - duration)
        assert states[-1]["s"] - states[0]["s"] == pytest.approx(way, abs=5e-3)
    for line in run.states("gentle"):
        assert line["v"] == pytest.approx(cosine(10, 20, smooth, line["t"]), abs=ROUNDED)


def test_c07_acceleration_is_reached_held_and_assigned(perform: Perform) -> None:
    run = perform("C07_acceleration_control")
    assert run.status == "success"
    assert run.span("ego change_acceleration").length == 1.5  # 1.5 m/s^2 at 1 m/s^3
    hold, brake = run.spans("ego keep_acceleration")
    assert (hold.length, brake.length) == (2.0, 3.0)

    held = 1.5  # what is reached, not the mean over the last step of the way there

    def speed(t: float) -> float:
        ramp = 10.0 + 0.5 * min(t, 1.5) ** 2
        return ramp + held * min(max(t - 1.5, 0.0), 2.0) - 2.0 * max(t - 3.5, 0.0)

    for line in run.states("ego"):
        assert line["v"] == pytest.approx(speed(line["t"]), abs=ROUNDED)
        if hold.start < line["t"] < hold.end:
            assert line["a"] == pytest.approx(held, abs=2 * ROUNDED / DT)
        if line["t"] >= hold.end:
            assert line["a"] == pytest.approx(-2.0, abs=2 * ROUNDED / DT)


def test_c08_standing_and_stopping_to_stand(perform: Perform) -> None:
    run = perform("C08_stationary")
    assert run.status == "success"
    assert {(line["x"], line["y"], line["v"]) for line in run.states("parked")} == {
        (100.0, -12.25, 0.0)
    }
    # 16 m/s by the brakes of a car (8 m/s^2, 10 m/s^3); the way is that of the mean speed.
    stop = Trapezoid(16.0, acceleration=8.0, jerk=10.0).duration
    hold = run.span("arriving remain_stationary")
    assert hold.length == 6.0
    moving = [line for line in run.during("arriving", hold) if line["v"] > 0.0]
    assert moving[-1]["t"] < hold.start + stop <= moving[-1]["t"] + DT + 1e-9
    places = {line["x"] for line in run.during("arriving", hold) if line["v"] == 0.0}
    (place,) = places
    # The step that holds the end of braking counts with the mean of its ends: 5 mm at most.
    assert place == pytest.approx(50.0 + 16.0 * 2.0 + 8.0 * stop, abs=5e-3)


def test_c05_a_trailer_comes_along_as_long_as_it_is_coupled(perform: Perform) -> None:
    run = perform("C05_trailer")
    assert run.status == "success"
    couple, uncouple = run.span("truck connect_trailer"), run.span("truck disconnect_trailer")

    def behind(t: float) -> float:
        return float(run.at("truck", t)["x"] - run.at("load", t)["x"])

    assert {line["v"] for line in run.states("load") if line["t"] <= couple.end} == {0.0}
    coupled = [
        line["t"] for line in run.states("load") if couple.end <= line["t"] <= uncouple.start
    ]
    # A rigid bar on a straight road: the distance stays, and so the speeds are equal.
    assert [behind(t) for t in coupled] == pytest.approx(
        [behind(couple.end)] * len(coupled), abs=0.01
    )
    assert run.at("load", uncouple.start)["v"] == pytest.approx(10.0, abs=1e-3)
    # The truck gains 10 m/s smoothly, with 90 % of half of the 1.5 m/s^2 of a truck.
    pull = run.span("truck change_speed")
    assert pull.length == next_step(cosine_duration(10.0, 0.75 * 0.9))
    assert behind(run.last("truck")["t"]) > behind(uncouple.end) + 1.0


def test_c05_a_caravan_is_drawn_by_its_hitch(perform: Perform) -> None:
    run = perform("C05_towing")
    assert run.status == "success"
    assert max(line["h"] for line in run.states("car")) > 0.5  # there is a bend
    # The hitch is at the rear end of the car, the coupler on a drawbar of 0.5 m before the caravan.
    behind_axle = run.box("car")["rear"]
    before_axle = run.box("caravan")["length"] - run.box("caravan")["rear"] + 0.5
    for car, caravan in zip(run.states("car"), run.states("caravan"), strict=True):
        x = car["x"] - behind_axle * math.cos(car["h"]) - caravan["x"]
        y = car["y"] - behind_axle * math.sin(car["h"]) - caravan["y"]
        assert math.hypot(x, y) == pytest.approx(before_axle, abs=0.01)
        assert math.atan2(y, x) == pytest.approx(caravan["h"], abs=0.01)

"""C16 to C18: weather, signals, the state of the road."""

import math

import pytest

from tests.capabilities.kit import DT, ROUNDED, G, Perform, Trapezoid, next_step

PER_HOUR = 1e-3 / 3600.0  # m/s in a millimetre per hour


def test_c16_weather_changes_by_what_is_said(perform: Perform) -> None:
    run = perform("C16_weather")
    assert run.status == "success"
    weather: dict[str, float] = {}
    by_time = {}
    for line in run.of_kind("environment"):
        values = {name: value for name, value in line.items() if name not in ("t", "kind")}
        weather |= values
        by_time[line["t"]] = values, dict(weather)
    assert list(by_time) == [0.0, 2.0, 4.0]
    # Values are given in other units than those of the trace: nine digits of it are left.
    assert by_time[0.0][0] == pytest.approx(
        {
            "temperature": 273.15 + 12.0,
            "pressure": 101_000.0,
            "relative_humidity": 0.9,
            "cloudiness": 7,
        },
        rel=1e-8,
    )
    assert by_time[2.0][0] == pytest.approx(
        {
            "rain_intensity": 5.0 * PER_HOUR,
            "wind_speed": 10.0,
            "wind_direction": 1.5 * math.pi,
        },
        rel=1e-8,
    )
    assert by_time[4.0][0] == pytest.approx(
        {"rain_intensity": 0.0, "snow_intensity": 1.0 * PER_HOUR, "visual_range": 150.0}, rel=1e-8
    )


def test_c17_a_car_stops_at_a_red_light_and_goes_when_it_is_green(perform: Perform) -> None:
    run = perform("C17_traffic_signals")
    assert run.status == "success"
    signals = [(line["t"], line["signal"], line["state"]) for line in run.of_kind("signal")]
    # Controller 2 of the map has the lights 102 and 104.
    assert signals == [
        (0.0, "101", "stop"),
        (0.0, "102", "go"),
        (0.0, "104", "go"),
        (14.0, "101", "go"),
        (14.0, "102", "stop"),
        (14.0, "104", "stop"),
    ]
    states = run.states("ego")
    standing = [line for line in states if line["v"] == 0.0]
    assert {line["road"] for line in standing} == {"1"}
    # The light stands at s = 149 m; the front comes to a stand one metre before it.
    assert run.front("ego", standing[0]["t"]) == pytest.approx(149.0 - 1.0, abs=0.01)
    # With half of the 8 m/s^2 of a car, so 12 m/s take 18 m; a step of 0.6 m more at most.
    braking = [line for line in states if line["t"] < 14.0 and 0.0 < line["v"] < 12.0]
    begin = run.front("ego", braking[0]["t"] - DT)
    assert 0.0 <= 148.0 - 12.0**2 / (2 * 4.0) - begin <= 0.6 + ROUNDED
    assert min(line["a"] for line in braking) == pytest.approx(-4.0, rel=0.05)
    # Until it is green it stands, then it is through.
    assert 14.0 <= standing[-1]["t"] <= 14.0 + DT  # seen at one step, driven by the next
    assert run.last("ego")["road"] != "1"


def test_c18_snow_takes_the_grip(perform: Perform) -> None:
    run = perform("C18_road_conditions")
    assert run.status == "success"
    dry, _, slippery = run.spans("ego change_speed")
    # A car brakes with 8 m/s^2; packed snow has a coefficient of friction of 0.2.
    on_snow = 0.2 * G
    for span, most in ((dry, 8.0), (slippery, on_snow)):
        assert span.length == next_step(Trapezoid(15.0, most, jerk=10.0).duration)
        hardest = min(line["a"] for line in run.during("ego", span)[1:])
        assert hardest == pytest.approx(-most, rel=2e-3)
    assert slippery.length / dry.length > 2.8


def test_c17_lamps_boxes_and_groups(perform: Perform) -> None:
    run = perform("C17_signal_lamps")
    assert run.status == "success"
    on, off = "is_on", "is_off"
    shown = [(e["t"], e["signal"], e["bulbs"], e["state"]) for e in run.of_kind("signal")]
    # red, yellow, green from top to bottom; red with yellow announces green
    assert shown == [
        (0.0, "101", [on, off, off], "stop"),
        (1.0, "101", [on, on, off], "attention"),
        (2.0, "101", [off, off, on], "go"),
        (2.0, "103", [off, off, on], "go"),
    ]


def test_c17_cycles_run_by_themselves(perform: Perform) -> None:
    run = perform("C17_signal_cycles")
    assert run.status == "success"
    assert run.span("lights play_cycles").length == 12.0
    for signal in ("101", "103"):  # both boxes of the group
        changes = [(e["t"], e["state"]) for e in run.of_kind("signal") if e["signal"] == signal]
        # 3 s of green and 5 s of red, again and again
        assert changes == [(0.0, "go"), (3.0, "stop"), (8.0, "go"), (11.0, "stop")]


def test_c17_what_lights_show_triggers(perform: Perform) -> None:
    run = perform("C17_signal_conditions")
    assert run.status == "success"
    # Set at 2 s and 3 s, seen at the step after
    assert run.event("green") == 2.0 + DT
    assert run.event("all_red") == 3.0 + DT
    assert run.result["steps"] == round((3.0 + DT + 1.0) / DT)

"""Who drives with care stops at lights: closed forms, and who does not stop."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Environment,
    Map,
    Parallel,
    Scenario,
    Serial,
    TrafficLight,
    TrafficLightController,
    Vehicle,
    Wait,
    elapsed,
)
from osc2tx_runtime.modifiers import avoid_collisions, lane, position, speed

LINE = 149.0  # m: s of all lights of the map, on roads of 150 m
FRONT = 4.6 - 0.92  # m from the rear axle of a car to its front
COMFORT = 4.0  # m/s^2: half of what a car can do
SPEED = 14.0  # m/s


def drive(
    meaning: str,
    *,
    after: float = 0.0,
    careful: bool = True,
    start: float = 20.0,
    signal: str = "101",
    snow: bool = False,
    road: str = "1",
) -> type[Scenario]:
    """A car that drives towards light 101, which says something from a time on."""

    class Drive(Scenario):
        name = "drive"
        source = "drive.osc"

        def declare(self) -> None:
            self.map = Map(map_file="urban_crossing")
            self.sky = Environment()
            self.boss = TrafficLightController()
            self.light = TrafficLight(map_id=signal)
            self.car = Vehicle()

        def placement(self) -> None:
            self.place(self.car, lane(1), position(distance=start), speed(SPEED))

        def behavior(self) -> Behaviour:
            return Parallel(
                "all",
                self.car.drive(avoid_collisions(careful), speed(SPEED), duration=20.0),
                Serial(
                    "lights",
                    self.sky.snow(intensity=1e-6 if snow else 0.0),
                    Wait(elapsed(after)),
                    self.boss.set_semantic_state(traffic_light=self.light, state=meaning),
                ),
            )

    return Drive


def place_of_stand(done: Any) -> float | None:
    """Where (m) it has come to a stand; None if it has not."""
    return next((e["s"] for e in done.states("car") if e["v"] == 0.0), None)


@pytest.mark.parametrize("dt", [0.01, 0.05])
@pytest.mark.parametrize("meaning", ["stop", "attention", "stop_attention"])
def test_it_stands_a_metre_before_the_line(
    run: Callable[..., Any], meaning: str, dt: float
) -> None:
    done = run(drive(meaning), dt=dt)
    assert place_of_stand(done) == pytest.approx(LINE - 1.0 - FRONT, abs=0.005)
    assert min(e["a"] for e in done.states("car")) >= -COMFORT
    # It brakes over v^2 / (2 b), a step more or less.
    begin = next(e["s"] for e in done.states("car") if e["a"] < 0.0)
    way = SPEED**2 / (2 * COMFORT)
    assert LINE - 1.0 - FRONT - begin == pytest.approx(way, abs=2 * SPEED * dt)


@pytest.mark.parametrize("meaning", ["go", "go_exclusive", "caution", "off", "non_functional"])
def test_it_passes_lights_that_do_not_ask_to_stop(run: Callable[..., Any], meaning: str) -> None:
    assert {e["v"] for e in run(drive(meaning)).states("car")} == {SPEED}


def test_who_does_not_drive_with_care_passes(run: Callable[..., Any]) -> None:
    assert {e["v"] for e in run(drive("stop", careful=False)).states("car")} == {SPEED}


@pytest.mark.parametrize("signal", ["102", "103"])
def test_lights_of_other_roads_are_not_for_it(run: Callable[..., Any], signal: str) -> None:
    """103 stands across the crossing, for those who come from there."""
    assert {e["v"] for e in run(drive("stop", signal=signal)).states("car")} == {SPEED}


# From s = 20 m the front is at 23.68 m; it needs 24.5 m for comfort, 12.25 m with all force, and
# what it drives until the switch takes effect: two steps of 0.7 m at most.
def at(free: float) -> float:
    """Time (s) at which the front is so far (m) from the line."""
    return (LINE - 20.0 - FRONT - free) / SPEED


@pytest.mark.parametrize(
    ("meaning", "free", "stops"),
    [
        ("stop_attention", 27.0, True),
        ("stop_attention", 24.0, False),  # could only stop with force
        ("stop", 24.0, True),
        ("stop", 14.0, True),
        ("stop", 11.0, False),  # cannot stop before the line any more
    ],
)
def test_who_sees_it_late(run: Callable[..., Any], meaning: str, free: float, stops: bool) -> None:
    done = run(drive(meaning, after=at(free)))
    stand = place_of_stand(done)
    assert (stand is not None) == stops
    if stand is not None:
        assert LINE - 1.0 - FRONT - 0.005 <= stand < LINE - FRONT
        assert min(e["a"] for e in done.states("car")) >= -8.0 - 1e-9


def test_it_brakes_earlier_on_snow(run: Callable[..., Any]) -> None:
    """Half of what it can do is more than snow holds: all of 0.2 g, and half of what is left."""
    done = run(drive("stop", snow=True, start=10.0))
    assert place_of_stand(done) == pytest.approx(LINE - 1.0 - FRONT, abs=0.005)
    assert -0.2 * 9.80665 <= min(e["a"] for e in done.states("car")) < -0.5


def test_it_goes_on_from_a_stand(run: Callable[..., Any]) -> None:
    class Wait5(drive("stop")):  # type: ignore[misc]
        def behavior(self) -> Behaviour:
            go = self.boss.set_semantic_state(traffic_light=self.light, state="go")
            return Parallel("all", super().behavior(), Serial("go", Wait(elapsed(15.0)), go))

    done = run(Wait5)
    assert done.at("car", 15.0)["v"] == 0.0
    assert done.at("car", 15.05)["a"] == pytest.approx(2.0)  # half of 4 m/s^2
    assert done.at("car", 18.0)["v"] == pytest.approx(6.0)

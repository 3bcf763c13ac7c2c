"""The friction circle: what roads hold in rain and snow, and automatic lights (DSL 8.11)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Environment, Map, Scenario, Serial, Vehicle, Wait, elapsed
from osc2tx_runtime.modifiers import acceleration, lane, position, speed
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.commands import Accelerate, LaneChange, SpeedChange
from osc2tx_runtime.world.grip.friction import ADHESION, GRAVITY, road_condition

WEATHER: dict[str, dict[str, float]] = {
    "wet": {"rain_intensity": 1e-6},
    "snow": {"snow_intensity": 1e-6},
    "ice": {"rain_intensity": 1e-6, "temperature": 270.0},
}


@pytest.mark.parametrize("condition", WEATHER)
def test_braking_distance(car_world: Callable[..., EmbeddedWorld], condition: str) -> None:
    """v^2 / (2 mu g), a fraction of a step at the end aside."""
    world = car_world(dt=0.01, speed=15.0)
    world.set_environment(WEATHER[condition])
    world.command("a", "longitudinal", Accelerate(-8.0))
    begin = world.state("a").x
    while world.state("a").v > 0.0:
        world.step()
    limit = ADHESION[condition] * GRAVITY  # type: ignore[index]
    assert world.state("a").x - begin == pytest.approx(15.0**2 / (2 * limit), abs=0.01)


def test_gaining_speed_is_limited_too(car_world: Callable[..., EmbeddedWorld]) -> None:
    """Wheels that spin gain no more speed; the action is done when the speed is reached."""
    world = car_world(speed=10.0)
    world.set_environment(WEATHER["ice"])
    world.command("a", "longitudinal", SpeedChange(14.0, "constant", 4.0))
    steps = 0
    while not world.progress("a", "longitudinal").done:
        assert world.state("a").v < 14.0
        world.step()
        steps += 1
    assert steps * 0.05 == pytest.approx(4.0 / (0.1 * GRAVITY), abs=0.051)


def test_a_change_of_the_weather_acts_at_once(car_world: Callable[..., EmbeddedWorld]) -> None:
    world = car_world(speed=20.0)
    world.command("a", "longitudinal", Accelerate(-8.0))
    rates = []
    for step in range(30):
        if step == 10:
            world.set_environment(WEATHER["wet"])
        if step == 20:
            world.set_environment({"rain_intensity": 0.0})
        world.step()
        rates.append(world.state("a").a)
    assert rates[:10] == [pytest.approx(-8.0)] * 10
    assert rates[10:20] == [pytest.approx(-0.6 * GRAVITY)] * 10
    # The speed that is wanted has run ahead; tyres on a dry road take no more than they can.
    assert all(rate < -8.0 + 1e-9 for rate in rates[20:22])


def test_those_without_wheels_are_not_limited(
    highway: RoadMap, make_spec: Callable[..., Any]
) -> None:
    world = EmbeddedWorld(highway)
    world.add(make_spec("walker", kind="person"))
    world.place("walker", LanePosition("1", -2, 100.0), 3.0)
    world.set_environment(WEATHER["ice"])
    world.command("walker", "longitudinal", Accelerate(-3.0))
    world.step()
    assert world.state("walker").a == pytest.approx(-3.0)


def test_curves_take_their_share(
    load_map: Callable[[str], RoadMap], make_spec: Callable[..., Any]
) -> None:
    """Along the way is left what the circle leaves beside v^2 / r."""
    world = EmbeddedWorld(load_map("urban_crossing"))
    world.add(make_spec("a"))
    world.place("a", LanePosition("12", -1, 5.0), 5.5)  # turns left
    world.set_environment(WEATHER["snow"])
    world.command("a", "longitudinal", Accelerate(-8.0))
    pose, ahead = (world.map.pose(LanePosition("12", -1, s)) for s in (5.0, 6.0))
    radius = math.hypot(ahead.x - pose.x, ahead.y - pose.y) / abs(ahead.h - pose.h)
    across, held = 5.5**2 / radius, 0.2 * GRAVITY
    assert 1.0 < across < held
    world.step()
    assert world.state("a").a == pytest.approx(-math.sqrt(held**2 - across**2), abs=0.02)


def test_too_fast_for_a_curve_is_a_failure(
    load_map: Callable[[str], RoadMap], make_spec: Callable[..., Any]
) -> None:
    world = EmbeddedWorld(load_map("urban_crossing"))
    world.add(make_spec("a"))
    world.place("a", LanePosition("12", -1, 5.0), 10.0)
    world.set_environment(WEATHER["snow"])
    world.command("a", "longitudinal", SpeedChange(11.0))
    world.step()
    failed = world.progress("a", "longitudinal").failed
    assert failed is not None and "it slides" in failed and "1.96 m/s^2" in failed


def test_lane_changes_are_gentler_on_ice(car_world: Callable[..., EmbeddedWorld]) -> None:
    """Half a cosine over 3.5 m with the lateral peak pi^2 / 2 D / T^2 = mu g."""

    def time(weather: dict[str, float]) -> float:
        world = car_world(speed=20.0)
        world.set_environment(weather)
        world.command("a", "lateral", LaneChange(1))
        steps = 0
        while not world.progress("a", "lateral").done:
            world.step()
            steps += 1
        return steps * 0.05

    width = 3.5
    expected = math.sqrt(0.5 * math.pi**2 * width / (0.1 * GRAVITY))
    assert time(WEATHER["ice"]) == pytest.approx(expected, abs=0.2)
    assert time(WEATHER["ice"]) > time({}) + 0.5


@pytest.mark.parametrize(
    ("values", "condition"),
    [
        ({}, "dry"),
        ({"temperature": 260.0}, "dry"),
        ({"rain_intensity": 1e-7, "temperature": 280.0}, "wet"),
        ({"rain_intensity": 1e-7, "temperature": 270.0}, "ice"),
        ({"rain_intensity": 1e-7, "snow_intensity": 1e-7}, "snow"),
        ({"rain_intensity": 0.0}, "dry"),
    ],
)
def test_condition_of_the_road(values: dict[str, float], condition: str) -> None:
    assert road_condition(values) == condition


def rainy(body: Callable[[Any], Behaviour]) -> type[Scenario]:
    class Rainy(Scenario):
        name = "rainy"
        source = "rainy.osc"

        def declare(self) -> None:
            self.road = Map(map_file="highway")
            self.sky = Environment()
            self.a = Vehicle()

        def placement(self) -> None:
            self.place(self.a, lane(2), position(distance=50.0), speed(20.0))

        def behavior(self) -> Behaviour:
            rain = self.sky.rain(intensity=1e-6)
            return Serial("all", rain, Wait(elapsed(0.5)), body(self))

    return Rainy


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        (
            lambda s: s.a.change_speed(target=0.0, rate_profile="constant", rate_peak=7.0),
            "rate_peak 7 m/s^2 is not between 0 and 5.884 m/s^2 on a wet road",
        ),
        (
            lambda s: s.a.change_acceleration(target=-7.0),
            "an acceleration of -7.00 m/s^2 exceeds its limit of 5.884 m/s^2 on a wet road",
        ),
        (
            lambda s: s.a.drive(acceleration(-7.0), duration=1.0),
            "an acceleration of -7.00 m/s^2 exceeds its limit of 5.884 m/s^2 on a wet road",
        ),
    ],
)
def test_targets_beyond_friction_fail(
    run: Callable[..., Any], body: Callable[[Any], Behaviour], reason: str
) -> None:
    done = run(rainy(body))
    assert done.result.status == "failure"
    (failed,) = [e for e in done.lines if e.get("status") == "fail" and "reason" in e]
    assert failed["reason"] == reason


def test_automatic_lights_follow_fog_and_darkness(
    car_world: Callable[..., EmbeddedWorld],
) -> None:
    world = car_world()
    world.set_lights("a", "auto")

    def lit_after(values: dict[str, float]) -> str:
        world.set_environment(values)
        world.step()
        return world.lights("a").lit

    assert lit_after({}) == "off"
    assert lit_after({"visual_range": 99.0}) == "low_beam"
    assert lit_after({"visual_range": 100.0}) == "off"
    assert lit_after({"sun_elevation": math.radians(14.9)}) == "low_beam"
    assert lit_after({"visual_range": 50.0}) == "low_beam"
    assert lit_after({"sun_elevation": math.radians(15.0)}) == "low_beam"  # there still is fog
    assert lit_after({"visual_range": 1000.0}) == "off"


def test_fog_hides_what_is_ahead(highway: RoadMap, make_spec: Callable[..., Any]) -> None:
    """Who sees 30 m far notices a standing car only there."""
    world = EmbeddedWorld(highway)
    for name, s in (("a", 100.0), ("b", 160.0)):
        world.add(make_spec(name))
        world.place(name, LanePosition("1", -2, s), 0.0)
    assert world.obstacle(world.state("a")) is not None
    world.set_environment({"visual_range": 50.0})
    world.step()
    assert world.obstacle(world.state("a")) is None
    world.set_environment({"visual_range": 60.0})
    world.step()
    assert world.obstacle(world.state("a")) is not None


def test_the_weather_can_be_read_at_once(run: Callable[..., Any]) -> None:
    """What nobody has set is not known: no comparison with it holds."""

    class Late(rainy(lambda s: Wait(elapsed(0.0)))):  # type: ignore[misc]
        def behavior(self) -> Behaviour:
            rain = self.sky.rain(intensity=1e-6)
            sky = self.sky
            return Serial(
                "all",
                rain,
                Wait(lambda: sky.weather.rain.intensity == 1e-6),
                sky.assign_celestial_position(elevation=0.1),
                sky.air(temperature=280.0),
                sky.wind(speed=3.0, direction=1.0),
                Wait(lambda: sky.sun.position.elevation < 0.2),
                Wait(lambda: not sky.moon.position.elevation < 9.0),
                Wait(lambda: sky.weather.air.temperature == 280.0),
                Wait(lambda: sky.weather.wind.speed * sky.weather.wind.direction == 3.0),
                Wait(lambda: not sky.weather.clouds.cloudiness >= 0.0),
                Wait(lambda: sky.weather.fog.visual_range > 1e9),
            )

    assert run(Late).result.time == 0.0

"""The friction circle on every road: what no tyre can transmit is reported, in all worlds alike."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Map, RunSettings, Serial, Vehicle, run_scenario
from osc2tx_runtime.modifiers import lane, physical_movement, position, speed
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.running.main import verdict
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.actor_dimensions import limits_of
from osc2tx_runtime.world.commands import LaneChange, SpeedChange
from osc2tx_runtime.world.grip.friction import ADHESION, DRY_ADHESION, GRAVITY
from osc2tx_runtime.world.plant.plant import Plant
from osc2tx_runtime.world.protocol import LONGITUDINAL
from tests.runtime.opendrive.small_maps import map_text, one_road, road_text, shape
from tests.runtime.world.following_plant import FollowingPlant
from tests.runtime.world.two_cars import TwoCars, scenario

DT = 0.05
RADIUS = 20.0
LANE = RADIUS + 1.5  # m from the centre of the circle to the middle of lane -1
DRY = DRY_ADHESION * GRAVITY


@pytest.fixture(scope="module")
def circle() -> RoadMap:
    return one_road(f'arc curvature="{1.0 / RADIUS}"', 120.0)


def driven(road_map: RoadMap, spec: Any, speed: float, plant: Plant | None = None) -> EmbeddedWorld:
    world = EmbeddedWorld(road_map, DT, plant)
    world.add(spec("a"))
    world.place("a", LanePosition("1", -1, 1.0), speed)
    world.begin()
    world.command("a", LONGITUDINAL, SpeedChange(speed))  # a speed of its own a driver lowers
    return world


def steps(world: EmbeddedWorld, seconds: float) -> None:
    for _ in range(round(seconds / DT)):
        world.step()


@pytest.mark.parametrize("plant", [None, FollowingPlant()])
@pytest.mark.parametrize("factor", [0.98, 1.05])
def test_a_curve_is_too_sharp_from_a_speed_on(
    circle: RoadMap, make_spec: Callable[..., Any], factor: float, plant: Plant | None
) -> None:
    """v^2 / r; the same for a car that somebody measures, whatever it does there."""
    v = factor * math.sqrt(DRY * LANE)
    world = driven(circle, make_spec, v, plant)
    steps(world, 2.0)
    if factor < 1.0:
        assert not world.overloads()
        return
    (found,) = world.overloads()
    assert (found.actor, found.speed, found.limit) == ("a", v, DRY)
    assert found.across == pytest.approx(v * v / LANE, rel=0.01)
    assert (found.place.road, found.place.lane) == ("1", -1)
    assert 0.0 < found.time < 0.6
    assert found.end == pytest.approx(2.0)


def test_braking_in_a_curve_counts_with_it(circle: RoadMap, make_spec: Callable[..., Any]) -> None:
    """Each of them alone is possible."""
    v = math.sqrt(0.8 * DRY * LANE)
    world = driven(circle, make_spec, v)
    steps(world, 1.0)
    assert not world.overloads()
    world.command("a", LONGITUDINAL, SpeedChange(0.0, "constant", 0.75 * DRY))
    steps(world, 0.3)
    (found,) = world.overloads()
    assert found.along == pytest.approx(-0.75 * DRY)
    assert math.hypot(found.along, found.across) > DRY


def test_a_wet_road_holds_less(circle: RoadMap, make_spec: Callable[..., Any]) -> None:
    v = math.sqrt(0.8 * DRY * LANE)
    world = driven(circle, make_spec, v)
    world.set_environment({"rain_intensity": 1e-6})
    steps(world, 1.0)
    (found,) = world.overloads()
    assert found.limit == ADHESION["wet"] * GRAVITY
    assert "on the wet road" in str(found)


def test_those_on_foot_have_no_tyres(circle: RoadMap, make_spec: Callable[..., Any]) -> None:
    world = EmbeddedWorld(circle, DT)
    world.add(make_spec("a", "person"))
    world.place("a", LanePosition("1", -1, 1.0), 20.0)
    steps(world, 1.0)
    assert not world.overloads()


# --- runs -----------------------------------------------------------------------------------------


def brake(s: TwoCars) -> Behaviour:
    """11 m/s^2 are within what a scenario may ask for, and more than the road holds."""
    return s.a.change_speed(target=1.0, rate_profile="constant", rate_peak=11.0)


def test_by_default_the_run_goes_on_with_a_warning() -> None:
    done = run_scenario(scenario(brake), RunSettings())
    assert done.status == "success"
    (warning,) = done.warnings
    limit = "exceeds the grip limit of 8.8 m/s^2 on the dry road, at "
    assert warning.startswith(f"a: acceleration 11.0 m/s^2 (lateral 0.0 m/s^2) {limit}")
    assert " m/s (road 1, lane -3, s " in warning
    assert list(verdict("brake", done)) == [
        f"brake: success after {done.time:.2f} s",
        f"  warning: {warning}",
    ]
    assert json.loads(done.trace_lines[-1])["warnings"] == [warning]


def test_on_request_it_fails_there_and_then() -> None:
    """All lines before are the same."""
    warned = run_scenario(scenario(brake), RunSettings())
    failed = run_scenario(scenario(brake), RunSettings(physics="fail"))
    assert failed.status == "failure"
    assert failed.reason.startswith("a: acceleration 11.0 m/s^2")
    assert failed.steps == 1
    assert not failed.warnings
    assert "warnings" not in json.loads(failed.trace_lines[-1])
    states = [e for e in map(json.loads, failed.trace_lines) if e["kind"] == "state"]
    assert [e["t"] for e in states if e["actor"] == "a"] == [0.0, DT]
    same = sum(a == b for a, b in zip(failed.trace_lines, warned.trace_lines, strict=False))
    assert same >= 1 + 2 * 2


def jump(s: TwoCars) -> Behaviour:
    """Nobody drives who is put somewhere."""
    return Serial(
        "",
        s.a.change_speed(physical_movement("prefer_non_physical"), target=25.0),
        s.a.assign_speed(speed=3.0),
        s.b.drive(duration=1.0),
    )


def test_what_is_not_physical_is_left_out() -> None:
    assert not run_scenario(scenario(jump), RunSettings()).warnings


# --- what each vehicle can do, and what is asked of it --------------------------------------------


@pytest.mark.parametrize(("category", "most"), [("car", DRY), ("bus", 0.4 * GRAVITY)])
@pytest.mark.parametrize("factor", [0.97, 1.05])
def test_what_stands_high_tips_over_before_it_slides(
    circle: RoadMap, make_spec: Callable[..., Any], category: str, most: float, factor: float
) -> None:
    """A loaded bus tips over at 0.4 g; the radius that is named is the one that is driven."""
    v = factor * math.sqrt(most * LANE)
    world = EmbeddedWorld(circle, DT)
    world.add(replace(make_spec("a"), limits=limits_of("vehicle", category)))
    world.place("a", LanePosition("1", -1, 1.0), v)
    world.command("a", LONGITUDINAL, SpeedChange(v))
    steps(world, 2.0)
    assert bool(world.overloads()) == (factor > 1.0)
    for found in world.overloads():
        assert found.limit == most
        assert f"a radius of {v * v / found.across:.1f} m" in str(found)
        assert v * v / found.across == pytest.approx(LANE, rel=0.01)
        assert ("rollover limit" in str(found)) == (category == "bus")


def test_a_place_is_named_once(make_spec: Callable[..., Any]) -> None:
    """However often it comes by; what is worst is kept."""
    bend = one_road(f'arc curvature="{1.0 / RADIUS}"', 40.0)
    world = driven(bend, make_spec, 1.1 * math.sqrt(DRY * LANE))
    for _ in range(3):
        steps(world, 1.0)
        world.assign("a", at=LanePosition("1", -1, 1.0), speed=1.0)
        steps(world, 2.0)
        world.assign("a", at=LanePosition("1", -1, 1.0), speed=1.15 * math.sqrt(DRY * LANE))
    (found,) = world.overloads()
    assert found.again == 2
    assert "and 2 times more" in str(found)


SIDES = {"constant": 1, "smooth": 0, "none": 0, "asap": 0}


@pytest.mark.parametrize("profile", SIDES)
@pytest.mark.parametrize("dt", [0.05, 0.01])
def test_a_lateral_speed_at_once_is_named(
    highway: RoadMap, make_spec: Callable[..., Any], profile: Any, dt: float
) -> None:
    """At a constant rate a lane change has a corner at each end, whatever the step."""
    world = EmbeddedWorld(highway, dt)
    world.add(make_spec("a"))
    world.place("a", LanePosition("1", -2, 100.0), 20.0)
    world.command("a", "lateral", LaneChange(1, profile=profile, duration=3.5))
    for _ in range(round(5.0 / dt)):
        world.step()
    found = world.overloads()
    assert len(found) == SIDES[profile]
    for each in found:
        assert abs(each.across) == pytest.approx(1.0, abs=0.02)
        assert "lateral speed changes by 1.00 m/s within a step" in str(each)


class OnACircle(TwoCars):
    """Two cars on a sharp bend."""

    speeds = (20.0, 5.0)

    def declare(self) -> None:
        self.road = Map(map_file="circle")
        self.a, self.b = Vehicle(), Vehicle()

    def placement(self) -> None:
        self.place(self.a, lane(1), position(distance=2.0), speed(self.speeds[0]))
        self.place(self.b, lane(1), position(distance=60.0), speed(self.speeds[1]))


@pytest.fixture
def on_a_circle(tmp_path: Path) -> Callable[..., Any]:
    """Run a body on a road with a radius of 20 m."""
    text = road_text(shape(f'arc curvature="{1.0 / RADIUS}"', 120.0), 120.0)
    (tmp_path / "circle.xodr").write_text(map_text(text), encoding="utf-8")

    def run(body: Callable[[TwoCars], Behaviour]) -> Any:
        made = type("Made", (OnACircle,), {"behavior": lambda self: body(self)})
        return run_scenario(made, RunSettings(map_path=(tmp_path,)))

    return run


def test_who_must_be_physical_fails(on_a_circle: Callable[..., Any]) -> None:
    """With place, speed, radius and figure; others are only warned of."""

    def option(name: Any) -> Callable[[TwoCars], Behaviour]:
        return lambda s: s.a.follow_lane(speed(20.0), physical_movement(name), duration=2.0)

    failed = on_a_circle(option("must_be_physical"))
    assert failed.status == "failure"
    assert re.search(
        r"a: lateral acceleration \d+\.\d m/s\^2 exceeds the grip limit of 8\.8 m/s\^2 on the dry"
        r" road, at 20\.0 m/s and a radius of \d+\.\d m"
        r" \(road 1, lane -1, s \d+\.\d m; ",
        failed.reason,
    )
    warned = on_a_circle(option("prefer_physical"))
    assert warned.status == "success"
    assert [w for w in warned.warnings if "exceeds the grip limit" in w]
    free = on_a_circle(option("prefer_non_physical"))
    assert free.status == "success"
    assert not [w for w in free.warnings if "exceeds the grip limit" in w]

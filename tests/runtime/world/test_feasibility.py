"""The friction circle on every road: what no tyre can transmit is reported, in all worlds alike."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, RunSettings, Serial, run_scenario
from osc2tx_runtime.modifiers import physical_movement
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.running.main import verdict
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.commands import SpeedChange
from osc2tx_runtime.world.friction import ADHESION, DRY_ADHESION, GRAVITY
from osc2tx_runtime.world.plant import Plant
from osc2tx_runtime.world.protocol import LONGITUDINAL
from tests.runtime.opendrive.small_maps import one_road
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
    assert "that the wet road holds" in str(found)


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
    assert warning.startswith("a cannot be driven so: 11.0 m/s^2, 0.0 of them across its way, at ")
    assert "are more than the 8.8 m/s^2 that the dry road holds (road 1, lane -3, s " in warning
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
    assert failed.reason.startswith("a cannot be driven so")
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

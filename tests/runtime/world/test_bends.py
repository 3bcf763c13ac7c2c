"""Careful drivers slow down for bends: closed forms on arcs, and town maps."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime.opendrive import LanePosition, RoadMap, read_map
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.actor_dimensions import COMFORT, limits_of
from osc2tx_runtime.world.commands import Careful, KeepLane, SpeedChange
from osc2tx_runtime.world.grip.friction import ADHESION, GRAVITY
from tests.runtime.opendrive.small_maps import make_map, road_text, shape
from tests.runtime.world.motion_scan import Instant, scan

RADIUS = 30.0
LANE = RADIUS + 1.5
STRAIGHT = 200.0


@pytest.fixture(scope="module")
def bend() -> RoadMap:
    """200 m straight on, a quarter of a circle, 100 m straight on."""
    arc = 0.5 * math.pi * RADIUS
    pieces = (
        shape("line", STRAIGHT)
        + shape(f'arc curvature="{1.0 / RADIUS!r}"', arc, s=STRAIGHT, x=STRAIGHT)
        + shape("line", 100.0, s=STRAIGHT + arc, x=STRAIGHT + RADIUS, y=RADIUS, h=0.5 * math.pi)
    )
    return make_map(road_text(pieces, STRAIGHT + arc + 100.0))


def drive(
    road_map: RoadMap,
    spec: Any,
    speed: float,
    *,
    weather: dict[str, float] | None = None,
    dt: float = 0.05,
) -> tuple[EmbeddedWorld, list[Any]]:
    world = EmbeddedWorld(road_map, dt)
    world.add(spec)
    world.place("a", LanePosition("1", -1, 5.0), speed)
    world.set_environment(weather or {})
    world.command("a", "longitudinal", Careful(SpeedChange(speed)))
    states = [world.state("a")]
    while states[-1].lane_position and states[-1].lane_position.s < STRAIGHT + 130.0:
        world.step()
        states.append(world.state("a"))
        assert len(states) < 10_000
    return world, states


@pytest.mark.parametrize("category", ["car", "bus"])
@pytest.mark.parametrize("dt", [0.05, 0.01])
def test_a_bend_is_taken_comfortably(
    bend: RoadMap, make_spec: Callable[..., Any], category: str, dt: float
) -> None:
    """At sqrt(a r) with the comfortable a, braking for it with the comfortable rate."""
    limits = limits_of("vehicle", category)
    world, states = drive(bend, make_spec("a", category=category), 20.0, dt=dt)
    assert not world.overloads()
    inside = [s.v for s in states if STRAIGHT + 3.0 < s.lane_position.s < STRAIGHT + 40.0]
    assert max(inside) == pytest.approx(math.sqrt(limits.lateral * LANE), rel=0.03)
    assert min(inside) == pytest.approx(max(inside), rel=0.03)
    assert min(s.a for s in states) == pytest.approx(-COMFORT * limits.deceleration, rel=0.1)
    begin = next(s.lane_position.s for s in states if s.a < -0.5)
    way = (20.0**2 - limits.lateral * LANE) / (2.0 * COMFORT * limits.deceleration)
    assert begin == pytest.approx(STRAIGHT - way, abs=5.0)
    assert states[-1].v > max(inside) + 1.0  # behind it, it gains speed again


@pytest.mark.parametrize("condition", ["snow", "ice"])
def test_on_slippery_roads_it_is_slower(
    bend: RoadMap, make_spec: Callable[..., Any], condition: Any
) -> None:
    weather = {"snow_intensity": 1e-6}
    if condition == "ice":
        weather = {"rain_intensity": 1e-6, "temperature": 270.0}
    world, states = drive(bend, make_spec("a"), 12.0, weather=weather)
    assert not world.overloads()
    inside = [s.v for s in states if STRAIGHT + 5.0 < s.lane_position.s < STRAIGHT + 40.0]
    most = 0.8 * ADHESION[condition] * GRAVITY
    assert max(inside) == pytest.approx(math.sqrt(most * LANE), rel=0.05)


def told(world: EmbeddedWorld) -> None:
    world.command("a", "longitudinal", SpeedChange(15.0))


def assigned(world: EmbeddedWorld) -> None:
    world.assign("a", speed=15.0)


def replayed(world: EmbeddedWorld) -> None:
    world.command("a", "lateral", KeepLane(unphysical=True))


def ended(world: EmbeddedWorld) -> None:
    world.command("a", "longitudinal", SpeedChange(15.0))
    world.command("a", "longitudinal", None)


@pytest.mark.parametrize("do", [told, assigned, replayed, ended, None])
def test_nobody_brakes_for_a_bend_unasked(
    bend: RoadMap, make_spec: Callable[..., Any], do: Callable[[EmbeddedWorld], None] | None
) -> None:
    """The speed is held, with an action and without one."""
    world = EmbeddedWorld(bend)
    world.add(make_spec("a"))
    world.place("a", LanePosition("1", -1, 100.0), 15.0)
    if do is not None:
        do(world)
    for _ in range(200):
        world.step()
        assert world.state("a").v == 15.0


def test_straight_on_nothing_is_slowed_down(
    highway: RoadMap, make_spec: Callable[..., Any]
) -> None:
    world = EmbeddedWorld(highway)
    world.add(make_spec("a"))
    world.place("a", LanePosition("1", -2, 100.0), 30.0)
    world.command("a", "longitudinal", Careful(None))
    for _ in range(100):
        world.step()
        assert world.state("a").v == 30.0


@pytest.mark.slow
@pytest.mark.parametrize("town", ["carla-2020/Town01", "carla-2020/Town10HD", "carla-2019/Town03"])
def test_careful_drivers_in_towns_are_never_beyond_grip(
    test_data: Path, make_spec: Callable[..., Any], town: str
) -> None:
    """Twelve of them at once, each wants 15 m/s and starts slowly."""
    road_map = read_map(test_data / "maps" / f"{town}.xodr")
    world = EmbeddedWorld(road_map)
    points = road_map.spawn_points()
    names = [f"car{i}" for i in range(12)]
    for name, place in zip(names, points[:: len(points) // 12], strict=False):
        world.add(make_spec(name))
        world.place(name, place, 3.0)
    for name in names:
        world.command(name, "longitudinal", Careful(SpeedChange(15.0)))
    histories: dict[str, list[Instant]] = {name: [] for name in names}
    for k in range(800):
        for name in names:
            s = world.state(name)
            histories[name].append(Instant(k * world.dt, s.x, s.y, s.h, s.v))
        world.step()
    assert [str(each) for each in world.overloads()] == []
    worst = [scan(history) for history in histories.values()]
    assert max(each.across for each in worst) < 5.0
    assert max(each.course for each in worst) < math.radians(3.0)
    assert max(history[-1].v for history in histories.values()) > 5.0

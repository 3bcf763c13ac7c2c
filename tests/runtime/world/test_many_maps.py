"""Cars on all maps: no jumps, no course beside the heading, no grip beyond the law unreported."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime.opendrive import RoadMap, read_map
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.grip.friction import DRY_ADHESION, GRAVITY
from tests.runtime.world.motion_scan import Instant, Worst, scan

CARS = 40
SPEEDS = (6.0, 10.0, 14.0, 20.0, 25.0)  # m/s
LEAST_JUMP = 0.02  # m
JUMP = 0.02  # share of the way of a step
COURSE = math.radians(3.0)

SAMPLE = ("esmini/soderleden", "esmini/multi_intersections", "esmini/curves_elevation")


def crowded(road_map: RoadMap, make_spec: Callable[..., Any], dt: float) -> EmbeddedWorld:
    """Cars all over a map, each at a speed of its own, that nobody slows down."""
    world, points = EmbeddedWorld(road_map, dt), road_map.spawn_points()
    step = max(1, len(points) // CARS)
    for i, point in enumerate((points[::step] * CARS)[:CARS]):
        world.add(make_spec(f"car{i}"))
        world.place(f"car{i}", point, SPEEDS[i % len(SPEEDS)])
    world.begin()
    return world


def worst_of(world: EmbeddedWorld, seconds: float) -> dict[str, Worst]:
    histories: dict[str, list[Instant]] = {actor: [] for actor in world.actors()}
    for k in range(round(seconds / world.dt) + 1):
        for actor, history in histories.items():
            state = world.state(actor)
            history.append(Instant(k * world.dt, state.x, state.y, state.h, state.v))
        world.step()
    return {actor: scan(history) for actor, history in histories.items()}


def findings(world: EmbeddedWorld, seconds: float) -> list[str]:
    """What is impossible and not reported."""
    found, limit = [], 1.02 * DRY_ADHESION * GRAVITY
    for actor, worst in worst_of(world, seconds).items():
        reported = {each.actor for each in world.overloads()}
        way = SPEEDS[int(actor[3:]) % len(SPEEDS)] * world.dt
        if worst.jump > LEAST_JUMP + JUMP * way and not (
            actor in reported and worst.jump < 0.2 * way
        ):
            found.append(f"{actor} jumps by {worst.jump:.3f} m at {worst.at[0]:.2f} s")
        # Who slides on kinks of 26 degrees, one after the other, has none that is better.
        if worst.course > COURSE * (1.5 if actor in reported else 1.0):
            degrees = math.degrees(worst.course)
            found.append(f"{actor} is {degrees:.1f} degrees off its course at {worst.at[1]:.2f} s")
        if max(worst.across, worst.along) > limit and actor not in reported:
            found.append(f"{actor} has {worst.across:.1f}, {worst.along:.1f} m/s^2 at {worst.at}")
    return found


def _all_maps(test_data: Path) -> list[str]:
    folder = test_data / "maps"
    return sorted(f"{path.parent.name}/{path.stem}" for path in folder.glob("*/*.xodr"))


@pytest.mark.parametrize("name", SAMPLE)
def test_forty_cars_on_a_map(test_data: Path, make_spec: Callable[..., Any], name: str) -> None:
    road_map = read_map(test_data / "maps" / f"{name}.xodr")
    assert findings(crowded(road_map, make_spec, 0.05), 8.0) == []


@pytest.mark.slow
def test_forty_cars_on_every_map_for_a_minute(
    test_data: Path, make_spec: Callable[..., Any]
) -> None:
    names = _all_maps(test_data)
    assert len(names) >= 30
    found = {}
    for name in names:
        road_map = read_map(test_data / "maps" / f"{name}.xodr")
        found[name] = findings(crowded(road_map, make_spec, 0.05), 60.0)
    assert {name: lines for name, lines in found.items() if lines} == {}

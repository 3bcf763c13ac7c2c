"""Seams of maps do not enter the motion: who comes to one goes on, and back to its lane."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime.opendrive import LanePosition, RoadMap, read_map
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.commands import LaneChange
from osc2tx_runtime.world.state import ActorState
from tests.runtime.opendrive.test_what_maps_say import kinked
from tests.runtime.world.motion_scan import Instant, Worst, scan

STEP = math.radians(3.0)


def drive(world: EmbeddedWorld, seconds: float, actor: str = "a") -> tuple[Worst, list[ActorState]]:
    states = [world.state(actor)]
    for _ in range(round(seconds / world.dt)):
        world.step()
        states.append(world.state(actor))
    return scan([Instant(i * world.dt, s.x, s.y, s.h, s.v) for i, s in enumerate(states)]), states


def on(road_map: RoadMap, spec: Any, place: LanePosition, speed: float, dt: float) -> EmbeddedWorld:
    world = EmbeddedWorld(road_map, dt)
    world.add(spec("a"))
    world.place("a", place, speed)
    return world


SEAMS = [
    *((0.0, 0.2, 0.0), (0.0, -1.3, 0.0)),
    *((0.1, 0.0, 0.0), (-0.1, 0.0, 0.0)),
    *((0.0, 0.0, 3.0), (0.05, 0.3, -2.0), (0.0, 0.0, 1.5)),
]


@pytest.mark.parametrize("dt", [0.05, 0.01])
@pytest.mark.parametrize(("dx", "dy", "degrees"), SEAMS)
@pytest.mark.parametrize("backwards", [False, True])
def test_a_seam_is_driven_over_smoothly(
    make_spec: Callable[..., Any],
    dx: float,
    dy: float,
    degrees: float,
    dt: float,
    backwards: bool,
) -> None:
    """Within half a metre of the seam's own size, and back in the middle of the lane after it."""
    road_map = kinked(dx, dy, math.radians(degrees))
    road, s, v = ("2", 30.0, -10.0) if backwards else ("1", 70.0, 10.0)
    world = on(road_map, make_spec, LanePosition(road, -1, s), v, dt)
    worst, states = drive(world, 7.0)
    assert worst.jump < 0.02
    assert worst.course < STEP
    assert worst.across < 6.0
    assert worst.along < 1e-9
    assert max(abs(state.offset) for state in states) < 0.5 + abs(dy)
    assert states[-1].lane_position.road == ("1" if backwards else "2")
    assert states[-1].offset == pytest.approx(0.0, abs=1e-9)
    assert states[-1].h == pytest.approx(0.0 if backwards else math.radians(degrees), abs=1e-9)
    assert not world.overloads()


def test_the_course_over_a_seam_depends_neither_on_step_nor_speed(
    make_spec: Callable[..., Any],
) -> None:
    ends = []
    for dt in (0.1, 0.05, 0.01):
        world = on(kinked(0.0, 0.3, 0.03), make_spec, LanePosition("1", -1, 90.0), 10.0, dt)
        _, states = drive(world, 1.6)
        ends.append((states[-1].x, states[-1].y))
    for end in ends:
        assert end == pytest.approx(ends[-1], abs=0.02)


def test_who_stands_on_the_way_over_a_seam_does_not_move_sideways(
    make_spec: Callable[..., Any],
) -> None:
    world = on(kinked(0.0, 0.5, 0.0), make_spec, LanePosition("1", -1, 95.0), 10.0, 0.05)
    drive(world, 1.0)
    world.assign("a", speed=0.0)
    before = world.state("a")
    _, states = drive(world, 1.0)
    assert (states[-1].x, states[-1].y, states[-1].h) == (before.x, before.y, before.h)
    assert before.offset != 0.0


def test_a_lane_change_begins_where_the_seam_has_left_one(make_spec: Callable[..., Any]) -> None:
    world = on(kinked(0.0, 0.5, 0.0), make_spec, LanePosition("1", -1, 95.0), 10.0, 0.05)
    drive(world, 0.8)
    world.command("a", "lateral", LaneChange(0, 0.3))
    worst, states = drive(world, 3.8)
    assert worst.jump < 0.02
    assert worst.course < STEP
    assert states[-1].offset == pytest.approx(0.3)


@pytest.fixture
def shared(test_data: Path) -> Callable[[str], RoadMap]:
    """A map of others by its path."""
    return lambda name: read_map(test_data / "maps" / f"{name}.xodr")


@pytest.mark.parametrize(
    ("name", "place", "speed"),
    [
        ("esmini/soderleden", LanePosition("0", -3, 60.0), 15.0),
        ("carla-2019/Town06", LanePosition("505", 3, 30.0), 15.0),
        ("carla-2020/Town06", LanePosition("823", -2, 5.0), 15.0),
    ],
)
def test_known_seams(
    shared: Callable[[str], RoadMap],
    make_spec: Callable[..., Any],
    name: str,
    place: LanePosition,
    speed: float,
) -> None:
    """A lane that narrows to nothing, a step, and a lane linked to the one beside it."""
    road_map = shared(name)
    assert road_map.seams_of(place.road, place.lane)
    world = on(road_map, make_spec, place, speed, 0.05)
    worst, _ = drive(world, 10.0)
    assert worst.jump < 0.05
    assert worst.course < STEP
    assert worst.along < 9.0
    assert worst.across < 9.0 or world.overloads()

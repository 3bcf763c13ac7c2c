"""What is expected of actors that somebody else drives, by the kind of command."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.commands import (
    Accelerate,
    Careful,
    Command,
    FollowCourse,
    FollowRoute,
    FollowSpeed,
    KeepGap,
    LaneOffset,
    SpeedChange,
    Standstill,
)
from osc2tx_runtime.world.curve import Curve, Knot
from osc2tx_runtime.world.drivers import DriversPlant
from osc2tx_runtime.world.driving import Control, Observation
from osc2tx_runtime.world.protocol import LATERAL, LONGITUDINAL

DT = 0.05


class Steady:
    """Accelerates as it was told, and steers at an offset in its lane."""

    acceleration = offset = 0.0

    def step(self, seen: Observation, dt: float) -> Control:
        lane = seen.lane
        error = 0.0 if lane is None else self.offset - lane.position.offset - 5.0 * lane.heading
        return Control(self.acceleration, 0.02 * error)


@pytest.fixture
def world(highway: RoadMap, make_spec: Callable[..., Any]) -> tuple[EmbeddedWorld, Steady]:
    """Car `a` at 10 m/s with a driver; car `b` 30 m ahead of it at 12 m/s."""
    driver = Steady()
    made = EmbeddedWorld(highway, DT, DriversPlant({"a": driver}))
    for actor, s, v in (("a", 100.0, 10.0), ("b", 130.0, 12.0)):
        made.add(make_spec(actor))
        made.place(actor, LanePosition("1", -2, s), v)
    made.begin()
    return made, driver


def reached(world: EmbeddedWorld, slot: str, command: Command, seconds: float = 20.0) -> float:
    """Seconds until an expectation is reached; infinite if it is not."""
    world.command("a", slot, command)
    for k in range(round(seconds / DT)):
        world.step()
        if world.progress("a", slot).done:
            return (k + 1) * DT
    return math.inf


@pytest.mark.parametrize(
    ("command", "acceleration", "seconds"),
    [
        (SpeedChange(14.0), 1.0, 3.5),
        (Careful(SpeedChange(14.0)), 1.0, 3.5),
        (SpeedChange(6.0), -2.0, 1.75),
        (SpeedChange(6.0), 1.0, math.inf),
        (Standstill(), -2.0, 5.0),
        (FollowSpeed("b"), 1.0, 1.5),
        (FollowSpeed("b", 1.0, -5.0, 1.0), -1.0, 1.5),
        # 30 m of the reference points are 25.4 m between the boxes, and grow by 2 m/s.
        (KeepGap("b", ahead=False, distance=30.0), 0.0, 2.05),
        (KeepGap("b", ahead=False, distance=20.0), 0.0, math.inf),
    ],
)
def test_speeds_and_gaps(
    world: tuple[EmbeddedWorld, Steady], command: Command, acceleration: float, seconds: float
) -> None:
    made, driver = world
    driver.acceleration = acceleration
    assert reached(made, LONGITUDINAL, command) == pytest.approx(seconds, abs=0.051)


def test_a_place_in_the_lane(world: tuple[EmbeddedWorld, Steady]) -> None:
    made, driver = world
    driver.offset = 1.2
    found = reached(made, LATERAL, LaneOffset(1.0))
    assert 0.5 < found < 5.0
    assert made.state("a").offset == pytest.approx(0.5, abs=0.1)


def test_a_route_is_over_at_its_end(world: tuple[EmbeddedWorld, Steady]) -> None:
    made, _ = world
    goal = FollowRoute(LanePosition("1", -2, 150.0))
    assert reached(made, LATERAL, goal) == pytest.approx(5.0, abs=0.051)


def test_a_path_is_over_at_its_end(world: tuple[EmbeddedWorld, Steady]) -> None:
    """It is joined after a second."""
    made, _ = world
    y = made.state("a").y
    curve = Curve([Knot(0.0, 110.0, y, 0.0), Knot(40.0, 150.0, y, 0.0)], smooth=False)
    found = reached(made, LATERAL, FollowCourse(curve, 0.0, 40.0))
    assert found == pytest.approx(5.0, abs=0.1)


def test_a_path_beside_it_is_never_joined(world: tuple[EmbeddedWorld, Steady]) -> None:
    made, _ = world
    y = made.state("a").y + 3.0
    curve = Curve([Knot(0.0, 110.0, y, 0.0), Knot(40.0, 150.0, y, 0.0)], smooth=False)
    assert reached(made, LATERAL, FollowCourse(curve, 0.0, 40.0)) == math.inf


def test_what_can_only_be_commanded_fails(world: tuple[EmbeddedWorld, Steady]) -> None:
    made, _ = world
    made.command("a", LONGITUDINAL, Accelerate(1.0))
    made.step()
    assert made.progress("a", LONGITUDINAL).failed == (
        "Accelerate can only be commanded, not expected"
    )
    assert made.state("a").v == 10.0

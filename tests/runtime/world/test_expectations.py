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
    AccelerationChange,
    Arrive,
    Beside,
    Careful,
    Command,
    Cover,
    FollowCourse,
    FollowRoute,
    FollowSpeed,
    GapCourse,
    KeepGap,
    KeepSchedule,
    LaneOffset,
    ReplayCourse,
    Sideways,
    Slant,
    SpeedChange,
    Standstill,
)
from osc2tx_runtime.world.drivers.drivers import DriversPlant
from osc2tx_runtime.world.drivers.driving import Control, Observation
from osc2tx_runtime.world.geometry.curve import Curve, Knot
from osc2tx_runtime.world.geometry.profiles import Linear
from osc2tx_runtime.world.protocol import LATERAL, LONGITUDINAL, PENDING

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


@pytest.mark.parametrize(
    ("command", "acceleration", "seconds"),
    [
        # The shape of a change is the driver's own: only its end counts.
        (FollowSpeed("b", course=Linear(-2.0, 3.0, 1.0)), 1.0, 4.5),
        # What is measured is smoothed: after k steps it is 1 - 0.8^k of it.
        (Accelerate(1.0), 1.0, 0.2),
        (Accelerate(2.0), 1.0, math.inf),
        (AccelerationChange(9.0, course=Linear(0.0, 1.2, 3.0)), 1.0, 0.3),
        # 30 m behind at the start, and 2 m/s slower.
        (GapCourse("b", Linear(-30.0, -40.0, 3.0)), 0.0, 4.75),
        (Arrive(4.0, way=40.0), 0.0, 4.0),
        (Arrive(4.0, way=48.0, speed=14.0), 1.0, 4.0),
        (Arrive(4.0, gap=KeepGap("b", ahead=False, measure="reference", distance=38.0)), 0.0, 4.0),
        (Cover(Linear(0.0, 30.0, 3.0)), 0.0, 3.0),
    ],
)
def test_goals_with_a_shape_or_a_time(
    world: tuple[EmbeddedWorld, Steady], command: Command, acceleration: float, seconds: float
) -> None:
    made, driver = world
    driver.acceleration = acceleration
    assert reached(made, LONGITUDINAL, command) == pytest.approx(seconds, abs=0.051)


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (
            Arrive(4.0, way=60.0),
            "at the end of its duration it is 20.0 m short of its target position",
        ),
        (Arrive(4.0, way=40.0, speed=14.0), "at the end of its duration it is 4.0 m/s too slow"),
        (Arrive(4.0, way=40.0, speed=FollowSpeed("b")), "it is 2.0 m/s too slow"),
        (
            Cover(Linear(0.0, 50.0, 4.0)),
            "at the end of its duration it is 10.0 m short of its target position",
        ),
    ],
)
def test_who_is_not_there_in_time_fails(
    world: tuple[EmbeddedWorld, Steady], command: Command, words: str
) -> None:
    made, _ = world
    made.command("a", LONGITUDINAL, command)
    for _ in range(79):
        made.step()
        assert made.progress("a", LONGITUDINAL) == PENDING
    made.step()
    assert words in (made.progress("a", LONGITUDINAL).failed or "")


def test_a_schedule_is_over_at_its_end_or_too_late(world: tuple[EmbeddedWorld, Steady]) -> None:
    made, driver = world
    here = made.state("a")

    def line(seconds: float) -> KeepSchedule:
        knots = [Knot(0.0, here.x, here.y, 0.0), Knot(seconds, here.x + 40.0, here.y, 0.0)]
        return KeepSchedule(Curve(knots, smooth=False), 0.0, seconds)

    assert reached(made, LONGITUDINAL, line(3.0)) == pytest.approx(4.0, abs=0.1)
    driver.acceleration = -5.0
    made.command("a", LONGITUDINAL, KeepSchedule(line(3.0).curve, 3.0, 3.0))
    here = made.state("a")
    made.command("a", LONGITUDINAL, line(3.0))
    for _ in range(round(13.2 / DT)):
        made.step()
    assert "m from the end, 10 s after its time" in (made.progress("a", LONGITUDINAL).failed or "")


def test_to_the_side(world: tuple[EmbeddedWorld, Steady]) -> None:
    """The driver goes 1.2 m to the left, at about 1 m/s, and is straight again."""
    made, driver = world
    driver.offset = 1.2
    assert 0.0 < reached(made, LATERAL, Sideways(1.0, course=Linear(0.0, 0.8, 9.0))) < 3.0
    assert reached(made, LATERAL, Beside("b", 1.0)) < 8.0
    assert made.state("a").offset == pytest.approx(0.5, abs=0.3)
    assert reached(made, LATERAL, Slant(0.0)) < 8.0
    assert reached(made, LATERAL, Slant(0.5), 1.0) == math.inf


def test_what_can_only_be_commanded_fails(world: tuple[EmbeddedWorld, Steady]) -> None:
    made, _ = world
    curve = Curve([Knot(0.0, 110.0, 0.0, 0.0), Knot(40.0, 150.0, 0.0, 0.0)], smooth=False)
    made.command("a", LATERAL, ReplayCourse(curve, 0.0, 40.0))
    made.step()
    assert made.progress("a", LATERAL).failed == (
        "ReplayCourse can only be commanded, not expected"
    )
    assert made.state("a").v == 10.0

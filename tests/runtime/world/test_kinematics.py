"""Velocity and acceleration in the own axes, against circles, clothoids, slopes and crests."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap
from osc2tx_runtime.world import ActorSpec, EmbeddedWorld
from osc2tx_runtime.world.commands import LaneChange, ReplayTrajectory, SpeedChange, Turn
from osc2tx_runtime.world.geometry.curve import Curve, Knot
from osc2tx_runtime.world.measuring.kinematics import Kinematics
from tests.runtime.opendrive.small_maps import one_road

SPEED = 10.0
HALF_LANE = 1.5  # m from the reference line to the middle of lane -1, to the right of it
DT = 0.05

MakeSpec = Callable[..., ActorSpec]


@pytest.fixture
def drive(make_spec: MakeSpec) -> Callable[..., EmbeddedWorld]:
    """A world with car `a` on lane -1, some steps after its start."""

    def make(road_map: RoadMap, steps: int, s: float = 0.0, speed: float = SPEED) -> EmbeddedWorld:
        world = EmbeddedWorld(road_map, DT)
        world.add(make_spec("a"))
        world.place("a", LanePosition("1", -1, s), speed)
        for _ in range(steps):
            world.step()
        return world

    return make


def along(motion: Kinematics) -> tuple[float, float, float]:
    part = motion.velocity.translational
    return part.x, part.y, part.z


def about(motion: Kinematics) -> tuple[float, float, float]:
    part = motion.velocity.angular
    return part.roll, part.pitch, part.yaw


def pushed(motion: Kinematics) -> tuple[float, float, float]:
    part = motion.acceleration.translational
    return part.x, part.y, part.z


def twisted(motion: Kinematics) -> tuple[float, float, float]:
    part = motion.acceleration.angular
    return part.roll, part.pitch, part.yaw


def near(*values: float, by: float = 1e-9) -> object:
    return pytest.approx(values, abs=by)


@pytest.mark.parametrize("steps", [1, 2, 40])
def test_a_circle(drive: Callable[..., EmbeddedWorld], steps: int) -> None:
    motion = drive(one_road('arc curvature="0.02"', 250.0), steps).motion("a")
    radius = 50.0 + HALF_LANE
    assert along(motion) == near(SPEED, 0.0, 0.0)
    assert about(motion) == near(0.0, 0.0, SPEED / radius)
    assert pushed(motion) == near(0.0, SPEED**2 / radius, 0.0)
    assert twisted(motion) == near(0.0, 0.0, 0.0)
    assert motion.acceleration.translational.norm() == pytest.approx(SPEED**2 / radius)
    assert motion.velocity.translational.norm() == pytest.approx(SPEED)


def test_nothing_turns_before_the_first_step(drive: Callable[..., EmbeddedWorld]) -> None:
    motion = drive(one_road('arc curvature="0.02"', 250.0), 0).motion("a")
    assert along(motion) == near(SPEED, 0.0, 0.0)
    assert about(motion) == pushed(motion) == twisted(motion) == near(0.0, 0.0, 0.0)


def test_a_clothoid(drive: Callable[..., EmbeddedWorld]) -> None:
    """The curvature grows with the way, so the yaw rate grows with the time."""
    growth = 0.02 / 100.0  # 1/m^2
    world = drive(one_road(f'spiral curvStart="0" curvEnd="{100 * growth}"', 100.0), 100)
    s = world.state("a").s
    assert s is not None
    here = s - 0.5 * SPEED * DT  # rates are those in the middle of the last step
    curvature = growth * here / (1.0 + HALF_LANE * growth * here)
    motion = world.motion("a")
    assert about(motion)[2] == pytest.approx(SPEED * curvature, rel=1e-4)
    # Of the line beside the reference line: the change of k / (1 + k t) over its own length.
    share = 1.0 / (1.0 + HALF_LANE * growth * here) ** 3
    assert twisted(motion)[2] == pytest.approx(SPEED**2 * growth * share, rel=2e-2)
    assert along(motion) == near(SPEED, 0.0, 0.0)


def test_braking(drive: Callable[..., EmbeddedWorld]) -> None:
    world = drive(one_road("line", 200.0), 0)
    world.command("a", "longitudinal", SpeedChange(4.0, "constant", 3.0))
    for _ in range(20):
        world.step()
    motion = world.motion("a")
    assert along(motion) == near(SPEED - 3.0, 0.0, 0.0)
    assert pushed(motion) == near(-3.0, 0.0, 0.0)


def test_backwards(drive: Callable[..., EmbeddedWorld]) -> None:
    motion = drive(one_road('arc curvature="0.02"', 250.0), 5, s=200.0, speed=-SPEED).motion("a")
    radius = 50.0 + HALF_LANE
    assert along(motion) == near(-SPEED, 0.0, 0.0)
    assert about(motion) == near(0.0, 0.0, -SPEED / radius)
    assert pushed(motion) == near(0.0, SPEED**2 / radius, 0.0)


def elevation(*coefficients: float) -> str:
    names = zip("abcd", (*coefficients, 0.0, 0.0, 0.0, 0.0), strict=False)
    terms = " ".join(f'{name}="{value}"' for name, value in names)
    return f'<elevationProfile><elevation s="0" {terms}/></elevationProfile>'


def test_a_slope(drive: Callable[..., EmbeddedWorld]) -> None:
    """Speed is that on the ground, the way is that on the slope."""
    road = one_road("line", 200.0, extra=elevation(0.0, 0.1))
    motion = drive(road, 10).motion("a")
    assert along(motion) == near(SPEED * math.hypot(1.0, 0.1), 0.0, 0.0)
    assert about(motion) == pushed(motion) == near(0.0, 0.0, 0.0)


def test_a_crest(drive: Callable[..., EmbeddedWorld]) -> None:
    """z = 20 s/R - s^2 / 2R has its top at 20 m; there the road bends down with radius R."""
    radius = 500.0
    road = one_road("line", 60.0, extra=elevation(0.0, 20.0 / radius, -0.5 / radius))
    world = drive(road, round(20.0 / SPEED / DT))
    assert world.state("a").s == pytest.approx(20.0)
    motion = world.motion("a")
    assert along(motion) == near(SPEED, 0.0, 0.0, by=1e-3)
    assert about(motion) == near(0.0, SPEED / radius, 0.0, by=1e-5)  # the nose sinks
    assert pushed(motion) == near(0.0, 0.0, -(SPEED**2) / radius, by=2e-3)


def test_a_slide(make_spec: MakeSpec) -> None:
    """A thing that looks to the left while it is drawn along x slides to its right."""
    world = EmbeddedWorld(one_road("line", 200.0), DT)
    world.add(make_spec("a", "movable_object"))
    world.place("a", Pose(0.0, 30.0, 0.0, 0.5 * math.pi))
    ahead = [Knot(t, 5.0 * t, 30.0, 0.0, 0.5 * math.pi) for t in (0.0, 1.0, 2.0)]
    curve = Curve(ahead, smooth=False)
    command = ReplayTrajectory(curve, 0.0, 2.0)
    world.command("a", "longitudinal", command)
    world.command("a", "lateral", command)
    for _ in range(10):
        world.step()
    assert along(world.motion("a")) == near(0.0, -5.0, 0.0)


def test_a_turn_on_the_spot(make_spec: MakeSpec) -> None:
    world = EmbeddedWorld(one_road("line", 200.0), DT)
    world.add(make_spec("a", "person"))
    world.place("a", Pose(0.0, 30.0, 0.0, 0.0))
    world.command("a", "lateral", Turn(heading=2.0))
    for _ in range(3):
        world.step()
    motion = world.motion("a")
    assert along(motion) == pushed(motion) == near(0.0, 0.0, 0.0)
    assert about(motion) == near(0.0, 0.0, math.pi)  # as fast as persons turn


def test_a_jump_is_no_motion(drive: Callable[..., EmbeddedWorld]) -> None:
    world = drive(one_road('arc curvature="0.02"', 250.0), 5)
    world.assign("a", at=LanePosition("1", -1, 150.0))
    motion = world.motion("a")
    assert along(motion) == near(SPEED, 0.0, 0.0)
    assert about(motion) == pushed(motion) == twisted(motion) == near(0.0, 0.0, 0.0)
    world.step()
    radius = 50.0 + HALF_LANE
    assert about(world.motion("a")) == near(0.0, 0.0, SPEED / radius)
    assert twisted(world.motion("a")) == near(0.0, 0.0, 0.0)


def test_a_lane_change_goes_where_the_car_looks(
    car_world: Callable[..., EmbeddedWorld],
) -> None:
    """Its yaw rates add up to its turn; it drives forwards all the time."""
    world = car_world()
    world.command("a", "lateral", LaneChange(-1))
    turned, most = 0.0, 0.0
    for _ in range(60):
        world.step()
        motion = world.motion("a")
        assert along(motion) == near(10.0, 0.0, 0.0)
        turned += about(motion)[2] * world.dt
        most = max(most, abs(turned))
        assert turned == pytest.approx(world.state("a").h, abs=1e-9)
        # What throws to the side is the turning of the way.
        assert pushed(motion)[1] == pytest.approx(10.0 * about(motion)[2], abs=1e-9)
    assert most > 0.05


@pytest.mark.parametrize("dt", [0.05, 0.01, 0.002])
def test_a_tiny_step_in_the_height_of_a_map_is_no_leap(make_spec: MakeSpec, dt: float) -> None:
    """The map gives its heights in tenths of millimetres; a step of 0.3 mm is their rounding."""
    step = (
        '<elevationProfile><elevation s="0" a="0" b="0.05" c="0" d="0"/>'
        '<elevation s="50" a="2.5003" b="0.05" c="0" d="0"/></elevationProfile>'
    )
    world = EmbeddedWorld(one_road("line", 100.0, extra=step), dt)
    world.add(make_spec("a"))
    world.place("a", LanePosition("1", -1, 49.0), SPEED)
    for _ in range(round(0.2 / dt)):
        world.step()
        assert along(world.motion("a"))[2] == pytest.approx(0.0, abs=1e-9)
        assert pushed(world.motion("a")) == near(0.0, 0.0, 0.0, by=1e-6)
    assert world.state("a").z == pytest.approx(2.5003 + 0.05, abs=1e-3)

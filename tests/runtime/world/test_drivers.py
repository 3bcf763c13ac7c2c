"""External drivers in the embedded world: what they see, what they move, what can go wrong."""

from __future__ import annotations

import json
import math
import re
import sys
from collections.abc import Callable
from types import ModuleType
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Control,
    Observation,
    Parallel,
    RunSettings,
    Scenario,
    Serial,
    Wait,
    elapsed,
    run_scenario,
)
from osc2tx_runtime.errors import CapabilityError, ScenarioError, SettingsError
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.running.options import read_options
from osc2tx_runtime.world.actor_dimensions import CAR_LIMITS, shape_of
from osc2tx_runtime.world.drivers.drivers import SingleTrack
from osc2tx_runtime.world.grip.friction import DRY_ADHESION, GRAVITY
from tests.runtime.world.two_cars import TwoCars, scenario

DT = 0.05


@pytest.fixture
def drivers(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """A module for the drivers of tests."""
    module = ModuleType("drivers")
    driving(module, lambda seen, dt: Control())
    monkeypatch.setitem(sys.modules, "drivers", module)
    return module


class Run:
    """A run with drivers, and its lines."""

    def __init__(self, made: type[Scenario], ego: dict[str, str], **settings: Any) -> None:
        options = RunSettings(**{"max_time": 60.0, **settings}, world_options={"ego": ego})
        self.result = run_scenario(made, options)
        self.lines = [json.loads(line) for line in self.result.trace_lines]

    def states(self, actor: str) -> list[dict[str, Any]]:
        return [e for e in self.lines if e["kind"] == "state" and e["actor"] == actor]

    def actions(self, name: str) -> list[tuple[str, float]]:
        found = [e for e in self.lines if e["kind"] == "action" and e["name"] == name]
        return [(e["status"], e["t"]) for e in found]


def driving(drivers: ModuleType, step: Callable[[Observation, float], Any]) -> dict[str, str]:
    """Let car `a` be driven by a function."""
    made = type("Made", (), {"step": lambda self, seen, dt: step(seen, dt)})
    drivers.Made = made  # type: ignore[attr-defined]
    return {"a": "drivers:Made"}


def test_an_action_of_an_external_actor_is_an_error_with_its_line(drivers: ModuleType) -> None:
    ego = driving(drivers, lambda seen, dt: Control())

    def body(s: TwoCars) -> Behaviour:
        return Parallel("", s.a.change_speed(target=12.0), s.b.drive(duration=1.0))

    with pytest.raises(CapabilityError, match="a change_speed: a is under external control"):
        Run(scenario(body), ego)


def test_an_expectation_that_is_not_met_in_its_time(drivers: ModuleType) -> None:
    ego = driving(drivers, lambda seen, dt: Control(acceleration=0.5))

    def body(s: TwoCars) -> Behaviour:
        return s.a.change_speed(target=16.0, duration=4.0)

    done = Run(scenario(body), ego, expect=True)
    assert done.result.status == "failure"
    assert done.result.time == pytest.approx(4.0)


def test_a_lane_change_that_is_expected(drivers: ModuleType) -> None:
    """It is over when the car is in the other lane, however it comes there."""

    def swerve(seen: Observation, dt: float) -> Control:
        wished = 0.1 if 2.0 < seen.time < 6.0 and seen.lane.position.lane == -3 else 0.0
        error = wished - seen.lane.heading
        if seen.lane.position.lane == -2:
            error -= 0.05 * seen.lane.position.offset
        return Control(steering=error)

    done = Run(
        scenario(lambda s: s.a.change_lane(num_of_lanes=1, side="left")),
        driving(drivers, swerve),
        expect=True,
    )
    assert done.result.status == "success", done.result.reason
    end = done.states("a")[-1]
    assert end["lane"] == -2
    assert abs(end["offset"]) <= 0.5
    assert done.result.time > 3.0


def test_nothing_can_be_assigned(drivers: ModuleType) -> None:
    ego = driving(drivers, lambda seen, dt: Control())
    body = scenario(lambda s: Serial("", Wait(elapsed(1.0)), s.a.assign_speed(speed=3.0)))
    with pytest.raises(CapabilityError, match="a assign_speed: a is under external control"):
        Run(body, ego, expect=True)


def test_what_is_assigned_at_first_is_its_start(drivers: ModuleType) -> None:
    """The driver goes on from there; 15 m/s, less 2 m/s^2."""
    ego = driving(drivers, lambda seen, dt: Control(acceleration=-2.0))

    def body(s: TwoCars) -> Behaviour:
        put = s.a.assign_position(lane(1), position(200.0))
        return Serial("", put, s.a.assign_speed(speed=15.0), Wait(elapsed(2.0)))

    done = Run(scenario(body), ego)
    states = done.states("a")
    assert (states[0]["s"], states[0]["v"]) == (200.0, 15.0)
    assert states[-1]["v"] == pytest.approx(11.0)
    assert states[-1]["x"] - states[0]["x"] == pytest.approx(26.0)


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (lambda seen, dt: seen.nothing, "drivers.Made, raised AttributeError"),
        (lambda seen, dt: 3.0, "returns a float, not a Control"),
        (lambda seen, dt: Control(math.nan), "returns a Control whose acceleration is nan"),
    ],
)
def test_a_driver_that_breaks(drivers: ModuleType, answer: Any, said: str) -> None:
    body = scenario(lambda s: s.b.drive(duration=1.0))
    made = driving(drivers, answer)
    drivers.Made.__module__ = "drivers"  # type: ignore[attr-defined]
    with pytest.raises(ScenarioError, match=re.escape(said)):
        Run(body, made)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"ego": "a"}, "write ACTOR=PACKAGE.MODULE:CLASS"),
        ({"ego": "a=drivers"}, "write ACTOR=PACKAGE.MODULE:CLASS"),
        ({"ego": "a=drivers:Nobody"}, "cannot be made: AttributeError"),
        ({"ego": "a=no_such_module:Nobody"}, "cannot be made: ModuleNotFoundError"),
        ({"ego": "a=builtins:range"}, "cannot be made: TypeError"),
        ({"ego": "z=drivers:Made"}, "z is not a vehicle of the scenario"),
        ({"control": "a=external"}, "no driver for a"),
        ({"control": "driven"}, "the world embedded has exact and external"),
        ({"control": "z=exact"}, "the scenario has no such actor"),
        ({"ego": "a=drivers:Made", "control": "a=exact"}, "contradicts --ego"),
    ],
)
def test_mistakes_in_options(drivers: ModuleType, settings: dict[str, str], said: str) -> None:
    body = scenario(lambda s: s.b.drive(duration=1.0))
    with pytest.raises(SettingsError, match=re.escape(said)):
        run_scenario(body, read_options(settings))


def test_what_a_driver_sees(drivers: ModuleType) -> None:
    seen: list[Observation] = []

    def look(observation: Observation, dt: float) -> Control:
        assert dt == DT
        seen.append(observation)
        return Control()

    Run(scenario(lambda s: s.b.drive(duration=1.0)), driving(drivers, look))
    first = seen[0]
    assert (first.time, first.speed) == (0.0, 10.0)
    assert seen[10].time == pytest.approx(0.5)
    assert first.lane is not None
    assert (first.lane.width, first.lane.heading) == (pytest.approx(3.5, abs=0.3), 0.0)
    (other,) = first.others
    assert (other.id, other.kind, other.speed) == ("b", "vehicle", 12.0)
    assert other.ahead == pytest.approx(other.pose.x - first.pose.x, abs=1e-6)
    assert other.left == pytest.approx(0.0, abs=1e-9)
    assert [p.x - first.pose.x for p in first.route[:3]] == pytest.approx([2.0, 4.0, 6.0])
    assert len(first.route) == 50
    assert first.stop_line is None


# --- the vehicle ----------------------------------------------------------------------------------


def test_on_a_circle_it_stays_exactly() -> None:
    """Steering is atan(wheelbase / radius); after a whole turn it is where it was."""
    shape, radius = shape_of("vehicle", "car"), 20.0
    vehicle = SingleTrack(Pose(0.0, 0.0, 0.0, 0.0), 5.0, shape)
    steering = math.atan(shape.wheelbase / radius)
    steps = 100
    dt = math.tau * radius / 5.0 / steps
    for _ in range(steps):
        away = math.hypot(vehicle.pose.x, vehicle.pose.y - radius)
        assert away == pytest.approx(radius, abs=1e-9)
        vehicle.step(Control(0.0, steering), CAR_LIMITS, DRY_ADHESION * GRAVITY, dt)
        assert vehicle.yaw_rate == pytest.approx(5.0 / radius)
    assert (vehicle.pose.x, vehicle.pose.y) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_it_brakes_to_a_stand_and_not_backwards() -> None:
    """v^2 / 2a, whatever the step."""
    for dt in (0.05, 0.3, 1.0):
        vehicle = SingleTrack(Pose(0.0, 0.0, 0.0, 0.0), 10.0, shape_of("vehicle", "car"))
        for _ in range(round(6.0 / dt)):
            vehicle.step(Control(-4.0), CAR_LIMITS, DRY_ADHESION * GRAVITY, dt)
        assert vehicle.speed == 0.0
        assert vehicle.pose.x == pytest.approx(12.5)


def test_the_friction_circle_holds() -> None:
    """Too fast for the curve it goes wide, and has nothing left to brake with."""
    grip = DRY_ADHESION * GRAVITY
    vehicle = SingleTrack(Pose(0.0, 0.0, 0.0, 0.0), 30.0, shape_of("vehicle", "car"))
    vehicle.step(Control(-8.0, 0.5), CAR_LIMITS, grip, DT)
    assert vehicle.speed == 30.0
    assert vehicle.yaw_rate * 30.0 == pytest.approx(grip)


def test_external_actors_have_limits_of_their_own(drivers: ModuleType) -> None:
    """12 m/s^2 are asked for; the car does 4."""
    done = Run(
        scenario(lambda s: s.b.drive(duration=1.0)),
        driving(drivers, lambda seen, dt: Control(acceleration=12.0)),
    )
    assert done.states("a")[-1]["v"] == pytest.approx(14.0)


class Approach(TwoCars):
    """Starts in a lane with a speed, and has nothing to do."""

    def placement(self) -> None:
        self.place(self.a, lane(1), position(distance=10.0), speed(10.0))
        self.place(self.b, lane(3), position(distance=10.0), speed(10.0))

    def behavior(self) -> Behaviour:
        return self.b.drive(duration=2.0)


def test_it_starts_where_the_scenario_puts_it(drivers: ModuleType) -> None:
    done = Run(Approach, driving(drivers, lambda seen, dt: Control()))
    first, last = done.states("a")[0], done.states("a")[-1]
    assert (first["v"], first["s"]) == (10.0, 10.0)
    assert last["s"] == pytest.approx(30.0)

"""A plant that lags, loses speed and drifts: places, speeds, and when actions are over."""

from __future__ import annotations

from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Serial,
    Wait,
    elapsed,
)
from osc2tx_runtime.errors import SimulatorError
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.simulators.carla.plant import CarlaPlant
from osc2tx_runtime.world.checks.values import CheckedCalls
from osc2tx_runtime.world.commands import LaneChange, SpeedChange
from osc2tx_runtime.world.measuring.deviation import (
    PATIENCE,
    PLACE_TOLERANCE,
    SPEED_TOLERANCE,
    STANDSTILL,
)
from osc2tx_runtime.world.measuring.measurement import Measurement
from osc2tx_runtime.world.protocol import LATERAL, LONGITUDINAL
from tests.runtime.world.following_plant import FollowingPlant
from tests.runtime.world.plant_runs import DT, Run, Spec, driving, steps
from tests.runtime.world.two_cars import TwoCars, scenario

# --- speed and place ------------------------------------------------------------------------------


@pytest.mark.parametrize("gain", [0.98, 1.02])
def test_holding_the_speed_does_not_run_away(
    highway: RoadMap, make_spec: Spec, gain: float
) -> None:
    """The speed to hold is that of the reference: 2 % off it stay 2 %, however long it goes on."""
    world = driving(highway, make_spec, FollowingPlant(gain=gain))
    steps(world, 40.0)
    assert world.reference("a").v == 15.0
    assert world.state("a").v == pytest.approx(15.0 * gain, abs=1e-6)


def test_the_reference_stays_abreast(highway: RoadMap, make_spec: Spec) -> None:
    """10 % of 15 m/s would be 60 m apart after 40 s."""
    world = driving(highway, make_spec, FollowingPlant(gain=0.9))
    steps(world, 40.0)
    state, reference = world.state("a"), world.reference("a")
    assert state.s == pytest.approx(100.0 + 40.0 * 13.5, abs=0.5)
    assert reference.s == pytest.approx(state.s, abs=1e-6)


def test_the_reference_keeps_its_place_across(highway: RoadMap, make_spec: Spec) -> None:
    """A car that drifts is beside its reference, which stays in the middle of the lane."""
    world = driving(highway, make_spec, FollowingPlant(drift=0.3))
    steps(world, 10.0)
    state, reference = world.state("a"), world.reference("a")
    assert reference.offset == 0.0
    deviation = world.deviation("a", (LATERAL,))
    assert deviation is not None
    assert deviation.place == pytest.approx(state.offset, abs=1e-6)
    assert 0.05 < deviation.place < PLACE_TOLERANCE


def test_a_lane_change_ends_in_the_lane(highway: RoadMap, make_spec: Spec) -> None:
    """Done when the reference is and the car was measured near it, not before."""
    world = driving(highway, make_spec, FollowingPlant())
    world.command("a", LATERAL, LaneChange(1))
    while not world.progress("a", LATERAL).done:
        world.step()
    assert world.reference("a").lane == -1
    assert world.state("a").lane == -1
    assert abs(world.state("a").offset or 0.0) <= PLACE_TOLERANCE


def test_the_path_ahead(highway: RoadMap, make_spec: Spec) -> None:
    """What a controller looks at: the lane, and the lane change that is to come."""
    seen: list[tuple[float, float]] = []

    class Looking(FollowingPlant):
        def moved(self, scene: Any) -> Any:
            at = scene.setpoints["a"]
            seen.append((at.ahead(15.0).y - at.state.y, at.ahead(-5.0).x - at.state.x))
            return super().moved(scene)

    world = driving(highway, make_spec, Looking(lag=0.01))
    world.step()
    assert seen[-1] == pytest.approx((0.0, -5.0), abs=1e-6)
    world.command("a", LATERAL, LaneChange(1, profile="smooth", duration=3.0))
    steps(world, 1.5)
    # In the middle of it; a second later two thirds and more of the other half are done.
    assert 0.25 * 3.5 < seen[-1][0] < 0.5 * 3.75


# --- completion -----------------------------------------------------------------------------------


def test_a_speed_is_reached_when_it_was_measured(highway: RoadMap, make_spec: Spec) -> None:
    world = driving(highway, make_spec, FollowingPlant(lag=1.5), v=10.0)
    world.command("a", LONGITUDINAL, SpeedChange(16.0, "constant", 3.0))
    reference = None
    for k in range(200):
        world.step()
        if reference is None and world.reference("a").v == 16.0:
            reference = k
            assert not world.progress("a", LONGITUDINAL).done
        if world.progress("a", LONGITUDINAL).done:
            break
    assert reference is not None
    assert k > reference
    assert abs(world.state("a").v - 16.0) <= SPEED_TOLERANCE
    deviation = world.deviation("a", (LONGITUDINAL,))
    assert deviation is not None
    assert deviation.late == pytest.approx((k - reference) * DT)


def test_a_speed_that_is_never_reached_fails_with_figures(highway: RoadMap) -> None:
    plant = FollowingPlant(most=14.0)
    done = Run(scenario(lambda s: s.a.change_speed(target=16.0)), highway, plant)
    assert done.result.status == "failure"
    (failed,) = done.actions("fail")
    assert failed["reason"] == "its speed deviates by -2.00 m/s, 5 s after its time of arrival"
    exact = Run(scenario(lambda s: s.a.change_speed(target=16.0)), highway, FollowingPlant(0.01))
    assert done.result.time == pytest.approx(exact.result.time + PATIENCE, abs=0.2)


def test_leaving_the_path_fails_with_figures(highway: RoadMap) -> None:
    done = Run(scenario(lambda s: s.a.drive(duration=20.0)), highway, FollowingPlant(drift=3.0))
    assert done.result.status == "failure"
    assert "m from its path" in done.actions("fail")[0]["reason"]


def test_a_duration_is_judged_by_tolerance(highway: RoadMap) -> None:
    """At 3 s the reference is there exactly, the car nearly: the trace says by how much."""
    done = Run(
        scenario(lambda s: s.a.change_speed(target=16.0, duration=3.0)),
        highway,
        FollowingPlant(lag=0.3),
    )
    assert done.result.status == "success"
    assert done.result.time == pytest.approx(3.0)
    (end,) = done.actions("end")
    assert 0.0 < -end["deviation"]["speed"] <= SPEED_TOLERANCE
    assert set(end["deviation"]) == {"speed", "place", "heading", "late"}


def test_a_start_condition_wants_the_actor_there(highway: RoadMap) -> None:
    """The reference has the speed, the car does not."""

    def body(s: TwoCars) -> Behaviour:
        return Serial("", Wait(elapsed(20.0)), s.a.drive(speed(10.0, at="start"), duration=1.0))

    assert Run(scenario(body), highway, FollowingPlant()).result.status == "success"
    slow = Run(scenario(body), highway, FollowingPlant(most=9.0))
    assert "at its start its speed deviates by -1.00 m/s" in slow.result.reason


def test_below_a_threshold_it_stands(highway: RoadMap, make_spec: Spec) -> None:
    class Creeping(FollowingPlant):
        def measurement(self, pose: Any, speed: float) -> Measurement:
            return Measurement(pose, (speed + 0.9 * STANDSTILL, 0.0, 0.0))

    world = driving(highway, make_spec, Creeping(lag=0.05), v=5.0)
    world.command("a", LONGITUDINAL, SpeedChange(0.0))
    steps(world, 8.0)
    assert world.state("a").v == 0.0
    assert world.progress("a", LONGITUDINAL).done


def test_what_a_plant_of_a_simulator_raises() -> None:
    """The answer of a simulator that nobody expects: named, and no bug of the scenario."""
    calls = CheckedCalls("plant", object.__new__(CarlaPlant))

    def fails() -> float:
        raise KeyError("skipped")

    with pytest.raises(SimulatorError) as caught:
        calls.ask("moved", fails, float)
    assert caught.value.exit_code == 4
    assert caught.value.message == (
        "the plant osc2tx_runtime.simulators.carla.plant.CarlaPlant raised KeyError: 'skipped'"
    )

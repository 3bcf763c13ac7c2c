"""A world whose actors are moved by a plant that lags, loses speed and drifts."""

from __future__ import annotations

import json
import math
import random
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Parallel,
    RunResult,
    RunSettings,
    Scenario,
    Serial,
    Wait,
    elapsed,
    run_scenario,
)
from osc2tx_runtime.errors import CapabilityError, ScenarioError, SimulatorError
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.commands import Arrive, Careful, LaneChange, SpeedChange
from osc2tx_runtime.world.friction import GRAVITY
from osc2tx_runtime.world.measurement import Measurement
from osc2tx_runtime.world.protocol import LATERAL, LONGITUDINAL
from osc2tx_runtime.world.tolerances import (
    PATIENCE,
    PLACE_TOLERANCE,
    SPEED_TOLERANCE,
    STANDSTILL,
)
from osc2tx_runtime.world.towing import coupling_gap, pose_behind
from osc2tx_runtime.world.velocities import OrientationRate, TranslationalAcceleration
from tests.runtime.world.following_plant import FollowingPlant
from tests.runtime.world.two_cars import TwoCars, scenario

DT = 0.05
Spec = Callable[..., Any]


def driving(road_map: RoadMap, spec: Spec, plant: FollowingPlant, v: float = 15.0) -> EmbeddedWorld:
    """World with the driven car `a` on lane -2 of the highway, begun."""
    world = EmbeddedWorld(road_map, DT, plant)
    world.add(spec("a"))
    world.place("a", LanePosition("1", -2, 100.0), v)
    world.begin()
    return world


def steps(world: EmbeddedWorld, seconds: float) -> None:
    for _ in range(round(seconds / DT)):
        world.step()


class Run:
    """A run of a scenario with a plant."""

    def __init__(
        self,
        made: type[Scenario],
        road_map: RoadMap,
        plant: FollowingPlant,
        **settings: Any,
    ) -> None:
        world = EmbeddedWorld(road_map, DT, plant)
        options = RunSettings(**{"max_time": 60.0, **settings})
        self.result: RunResult = run_scenario(made, options, world=world)
        self.lines = [json.loads(line) for line in self.result.trace_lines]

    def actions(self, status: str) -> list[dict[str, Any]]:
        return [e for e in self.lines if e["kind"] == "action" and e["status"] == status]


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
    assert failed["reason"] == "it is -2.00 m/s off its speed, 5 s after it was to be there"
    exact = Run(scenario(lambda s: s.a.change_speed(target=16.0)), highway, FollowingPlant(0.01))
    assert done.result.time == pytest.approx(exact.result.time + PATIENCE, abs=0.2)


def test_leaving_the_path_fails_with_figures(highway: RoadMap) -> None:
    done = Run(scenario(lambda s: s.a.drive(duration=20.0)), highway, FollowingPlant(drift=3.0))
    assert done.result.status == "failure"
    assert "m off its path" in done.actions("fail")[0]["reason"]


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
    assert "at its start it is -1.00 m/s off its speed" in slow.result.reason


def test_below_a_threshold_it_stands(highway: RoadMap, make_spec: Spec) -> None:
    class Creeping(FollowingPlant):
        def measurement(self, pose: Any, speed: float) -> Measurement:
            return Measurement(pose, (speed + 0.9 * STANDSTILL, 0.0, 0.0))

    world = driving(highway, make_spec, Creeping(lag=0.05), v=5.0)
    world.command("a", LONGITUDINAL, SpeedChange(0.0))
    steps(world, 8.0)
    assert world.state("a").v == 0.0
    assert world.progress("a", LONGITUDINAL).done


# --- the same scenarios ---------------------------------------------------------------------------


def cut_in(s: TwoCars) -> Behaviour:
    """Passes the other car and changes lane before it."""
    return Serial(
        "",
        s.a.change_speed(target=18.0),
        Parallel(
            "",
            s.a.change_lane(num_of_lanes=1, side="left"),
            s.b.change_speed(target=10.0, rate_profile="smooth"),
        ),
        s.a.drive(duration=2.0),
    )


def test_order_and_times_are_those_of_the_embedded_world(highway: RoadMap) -> None:
    exact = run_scenario(scenario(cut_in), RunSettings())
    driven = Run(scenario(cut_in), highway, FollowingPlant(lag=0.1))
    wanted = [json.loads(line) for line in exact.trace_lines]
    pick = ("kind", "status", "name", "actor")
    before = [e for e in wanted if e["kind"] in ("action", "event")]
    after = [e for e in driven.lines if e["kind"] in ("action", "event")]
    assert [[e.get(k) for k in pick] for e in after] == [[e.get(k) for k in pick] for e in before]
    assert all(abs(a["t"] - b["t"]) <= 0.2 for a, b in zip(after, before, strict=True))


def test_an_exact_plant_changes_no_byte_but_of_the_header(highway: RoadMap) -> None:
    exact = run_scenario(scenario(cut_in), RunSettings())
    plant = FollowingPlant(exact=("a", "b"))
    again = Run(scenario(cut_in), highway, plant)
    assert again.result.trace_lines[1:] == exact.trace_lines[1:]
    head = json.loads(exact.trace_lines[0])
    assert json.loads(again.result.trace_lines[0]) == {**head, "world": "following 1.0"}


def test_the_header_says_who_moves_whom(highway: RoadMap) -> None:
    done = Run(scenario(cut_in), highway, FollowingPlant(exact=("b",)))
    assert done.lines[0]["world"] == "following 1.0"
    assert done.lines[0]["control"] == {"a": "driven", "b": "exact"}


# --- life -----------------------------------------------------------------------------------------


class Failing(FollowingPlant):
    """Fails after some steps."""

    error: BaseException = SimulatorError("the simulator does not answer any more")

    def moved(self, scene: Any) -> Any:
        if self.calls.count("moved") == 20:
            raise self.error
        return super().moved(scene)


def test_begin_comes_after_the_placement_and_close_last(highway: RoadMap) -> None:
    plant = FollowingPlant()
    Run(scenario(lambda s: s.a.drive(duration=1.0)), highway, plant)
    assert plant.calls == ["shape a", "shape b", "begin", *["moved"] * 20, "close"]


@pytest.mark.parametrize("error", [SimulatorError("gone"), KeyboardInterrupt()])
def test_close_comes_however_the_run_ends(
    highway: RoadMap, error: BaseException, tmp_path: Any
) -> None:
    plant, trace = Failing(), tmp_path / "t.jsonl"
    plant.error = error
    with pytest.raises(type(error)):
        Run(scenario(lambda s: s.a.drive(duration=5.0)), highway, plant, trace=trace)
    assert plant.calls[-1] == "close"
    lines = [json.loads(line) for line in trace.read_text().splitlines()]
    assert [line["t"] for line in lines if line.get("actor") == "b"][-1] == 1.0
    assert lines[-1]["kind"] == "result"
    assert lines[-1]["status"] == "error"


def test_close_comes_if_the_scenario_cannot_start(highway: RoadMap) -> None:
    class Nowhere(TwoCars):
        def placement(self) -> None:
            self.place(self.a, lane(9), position(distance=50.0))

        def behavior(self) -> Behaviour:
            return self.a.drive(duration=1.0)

    plant = FollowingPlant()
    with pytest.raises(ScenarioError):
        Run(Nowhere, highway, plant)
    assert plant.calls[-1] == "close"
    assert "begin" not in plant.calls


def test_a_lost_simulator_has_its_own_exit_code() -> None:
    assert SimulatorError("gone").exit_code == 4


# --- what a plant measures beside -----------------------------------------------------------------


def test_notes_of_the_simulator_are_lines_of_the_trace(highway: RoadMap) -> None:
    class Bumping(FollowingPlant):
        def moved(self, scene: Any) -> Any:
            if scene.step == 3:
                scene.note("impact", actor="a", other="static.wall", impulse=12.5)
            return super().moved(scene)

    done = Run(scenario(lambda s: s.a.drive(duration=1.0)), highway, Bumping())
    (impact,) = [line for line in done.lines if line["kind"] == "impact"]
    assert impact == {
        **{"t": 0.2, "kind": "impact", "actor": "a", "other": "static.wall", "impulse": 12.5}
    }


def test_contacts_are_those_of_the_measured_boxes(highway: RoadMap) -> None:
    """The one in front is pushed back by nobody; the reference alone would pass it by."""

    class Stuck(FollowingPlant):
        def follow(self, actor: str, setpoint: Any, dt: float) -> Measurement:
            self.most = 2.0 if actor == "b" else math.inf
            return super().follow(actor, setpoint, dt)

    done = Run(scenario(lambda s: s.a.drive(duration=6.0)), highway, Stuck(lag=0.05))
    assert [(one, two) for _, one, two in done.result.collisions] == [("a", "b")]
    assert not Run(
        scenario(lambda s: s.a.drive(duration=6.0)), highway, FollowingPlant()
    ).result.collisions


class Kind(FollowingPlant):
    """Measures turning and acceleration as well."""

    def measurement(self, pose: Any, speed: float) -> Measurement:
        return Measurement(pose, (speed, 0.2, 0.0), (1.5, -0.5, 0.25), (0.01, 0.02, 0.03))


def test_the_motion_is_what_the_simulator_says(highway: RoadMap, make_spec: Spec) -> None:
    world = driving(highway, make_spec, Kind())
    steps(world, 0.2)
    motion = world.motion("a")
    assert (motion.velocity.translational.x, motion.velocity.translational.y) == (15.0, 0.2)
    assert motion.velocity.angular == OrientationRate(0.01, 0.02, 0.03)
    assert motion.acceleration.translational == TranslationalAcceleration(1.5, -0.5, 0.25)
    assert world.state("a").a == 1.5


def test_without_that_noise_is_smoothed(highway: RoadMap, make_spec: Spec) -> None:
    """2 cm/s of noise, from step to step, are 0.8 m/s^2 of a difference."""
    noise = random.Random(1)

    class Noisy(FollowingPlant):
        def measurement(self, pose: Any, speed: float) -> Measurement:
            return Measurement(pose, (speed + noise.uniform(-0.02, 0.02), 0.0, 0.0))

    world = driving(highway, make_spec, Noisy())
    found = []
    for _ in range(200):
        world.step()
        found.append(world.state("a").a)
    assert max(map(abs, found)) < 0.35
    assert sum(found) / len(found) == pytest.approx(0.0, abs=0.02)


def test_signals_come_from_the_simulator_until_the_scenario_switches_one(
    load_map: Callable[[str], RoadMap], make_spec: Spec
) -> None:
    """What the simulator shows can be read; a light that was switched shows that alone."""

    class Lit(FollowingPlant):
        def moved(self, scene: Any) -> Any:
            for signal in ("101", "102"):
                lamps = scene.signals.lamps(signal)
                scene.signals.observe(signal, ("is_on",) + ("is_off",) * (len(lamps) - 1))
            return super().moved(scene)

    world = EmbeddedWorld(load_map("urban_crossing"), DT, Lit())
    world.begin()
    world.signals.show("102", 1, "is_on", self_made := object())
    world.step()
    assert world.signals.meaning("101") == "stop"
    assert world.signals.states("102")[0] == "is_off"
    assert world.signals.shown_by("102") is self_made
    assert set(world.signals.lit()) == {"101", "102"}


def test_trailers_follow_where_their_tow_was_measured(highway: RoadMap, make_spec: Spec) -> None:
    """The coupling stays closed, whatever the tow does; nobody drives the trailer itself."""

    class Watching(FollowingPlant):
        def moved(self, scene: Any) -> Any:
            assert scene.setpoints["t"].towed
            return super().moved(scene)

    world = EmbeddedWorld(highway, DT, Watching(gain=0.8, drift=0.2))
    world.add(make_spec("a"))
    world.add(replace(make_spec("t", "trailer"), lane_bound=False))
    world.place("a", LanePosition("1", -2, 100.0), 15.0)
    world.place("t", pose_behind(world.state("a"), world._specs["t"].shape), 15.0)
    world.attach("a", "t")
    world.begin()
    for _ in range(200):
        world.step()
        assert coupling_gap(world.state("a"), world.state("t")) < 1e-9
    assert world.state("t").v == pytest.approx(12.0, abs=0.1)


def test_on_ice_the_reference_asks_for_what_can_be(highway: RoadMap, make_spec: Spec) -> None:
    """0.1 g is all there is, also for a car that somebody measures."""
    world = driving(highway, make_spec, FollowingPlant(lag=0.05), v=10.0)
    world.set_environment({"rain_intensity": 1e-6, "temperature": 260.0})
    world.step()
    world.command("a", LONGITUDINAL, SpeedChange(20.0, "asap"))
    speeds = []
    for _ in range(60):
        world.step()
        speeds.append(world.reference("a").v)
    rates = [(b - a) / DT for a, b in pairwise(speeds)]
    assert max(rates) <= 0.1 * GRAVITY + 1e-9
    assert not world.progress("a", LONGITUDINAL).done


# --- what a world can do --------------------------------------------------------------------------


def test_what_a_world_lacks_is_said_at_once_with_all_lines(highway: RoadMap) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "",
            s.a.set_lights(mode="low_beam"),
            s.a.change_lane(num_of_lanes=1, side="left"),
            s.b.drive(lane(same_as=s.a), duration=1.0),
        )

    plant = FollowingPlant(features=frozenset({"map", "weather"}))
    with pytest.raises(CapabilityError) as caught:
        Run(scenario(body), highway, plant)
    said = caught.value.message.splitlines()
    assert said[0] == "the world following 1.0 cannot run this scenario:"
    assert [line.partition(": ")[2] for line in said[1:]] == [
        "a set_lights needs lights, which it does not have",
        "a change_lane needs lanes, which it does not have",
        "b drive with lane needs lanes, which it does not have",
    ]
    assert {line.partition(": ")[0] for line in said[1:]} == {"  two_cars.osc"}
    assert "begin" not in plant.calls


def test_who_is_driven_is_not_in_its_own_way(highway: RoadMap, make_spec: Spec) -> None:
    """The reference looks ahead from beside the actor, which is none of the others."""
    world = driving(highway, make_spec, FollowingPlant(gain=0.95))
    world.command("a", LONGITUDINAL, Careful(None))
    steps(world, 5.0)
    assert world.obstacle(world.reference("a")) is None
    assert world.reference("a").v == 15.0


def test_an_arrival_is_not_chased_in_its_last_second(highway: RoadMap, make_spec: Spec) -> None:
    """Corrections in proportion to 1 / time left would end in full brake or throttle."""
    world = driving(highway, make_spec, FollowingPlant(lag=0.2))
    world.command("a", LONGITUDINAL, Arrive(4.0, way=70.0, speed=20.0))
    rates = []
    while not world.progress("a", LONGITUDINAL).done:
        before = world.reference("a").v
        world.step()
        rates.append((world.reference("a").v - before) / DT)
        assert world.progress("a", LONGITUDINAL).failed is None
    assert len(rates) == pytest.approx(80, abs=8)
    assert max(abs(b - a) for a, b in pairwise(rates[60:80])) < 0.5
    assert world.state("a").s == pytest.approx(170.0 + 20.0 * (len(rates) - 80) * DT, abs=0.8)

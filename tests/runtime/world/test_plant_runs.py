"""Runs with a plant beside those without: order, traces, how they begin, end and are refused."""

from __future__ import annotations

import json
from itertools import pairwise
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Parallel,
    RunSettings,
    Serial,
    run_scenario,
)
from osc2tx_runtime.errors import CapabilityError, ScenarioError, SimulatorError
from osc2tx_runtime.modifiers import lane, position
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.world.commands import Arrive, Careful
from osc2tx_runtime.world.protocol import LONGITUDINAL
from tests.runtime.world.following_plant import FollowingPlant
from tests.runtime.world.plant_runs import DT, Run, Spec, driving, steps
from tests.runtime.world.two_cars import TwoCars, scenario

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
    head = "the world following 1.0 cannot run this scenario: "
    said = caught.value.message.removeprefix(head).split("; ")
    assert [line.partition(": ")[2] for line in said] == [
        "a set_lights needs lights, which it does not have",
        "a change_lane needs lanes, which it does not have",
        "b drive with lane needs lanes, which it does not have",
    ]
    assert {line.partition(": ")[0] for line in said} == {"two_cars.osc"}
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

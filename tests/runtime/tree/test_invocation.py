"""Scenarios that invoke scenarios."""

from __future__ import annotations

import json
from typing import Any

import pytest

from osc2tx_runtime.domain.actors import Environment, Map, Vehicle
from osc2tx_runtime.domain.scenario import Scenario
from osc2tx_runtime.errors import ScenarioError, SettingsError, UnsupportedError
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.tree import (
    Behaviour,
    Emit,
    Event,
    On,
    OneOf,
    Parallel,
    Serial,
    Until,
    Wait,
    elapsed,
    rise,
)
from osc2tx_runtime.language.values.parameters import within
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.running.runner import run_scenario
from tests.traces import whatever_the_order


class Approach(Scenario):
    name, source = "approach", "approach.osc"

    def declare(self) -> None:
        self.actor = self.cast("actor", Vehicle())
        self.road = self.cast("road", Map())
        self.lead = self.cast("lead", Vehicle())
        self.gap = self.parameter("gap", within(10.0, 30.0))
        self.v = self.parameter("v", 20.0)
        self.near = Event()
        self.closest = self.sample(lambda: self.gap, self.near, 0.0)

    def behavior(self) -> Behaviour:
        return Serial(
            "close_in",
            Until(
                self.actor.drive("drive", speed(self.v)),
                rise(lambda: self.distance() < self.gap),
            ),
            Emit(self.near),
            Wait("hold", elapsed(0.5)),
        )

    def distance(self) -> float:
        found: float = self.actor.object_distance(reference=self.lead, direction="longitudinal")
        return found


class Top(Scenario):
    name, source = "top", "top.osc"
    turned = False

    def declare(self) -> None:
        self.road = Map(map_file="highway.xodr")
        self.env = Environment()
        self.ego = Vehicle()
        self.car1 = Vehicle()
        self.seen = Event()

    def placement(self) -> None:
        self.place(self.car1, lane(2), position(200.0), speed(10.0))
        self.place(self.ego, lane(2), position(50.0, behind=self.car1), speed(20.0))

    def behavior(self) -> Behaviour:
        members = [
            self.invoke("p1", Approach, actor=self.ego, lead=self.car1, gap=30.0),
            Serial("waits", Wait(self.event("p1.near")), Emit(self.seen)),
            Serial("ends", Wait(self.ended("p1")), Wait(elapsed(0.1))),
            Serial("inner", Wait(self.event("p1.hold.start")), Wait(elapsed(0.1))),
            self.car1.drive(speed(10.0)),
        ]
        return Parallel("top", *(reversed(members) if self.turned else members))


def lines(result: Any, kind: str) -> list[Any]:
    return [line for line in map(json.loads, result.trace_lines) if line["kind"] == kind]


def test_an_invoked_scenario_runs_with_what_it_is_given() -> None:
    result = run_scenario(Top)
    assert result.status == "success", result.reason
    times = {line["name"]: line["t"] for line in lines(result, "event")}
    # 50 m, closing at 10 m/s: below 30 m from 2.05 s on.
    assert times == {
        "p1.near": 2.05,
        "seen": 2.05,
        "p1.hold.start": 2.05,
        "p1.end": 2.55,
    }
    assert result.steps == 53
    header = json.loads(result.trace_lines[0])
    assert header["parameters"] == {"p1.gap": 30.0, "p1.v": 20.0}
    assert list(header["actors"]) == ["ego", "car1"]
    assert [line["name"] for line in lines(result, "variable")] == ["p1.closest"]


def test_the_order_of_the_members_changes_nothing() -> None:
    class Turned(Top):
        turned = True

    one, other = (whatever_the_order(run_scenario(each).trace_lines) for each in (Turned, Top))
    assert one == other


def test_settings_reach_invoked_scenarios_by_path() -> None:
    class Free(Top):
        def behavior(self) -> Behaviour:
            return Serial("free", self.invoke("p1", Approach, actor=self.ego, lead=self.car1))

    result = run_scenario(Free, RunSettings(set={"p1.gap": 30.0}))
    assert result.steps == 51
    with pytest.raises(SettingsError, match=r"--set p1.gap=50: the scenario allows 10 to 30"):
        Free(RunSettings(set={"p1.gap": 50.0})).create_tree()
    with pytest.raises(SettingsError, match=r"no such parameter; did you mean p1.gap"):
        Free(RunSettings(set={"p1.gp": 50.0})).create_tree()
    done = run_scenario(Free, RunSettings(signal={"p1.near": 0.5}))
    assert {"t": 0.5, "kind": "event", "name": "p1.near"} in lines(done, "event")


class Twice(Top):
    def behavior(self) -> Behaviour:
        one = self.invoke(Approach, actor=self.ego, lead=self.car1)
        two = self.invoke(Approach, actor=self.car1, lead=self.ego)
        three = self.invoke(Approach, actor=self.ego, lead=self.car1, gap=within(11.0, 12.0))
        return Parallel("twice", one, two, three)


class TwiceTurned(Twice):
    def behavior(self) -> Behaviour:
        two = self.invoke(Approach, actor=self.car1, lead=self.ego)
        three = self.invoke(Approach, actor=self.ego, lead=self.car1, gap=within(11.0, 12.0))
        return Parallel("twice", two, three, self.invoke(Approach, actor=self.ego, lead=self.car1))


def test_parameters_are_drawn_by_path_not_by_order() -> None:
    drawn = []
    for scenario in (Twice(), TwiceTurned()):
        scenario.create_tree()
        parameters = scenario.parameters
        assert list(parameters) == [
            f"approach{n}.{name}" for n in ("", "_2", "_3") for name in ("gap", "v")
        ]
        drawn.append([parameters[f"approach{n}.gap"] for n in ("", "_2", "_3")])
    (a, b, c), turned = drawn
    assert turned == [b, c, a]
    assert len({a, b, c}) == 3 and 11.0 <= c <= 12.0
    other = Twice(RunSettings(seed=1))
    other.create_tree()
    assert other.parameters["approach.gap"] != a


def test_a_tree_can_be_made_again() -> None:
    scenario = Twice()
    first = [node.name for node in scenario.create_tree().iterate()]
    assert [node.name for node in scenario.create_tree().iterate()] == first
    assert list(scenario.parameters)[-1] == "approach_3.v"


class Own(Scenario):
    """Brings a car of its own."""

    name, source = "own", "own.osc"

    def declare(self) -> None:
        self.other = self.cast("other", Vehicle())
        self.env = self.cast("env", Environment())
        self.limit = self.global_parameter("limit", within(1.0, 2.0))

    def placement(self) -> None:
        self.place(self.other, lane(1), position(20.0))

    def behavior(self) -> Behaviour:
        return Serial("own", self.other.drive(speed(5.0), duration=0.2))


def test_own_actors_and_placements_of_an_invoked_scenario() -> None:
    class Uses(Top):
        def behavior(self) -> Behaviour:
            self.limit = self.global_parameter("limit", within(1.0, 2.0))
            return Serial(
                "uses",
                Emit(self.seen),
                Parallel("both", OneOf("one", self.invoke("x", Own)), self.ego.drive()),
            )

    result = run_scenario(Uses, RunSettings(set={"limit": 1.5}))
    assert result.status == "success", result.reason
    header = json.loads(result.trace_lines[0])
    assert list(header["actors"]) == ["ego", "car1", "x.other"]
    assert header["parameters"] == {"limit": 1.5}
    state = next(x for x in lines(result, "state") if x["actor"] == "x.other")
    assert (state["s"], state["lane"]) == (20.0, -4)


def later(top: type[Scenario], own: type[Scenario], waits: bool) -> type[Scenario]:
    """Return a scenario that invokes another one later: after 0.1 s, or 0.05 s."""

    class Late(top):  # type: ignore[misc, valid-type]
        def behavior(self) -> Behaviour:
            invoked = self.invoke("x", own)
            if waits:
                return Serial("late", Wait(elapsed(0.1)), invoked)
            return Parallel("late", Wait(elapsed(0.1)), invoked, overlap="any", start_to_start=0.05)

    return Late


@pytest.mark.parametrize(("waits", "begins"), [(True, 0.1), (False, 0.05)])
def test_a_placement_after_the_start_holds_by_then(waits: bool, begins: float) -> None:
    """Its actor enters: it is where the invoked scenario places it when that starts."""
    result = run_scenario(later(Top, Own, waits))
    assert result.status == "success", result.reason
    states = [x for x in lines(result, "state") if x["actor"] == "x.other"]
    (there,) = (x for x in states if x["t"] == begins)
    assert (there["s"], there["lane"]) == (20.0, -4)


def test_a_placement_after_the_start_needs_an_action() -> None:
    class Idle(Own):
        def behavior(self) -> Behaviour:
            return Serial("idle", Wait(elapsed(0.1)), self.other.drive(speed(5.0), duration=0.2))

    with pytest.raises(UnsupportedError) as caught:
        run_scenario(later(Top, Idle, True))
    assert str(caught.value) == (
        "own.osc: x places x.other, but does not start with the scenario; let an action of x.other"
        " state it"
    )


def test_wrong_invocations() -> None:
    def invoking(**arguments: Any) -> type[Scenario]:
        class Wrong(Top):
            def behavior(self) -> Behaviour:
                given = {k: getattr(self, v) if v == "env" else v for k, v in arguments.items()}
                return Serial("wrong", self.invoke("p1", Approach, **given))

        return Wrong

    for arguments, message in [
        ({"gpa": 1.0}, r"p1: scenario approach has no parameter gpa; did you mean gap\?"),
        ({"lead": "env"}, "p1: lead must be a vehicle, not environment"),
        ({"gap": 50.0}, "p1.gap=50: the scenario allows 10 to 30"),
    ]:
        with pytest.raises(ScenarioError, match=message):
            invoking(**arguments)().create_tree()


class Ping(Scenario):
    name, source = "ping", "ping.osc"

    def behavior(self) -> Behaviour:
        return Serial("ping", self.invoke(Pong))


class Pong(Scenario):
    name, source = "pong", "ping.osc"

    def behavior(self) -> Behaviour:
        return Serial("pong", self.invoke(Ping))


def test_recursion_has_a_budget() -> None:
    result = run_scenario(Ping)
    assert result.status == "failure"
    assert "invokes itself more than 30 levels deep" in str(result.reason)


def test_duration_override_and_reading_values() -> None:
    class Limited(Top):
        def behavior(self) -> Behaviour:
            self.override("p1", "stop")
            p1 = self.invoke("p1", Approach, actor=self.ego, lead=self.car1, duration=(0, 9))
            return Parallel(
                "limited",
                p1,
                Serial(
                    "s",
                    Wait(lambda: self.invoked("p1").gap > 1.0),
                    Wait(elapsed(0.3)),
                    Wait("stop", elapsed(0.1)),
                ),
                On(self.event("p1.near"), Emit(self.seen)),
            )

    result = run_scenario(Limited)
    assert (result.status, result.steps) == ("success", 8)
    too_long = type(
        "TooLong",
        (Top,),
        {
            "behavior": lambda self: Serial(
                "s", self.invoke(Approach, actor=self.ego, lead=self.car1, duration=(0, 0.5))
            )
        },
    )
    result = run_scenario(too_long)
    assert result.reason == (
        "ego approach (top.osc) failed at 0.500 s: not finished within 0.5 s;"
        " still running: drive"
    )

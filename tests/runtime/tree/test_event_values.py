"""Events with parameters, and variables that are sampled at events."""

from __future__ import annotations

import json
from itertools import permutations
from typing import Any

import pytest

from osc2tx_runtime.domain.scenario import Scenario
from osc2tx_runtime.errors import ScenarioError, SettingsError
from osc2tx_runtime.language.tree import (
    Behaviour,
    Call,
    Emit,
    Event,
    On,
    Parallel,
    Serial,
    Wait,
    elapsed,
    every,
    rise,
)
from tests.runtime.tree.kit import Run, event


class Near(Event):
    gap: float
    limit: float
    kind: str


class Told(Event):
    gap: float


def near() -> Near:
    return Near(name="near", defaults={"limit": lambda: 3.0, "kind": "car"})


def events(run: Run) -> list[tuple[float, str, Any]]:
    lines = [json.loads(line) for line in run.lines]
    return [(x["t"], x["name"], x.get("arguments")) for x in lines if x["kind"] == "event"]


def test_defaults_are_evaluated_when_the_event_is_emitted() -> None:
    values = iter([1.0, 2.0])

    class Counted(Event):
        x: float
        y: int

    e = Counted(name="e", defaults={"x": lambda: next(values), "y": 5})
    run = Run(Serial("s", Emit(e), Emit(e, x=9.0), Wait(elapsed(0.1)), Emit(e, y=lambda: 6))).go()
    assert events(run) == [
        (0.0, "e", {"x": 1.0, "y": 5}),
        (0.0, "e", {"x": 9.0, "y": 5}),
        (0.1, "e", {"x": 2.0, "y": 6}),
    ]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({}, "event near needs gap"),
        ({"gap": 1.0, "gp": 2}, "event near has no parameter gp"),
        ({"gap": 1.0, "name": "x"}, "event near has no parameter name"),
    ],
)
def test_names_of_arguments_are_checked_before_the_run(given: Any, message: str) -> None:
    emit = Emit(near(), **given)
    emit.source = "x.osc:3"
    with pytest.raises(ScenarioError) as caught:
        Run(Serial("s", Wait(elapsed(9.0)), emit)).go()
    assert str(caught.value) == f"x.osc:3: {message}"


def test_a_signal_from_outside_cannot_give_arguments() -> None:
    e = near()
    with pytest.raises(SettingsError, match="--signal near: event near needs gap"):
        Run(Wait(e), events={"near": e}, signal={"near": 0.0}).go()


def test_conditions_read_the_values_of_the_occurrence() -> None:
    e, far = near(), event("far")
    tree = Parallel(
        "p",
        Serial("s", Wait(e, condition=lambda: e.gap > e.limit), Emit(far)),
        Serial("e", Emit(e, gap=2.0), Wait(elapsed(0.1)), Emit(e, gap=4.0), Wait(elapsed(0.1))),
    )
    assert events(Run(tree).go())[1:] == [
        (0.1, "far", None),
        (0.1, "near", {"gap": 4.0, "kind": "car", "limit": 3.0}),
    ]


@pytest.mark.parametrize("order", list(permutations(range(4))))
def test_on_reacts_to_each_event_of_an_instant_with_its_values(order: Any) -> None:
    e, told = near(), Told(name="told")
    heard: list[float] = []
    members = [
        On(e, Call(lambda: heard.append(e.gap)), Emit(told, gap=lambda: e.gap)),
        Parallel("emits", Emit(e, gap=2.0), Emit(e, gap=1.0), Emit(e, gap=2.0)),
        On(e, Emit(event("big")), condition=lambda: e.gap > 1.5),
        Wait(e, condition=lambda: e.gap > 5.0),  # looks at the same occurrences meanwhile
    ]
    run = Run(Parallel("p", *(members[i] for i in order)), max_time=0.2).go()
    assert heard == [1.0, 2.0]
    assert [(n, a["gap"]) for _, n, a in events(run) if n == "told"] == [("told", 1), ("told", 2)]
    assert sum(name == "big" for _, name, _ in events(run)) == 1


def test_a_value_is_there_only_at_an_occurrence() -> None:
    e = near()
    with pytest.raises(ScenarioError, match="event near has no value gap here"):
        e.gap  # noqa: B018
    with pytest.raises(AttributeError, match="event near has no parameter gp"):
        e.gp  # type: ignore[attr-defined]  # noqa: B018


def test_parameters_may_have_names_of_the_class_and_of_python() -> None:
    class Odd(Event):
        name_: str
        from_: float
        condition__: float
        size_: float

    e, seen = Odd(name="odd"), list[tuple[str, float]]()
    tree = Parallel(
        "p",
        On(e, Call(lambda: seen.append((e.name_, e.from_)))),
        Serial("s", Emit(e, name_="x", from_=1.0, condition__=2.0, size_=3.0), Wait(elapsed(0.1))),
    )
    arguments = {"name": "x", "from": 1.0, "condition_": 2.0, "size_": 3.0}
    assert events(Run(tree, max_time=0.2).go()) == [(0.0, "odd", arguments)]
    assert seen == [("x", 1.0)]


class Sampling(Scenario):
    name, source = "sampling", "sampling.osc"

    class Valued(Event):
        v: float

    def declare(self) -> None:
        self.world: Any = None
        self.e = self.Valued()
        self.x = self.sample(lambda: self.e.v, self.e, 0.0)
        self.y = self.sample(lambda: self.x + 1.0, self.e, self.x)
        self.count = self.sample(lambda: self.count + 1, every(0.1), 0)
        self.none = self.sample(lambda: 1.0, self.e, condition=lambda: self.e.v > 100)

    order = (0, 1, 2)

    def behavior(self) -> Behaviour:
        members = [
            Serial("emits", Wait(elapsed(0.2)), Emit(self.e, v=5.0), Wait(elapsed(0.1))),
            Serial("sees", Wait(lambda: self.x == 5.0), Emit(event("seen"))),
            Serial("edge", Wait(rise(lambda: self.y > 0.5)), Emit(event("rose"))),
        ]
        return Parallel("sampling", *(members[i] for i in self.order))


def run_scenario(scenario: Scenario) -> Run:
    tree = scenario.create_tree()
    return Run(tree, label_events=scenario.label_events, events=scenario.events).go()


@pytest.mark.parametrize("order", list(permutations(range(3))))
def test_a_sample_is_seen_from_the_next_pass_on(order: Any) -> None:
    scenario = Sampling()
    scenario.order = order
    assert (scenario.x, scenario.y, scenario.count) == (0.0, 0.0, 0)
    run = run_scenario(scenario)
    # Within the instant of the event; y is sampled from the x before the event.
    assert events(run) == [(0.2, "e", {"v": 5.0}), (0.2, "rose", None), (0.2, "seen", None)]
    assert (scenario.x, scenario.y) == (5.0, 1.0)
    values = [json.loads(line) for line in run.lines if '"variable"' in line]
    assert [(v["t"], v["name"], v["value"]) for v in values if v["name"] != "count"] == [
        (0.2, "x", 5.0),
        (0.2, "y", 1.0),
    ]
    assert [v["t"] for v in values if v["name"] == "count"] == [0.0, 0.1, 0.2, 0.3]


def test_the_context_of_a_sample_starts_with_its_scenario() -> None:
    class Late(Sampling):
        def declare(self) -> None:
            self.z = self.sample(lambda: 1.0, elapsed(0.25), 0.0)
            self.go = Event()

        def behavior(self) -> Behaviour:
            return Serial("late", Wait(elapsed(0.2)), Wait(lambda: self.z > 0.5))

    assert run_scenario(Late()).outcome.steps == 5


def test_a_variable_without_value_says_so() -> None:
    class Early(Sampling):
        def behavior(self) -> Behaviour:
            return Serial("early", Wait(lambda: self.none > 0))

    with pytest.raises(ScenarioError, match=r"sampling.osc: none is read before it is sampled"):
        run_scenario(Early())


def test_unknown_attributes_are_errors() -> None:
    with pytest.raises(AttributeError, match="Sampling has no attribute 'w'"):
        Sampling().w  # type: ignore[attr-defined]  # noqa: B018

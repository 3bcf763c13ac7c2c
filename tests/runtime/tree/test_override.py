"""The modifier override: who ends whom, who is skipped."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime.domain.scenario import Scenario
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.tree import Behaviour, Event, Parallel, Serial, Wait, elapsed
from osc2tx_runtime.language.tree.override import Mode
from tests.runtime.tree.kit import Drive, FakeActor, Run

HERO: Any = FakeActor("hero")


def scenario(
    make: Callable[[], Behaviour], *overrides: tuple[str, str, Mode]
) -> tuple[Scenario, Run]:
    class Made(Scenario):
        name, source = "made", "made.osc"

        def behavior(self) -> Behaviour:
            for one in overrides:
                self.override(*one)
            return make()

    found = Made()
    tree = found.create_tree()
    return found, Run(tree, ids=("hero",), label_events=found.label_events)


def lines(run: Run, kind: str) -> list[Any]:
    return [x for x in map(json.loads, run.lines) if x["kind"] == kind]


@pytest.mark.parametrize("swap", [False, True])
@pytest.mark.parametrize("mode", ["on_start", "when_active"])
def test_the_overriding_behavior_ends_the_other_and_takes_its_slot(mode: Mode, swap: bool) -> None:
    def make() -> Behaviour:
        cruise = Serial("first", Drive(HERO, 10.0, label="cruise"), Wait(elapsed(0.5)))
        evade = Serial("then", Wait(elapsed(0.2)), Drive(HERO, 5.0, duration=0.3, label="evade"))
        return Parallel("p", *((evade, cruise) if swap else (cruise, evade)))

    _, run = scenario(make, ("cruise", "evade", mode))
    run.go()
    assert (run.outcome.status, run.outcome.steps) == ("success", 14)  # 0.2 + 0.5 s
    assert run.world.commands == [
        (0, "hero", "longitudinal", 10.0),
        (4, "hero", "longitudinal", 5.0),
        (10, "hero", "longitudinal", None),
    ]
    assert lines(run, "override") == [
        {"t": 0.2, "kind": "override", "name": "cruise", "what": "ended", "by": "evade"}
        | {"source": "made.osc"}
    ]


@pytest.mark.parametrize("swap", [False, True])
def test_when_active_also_keeps_it_from_starting(swap: bool) -> None:
    def make() -> Behaviour:
        evade = Drive(HERO, 5.0, duration=0.4, label="evade")
        late = Serial("late", Wait(elapsed(0.2)), Serial("cruise", Wait(elapsed(0.1))))
        after = Serial("after", Wait(elapsed(0.4)), Serial("again", Wait(elapsed(0.1))))
        members: list[Behaviour] = [evade, late, after]
        return Parallel("p", *(reversed(members) if swap else members))

    rules: list[tuple[str, str, Mode]] = [
        ("cruise", "evade", "when_active"),
        ("again", "evade", "when_active"),
    ]
    _, run = scenario(make, *rules)
    run.go()
    # `again` would start in the pass in which evade ends, which only shows in the next pass.
    found = [(line["t"], line["name"], line["what"]) for line in lines(run, "override")]
    assert found == [(0.2, "cruise", "skipped"), (0.4, "again", "skipped")]
    assert run.outcome.steps == 8


def test_both_starting_at_once_the_overriding_one_stays() -> None:
    def make() -> Behaviour:
        return Parallel(
            "p", Drive(HERO, 10.0, label="a"), Drive(HERO, 5.0, duration=0.1, label="b")
        )

    _, run = scenario(make, ("a", "b", "when_active"))
    run.go()
    assert run.world.commands[0] == (0, "hero", "longitudinal", 5.0)
    assert run.outcome.status == "success"


def test_labels_wait_for_the_overridden_behavior() -> None:
    class Made(Scenario):
        name, source = "made", "made.osc"

        def declare(self) -> None:
            self.go = Event()

        def behavior(self) -> Behaviour:
            self.override("whole", "b")
            return Parallel(
                "p",
                Serial("whole", Wait(elapsed(0.1)), Drive(HERO)),
                Serial("s", Wait(elapsed(0.3)), Serial("b", Wait(elapsed(0.1)))),
                Serial("w", Wait(self.ended("whole")), Wait(elapsed(0.5))),
            )

    found = Made()
    tree = found.create_tree()
    run = Run(tree, ids=("hero",), label_events=found.label_events).go()
    assert (run.outcome.status, run.outcome.steps) == ("success", 16)
    ends = [(x["t"], x["status"], x.get("reason")) for x in lines(run, "action")]
    assert ends == [(0.1, "start", None), (0.3, "end", "stopped")]


def test_unknown_labels() -> None:
    def make() -> Behaviour:
        return Serial("top", Wait("cruise", elapsed(0.1)))

    with pytest.raises(ScenarioError, match=r"override: no node has the label cruse; .* cruise\?"):
        scenario(make, ("top", "cruse", "on_start"))
    with pytest.raises(ScenarioError, match="top cannot override itself"):
        scenario(make, ("top", "top", "on_start"))

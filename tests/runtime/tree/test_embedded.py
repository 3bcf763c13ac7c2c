"""The tree in the embedded world: two runs, permuted members, the examples of docs/trace.md."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from pathlib import Path

import pytest

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Environment,
    Event,
    Map,
    OneOf,
    Parallel,
    RunSettings,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    elapsed,
    rise,
    run_scenario,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.world.state import ActorState
from tests.traces import whatever_the_order

DOCUMENT = Path(__file__).parents[3] / "docs/trace.md"


class Near(Event):
    gap: float


class Overtake(Scenario):
    name = "overtake"
    source = "overtake.osc"
    reverse = False

    def declare(self) -> None:
        self.road = Map(map_file="highway.xodr")
        self.env = Environment()
        self.ego = Vehicle()
        self.npc = Vehicle()
        self.gap = self.parameter("gap", 15.0)
        self.near = Near()

    def placement(self) -> None:
        self.place(self.ego, lane(2), position(distance=50.0), speed(20.0))
        self.place(
            self.npc,
            lane(same_as=self.ego),
            position(distance=15.0, ahead_of=self.ego),
            speed(15.0),
        )

    def turn(self, *members: Behaviour) -> tuple[Behaviour, ...]:
        return members[::-1] if self.reverse else members

    def behavior(self) -> Behaviour:
        close = rise(lambda: self.npc.position.ahead_of(self.ego) < 10.0)
        return Serial(
            "overtake",
            self.env.rain(intensity=5.0e-7),
            Parallel(
                "both",
                *self.turn(
                    self.npc.drive(speed(15.0)),
                    Serial(
                        "evade",
                        OneOf("closing", *self.turn(Wait(self.near), self.ego.drive(speed(20.0)))),
                        Parallel(
                            "at once",
                            *self.turn(
                                self.ego.change_lane(num_of_lanes=1, side="left"),
                                self.ego.set_lights(mode="high_beam"),
                                self.ego.change_speed(target=25.0),
                            ),
                        ),
                    ),
                    Serial("watch", Wait(close), Emit(self.near, gap=lambda: 10.0)),
                ),
            ),
            OneOf("end", self.ego.drive(speed(25.0)), Wait(elapsed(1.0))),
        )


class Reversed(Overtake):
    reverse = True


def test_two_runs_and_permuted_members_give_the_same_bytes() -> None:
    first = run_scenario(Overtake)
    assert first.status == "success", first.reason
    assert run_scenario(Overtake).trace_lines == first.trace_lines
    permuted = run_scenario(Reversed).trace_lines
    assert whatever_the_order(permuted) == whatever_the_order(first.trace_lines)


@pytest.mark.parametrize("dt", [0.05, 0.01])
def test_the_step_length_does_not_change_what_happens(dt: float) -> None:
    result = run_scenario(Overtake, RunSettings(dt=dt))
    lines = [json.loads(line) for line in result.trace_lines]
    near = next(line for line in lines if line["kind"] == "event")
    assert near["t"] == pytest.approx(1.0, abs=0.051)  # 15 m, closing at 5 m/s
    assert near["arguments"] == {"gap": 10.0}


def test_the_document_shows_the_keys_of_a_run() -> None:
    text = DOCUMENT.read_text(encoding="utf-8")
    examples = [json.loads(line) for line in re.findall(r"^\{.*\}$", text, re.MULTILINE)]
    shown = {example["kind"]: list(example) for example in examples}
    for line in map(json.loads, run_scenario(Overtake).trace_lines):
        keys = shown[line["kind"]]
        assert list(line) == keys[: len(line)], line


def test_states_that_are_taken_are_those_of_the_trace() -> None:
    taken: list[tuple[float, str, ActorState]] = []

    def take(time: float, states: Iterable[tuple[str, ActorState]]) -> None:
        taken.extend((time, actor, state) for actor, state in states)

    rest = run_scenario(Overtake, on_states=take).trace_lines
    whole = [json.loads(line) for line in run_scenario(Overtake).trace_lines]
    assert list(map(json.loads, rest)) == [line for line in whole if line["kind"] != "state"]
    written = [line for line in whole if line["kind"] == "state"]
    assert [(round(time, 6), actor) for time, actor, _ in taken] == [
        (line["t"], line["actor"]) for line in written
    ]
    for (_, _, state), line in zip(taken, written, strict=True):
        numbers = [line[name] for name in ("x", "y", "v")]
        assert [state.x, state.y, state.v] == pytest.approx(numbers, abs=1e-6)

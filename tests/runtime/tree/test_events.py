"""Delta cycles: when an event is seen, by whom, and in which order."""

from __future__ import annotations

import json
from itertools import permutations
from typing import Any

import pytest

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.tree import (
    Behaviour,
    Call,
    Emit,
    Event,
    On,
    OneOf,
    Parallel,
    Serial,
    Status,
    Until,
    Wait,
    elapsed,
    every,
    fall,
    rise,
)
from osc2tx_runtime.language.tree.base import Leaf
from tests.runtime.tree.kit import Run, event


def times(run: Run) -> dict[str, float]:
    lines = [json.loads(line) for line in run.lines]
    return {line["name"]: line["t"] for line in lines if line["kind"] == "event"}


@pytest.mark.parametrize("wait_first", [True, False])
def test_wait_beside_emit_sees_it_in_the_same_step(wait_first: bool) -> None:
    a, seen = event("a"), event("seen")
    members: list[Behaviour] = [
        Serial("waits", Wait(a), Emit(seen)),
        Serial("emits", Wait(elapsed(0.5)), Emit(a)),
    ]
    run = Run(Parallel("p", *(members if wait_first else reversed(members)))).go()
    assert times(run) == {"a": 0.5, "seen": 0.5}
    assert run.outcome.steps == 10


def test_wait_after_emit_does_not_fire_on_the_old_event() -> None:
    a = event("a")
    run = Run(Serial("s", Emit(a), Wait(a)), max_time=1.0).go()
    assert run.outcome.status == "timeout"
    assert "wait @a" in run.outcome.reason


def test_second_wait_needs_a_second_occurrence() -> None:
    a, once, twice = event("a"), event("once"), event("twice")
    run = Run(
        Parallel(
            "p",
            Serial("waits", Wait(a), Emit(once), Wait(a), Emit(twice)),
            Serial("emits", Emit(a), Wait(elapsed(0.2)), Emit(a)),
        )
    ).go()
    assert times(run)["once"] == 0.0
    assert times(run)["twice"] == 0.2


def test_chain_of_events_takes_no_time() -> None:
    a, b, c = event("a"), event("b"), event("c")
    tree = Parallel(
        "p", Serial("3", Wait(b), Emit(c)), Serial("2", Wait(a), Emit(b)), Emit(a), Wait(c)
    )
    run = Run(tree).go()
    assert (run.outcome.status, run.outcome.steps) == ("success", 0)


@pytest.mark.parametrize("order", list(permutations(range(3))))
def test_a_race_between_chains_of_events_does_not_depend_on_the_order(order: Any) -> None:
    a, b, c, d, e = (event(name) for name in "abcde")
    race = OneOf("r", Serial("1", Wait(a), Emit(b), Emit(c)), Serial("2", Wait(d), Emit(e)))
    members = [race, Emit(a), Emit(d)]
    run = Run(Parallel("p", *(members[index] for index in order))).go()
    assert "".join(times(run)) == "abcde"


def test_two_emissions_at_one_instant_are_one_event_line() -> None:
    a = event("a")
    run = Run(Parallel("p", Emit(a), Emit(a), Wait(a))).go()
    assert sum('"event"' in line for line in run.lines) == 1


class PingPong(Leaf):
    """Answers an event with another for ever, each time with a number that was not there yet."""

    def __init__(self, mine: Event, other: Event) -> None:
        super().__init__("ping")
        self.mine, self.other, self.seen = mine, other, 0

    def initialise(self) -> None:
        self.context.post(self.mine)

    def update(self) -> Status:
        if self.other.occurred > self.seen:
            self.seen = self.other.occurred
            self.context.post(self.mine, {"number": self.seen})
        return Status.RUNNING


def test_events_that_chase_each_other_are_reported() -> None:
    a, b = event("a"), event("b")
    run = Run(Parallel("p", PingPong(a, b), PingPong(b, a)))
    with pytest.raises(ScenarioError, match=r"cause each other without end at 0.000 s: a, b"):
        run.go()
    assert all(node.status is not Status.RUNNING for node in run.root.iterate())


@pytest.mark.parametrize(
    ("at", "delay", "fires"),
    [
        (0.0, None, True),  # a wait of the very first pass sees a signal at 0 s
        (0.5, 0.45, True),
        (0.5, 0.5, False),  # started at that instant: not its event
        (0.47, 0.45, True),  # the first step at or after its time
    ],
)
def test_signal(at: float, delay: float | None, fires: bool) -> None:
    go = event("go")
    before = [] if delay is None else [Wait(elapsed(delay))]
    run = Run(
        Serial("s", *before, Wait(go)), events={"go": go}, signal={"go": at}, max_time=2.0
    ).go()
    assert (run.outcome.status == "success") is fires
    if fires:
        assert run.outcome.steps == (0 if at == 0.0 else 10)
    assert times(run)["go"] == (0.0 if at == 0.0 else 0.5)


def test_condition_on_an_occurrence_and_its_arguments() -> None:
    class Valued(Event):
        v: float

    a = Valued(name="a")
    seen: list[float] = []

    def big() -> bool:
        seen.append(a.v)
        return a.v > 2

    emits = Serial("emits", Emit(a, v=1), Wait(elapsed(0.1)), Emit(a, v=lambda: 3))
    run = Run(Parallel("p", Wait(a, condition=big), emits)).go()
    assert (run.outcome.status, run.outcome.steps) == ("success", 2)
    assert seen == [1, 3]
    assert '{"t":0.1,"kind":"event","name":"a","arguments":{"v":3}}' in run.lines


def test_event_with_a_specification_starts_where_it_is_used() -> None:
    run = Run(lambda: Wait(elapsed(0.1)))
    x = run.world.x
    run.world.ids, x["hero"], run.world.v["hero"] = ("hero",), 0.0, 10.0
    far = Event(rise(lambda: x["hero"] > 3.2))
    far.name = "far"
    run.root = Serial("s", Wait(far), Until(Wait(elapsed(0.4)), far))
    run.go()
    assert times(run) == {"far": 0.35}  # the second use starts beyond the edge and sees none
    assert run.outcome.steps == 7 + 8


def test_event_if_condition_in_until() -> None:
    a = event("a")
    allowed = {"now": False}
    tree = Parallel(
        "p",
        Until(Wait(elapsed(9.0)), Event(a, condition=lambda: allowed["now"])),
        Serial("e", Emit(a), Wait(elapsed(0.3)), Emit(a)),
        Serial("flip", Wait(elapsed(0.2)), Wait(lambda: bool(allowed.update(now=True)) or True)),
    )
    run = Run(tree).go()
    assert (run.outcome.status, run.outcome.steps) == ("success", 6)


def test_rise_and_fall_take_their_first_sample_at_the_start() -> None:
    state = {"k": 0}
    run = Run(lambda: Wait(elapsed(0.1)))
    world = run.world

    def late() -> bool:
        return 4 <= world.k < 8

    up, down = event("up"), event("down")
    run.root = Parallel(
        "p",
        Serial("u", Wait(rise(late)), Emit(up)),
        Serial("d", Wait(fall(late)), Emit(down)),
        Serial("no edge", Wait(elapsed(0.25)), OneOf("x", Wait(rise(late)), Wait(elapsed(1.0)))),
    )
    run.go()
    assert times(run) == {"up": 0.2, "down": 0.4}
    assert run.outcome.steps == 25
    assert state == {"k": 0}


def test_labels_post_life_events_only_to_listeners() -> None:
    ended = event("cut.end")
    started = event("cut.start")
    listeners = {("cut", "end"): ended, ("cut", "start"): started}
    tree = Parallel(
        "p",
        Wait(ended),
        Serial("later", Wait(elapsed(0.1)), Serial("cut", Wait(elapsed(0.2)))),
        Wait("unheard", elapsed(0.1)),
    )
    run = Run(tree, label_events=listeners).go()
    assert times(run) == {"cut.start": 0.1, "cut.end": 0.3}
    assert run.outcome.steps == 6


def test_division_by_zero_in_a_condition_names_the_node() -> None:
    wait = Wait(lambda: 1 / 0 > 1)
    wait.source = "x.osc:7"
    run = Run(Parallel("p", wait, Wait(elapsed(1.0))))
    with pytest.raises(ScenarioError) as caught:
        run.go()
    assert str(caught.value) == (
        "x.osc:7: the condition has no value: division by zero (at 0.000 s)"
    )
    assert run.lines[-1].startswith('{"kind":"result","status":"error","reason":"x.osc:7:')


def all_events(run: Run) -> list[tuple[float, str]]:
    lines = [json.loads(line) for line in run.lines]
    return [(line["t"], line["name"]) for line in lines if line["kind"] == "event"]


@pytest.mark.parametrize("on_first", [True, False])
def test_on_reacts_to_every_occurrence_and_ends_with_its_surroundings(on_first: bool) -> None:
    a, b, c = event("a"), event("b"), event("c")
    calls: list[str] = []
    on = On(a, Call(lambda: calls.append("x")), Emit(b))
    emits = Serial("e", Emit(a), Wait(elapsed(0.1)), Emit(a), Emit(a), Wait(elapsed(0.1)))
    chain = On(b, Emit(c))
    run = Run(Parallel("p", *((on, chain, emits) if on_first else (emits, chain, on)))).go()
    assert (run.outcome.status, run.outcome.steps) == ("success", 4)
    assert all_events(run) == [(t, name) for t in (0.0, 0.1) for name in "abc"]
    assert calls == ["x", "x"]


def test_on_its_own_event_does_not_react_for_ever() -> None:
    a = event("a")
    run = Run(Parallel("p", On(a, Emit(a)), Serial("e", Emit(a), Wait(elapsed(0.3))))).go()
    assert all_events(run) == [(0.0, "a")]


def test_on_conditions() -> None:
    tick, far = event("tick"), event("far")
    run = Run(lambda: Wait(elapsed(0.1)), ids=("hero",))
    world = run.world
    world.v["hero"] = 10.0
    run.root = Parallel(
        "p",
        On(every(0.1), Emit(tick)),
        On(rise(lambda: world.x["hero"] > 1.2), Emit(far)),
        Wait(elapsed(0.25)),
    )
    run.go()
    assert all_events(run) == [(0.0, "tick"), (0.1, "tick"), (0.15, "far"), (0.2, "tick")]

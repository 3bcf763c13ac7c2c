"""Whatever fails: the verdict and the trace name the node, its place, the time and the reason."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest
from py_trees.behaviours import Failure

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
    fall,
    rise,
)
from osc2tx_runtime.language.tree.base import Leaf
from osc2tx_runtime.language.tree.override import guard
from osc2tx_runtime.language.tree.variables import Sampled, Sampling
from tests.runtime.tree.kit import Drive, FakeActor, Run, Task, event

HERO: Any = FakeActor("hero")
NPC: Any = FakeActor("npc")


class Quiet(Leaf):
    def update(self) -> Status:
        return Status.FAILURE


def numbered(root: Behaviour) -> Behaviour:
    """Give every node a line, in pre-order from 1."""
    nodes = [root]
    number = 0
    while nodes:
        node = nodes.pop(0)
        number += 1
        if hasattr(node, "source"):
            node.source = f"x.osc:{number}"
        nodes = [*node.children, *nodes]
    return root


def after(seconds: float, node: Behaviour) -> Behaviour:
    return Serial("s", Wait(elapsed(seconds)), node)


def guarded() -> Behaviour:
    task = Task(HERO, 2, fails=True)
    whole = Parallel("p", Serial("s", task), Serial("b", Wait(elapsed(9.0)), name_of := Quiet("q")))
    guard(task).add(name_of, "on_start")
    return whole


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (
            lambda: after(0.1, Task(HERO, 2, fails=True)),
            "hero task (x.osc:3) failed at 0.200 s: gave up",
        ),
        (
            lambda: Task(HERO, 20, duration=0.3),
            "hero task (x.osc:1) failed at 0.300 s: not finished within 0.3 s",
        ),
        (
            lambda: after(0.1, Quiet("quiet")),
            "quiet (x.osc:3) failed at 0.100 s: no reason is given",
        ),
        (
            lambda: after(0.1, Failure("foreign")),
            "foreign failed at 0.100 s: failure",
        ),
        (
            lambda: Serial("s", Wait(event("a")), Drive(HERO), duration=(0.0, 0.5)),
            "s (x.osc:1) failed at 0.500 s: not finished within 0.5 s; still running: wait @a",
        ),
        (
            lambda: Serial("s", Wait(event("a")), Wait(elapsed(1.0)), duration=(0.0, 0.5)),
            "s (x.osc:1) failed at 0.500 s: not finished within 0.5 s; still running: wait @a",
        ),
        (
            lambda: OneOf("o", Task(HERO, 2, fails=True), Task(NPC, 4, fails=True)),
            "hero task (x.osc:2) failed at 0.100 s: gave up;"
            " npc task (x.osc:3) failed at 0.200 s: gave up",
        ),
        (
            lambda: Parallel("p", Task(HERO, 2, fails=True), Task(NPC, 2, fails=True)),
            "hero task (x.osc:2) failed at 0.100 s: gave up;"
            " npc task (x.osc:3) failed at 0.100 s: gave up",
        ),
        (
            lambda: Parallel("p", Task(HERO, 2), Wait(event("a")), overlap="equal"),
            "p (x.osc:1) failed at 0.100 s: overlap equal:"
            " wait @a still runs when hero task has ended",
        ),
        (
            lambda: Until(Task(HERO, 2, fails=True), event("a")),
            "hero task (x.osc:2) failed at 0.100 s: gave up",
        ),
        (
            lambda: Parallel("p", On(elapsed(0.1), Quiet("reaction")), Wait(elapsed(1.0))),
            "reaction (x.osc:3) failed at 0.100 s: no reason is given",
        ),
        (guarded, "hero task (x.osc:4) failed at 0.100 s: gave up"),
    ],
)
def test_failures(make: Callable[[], Behaviour], reason: str) -> None:
    run = Run(numbered(make()), ids=("hero", "npc"), max_time=2.0).go()
    last = json.loads(run.lines[-1])
    assert (last["status"], last["reason"]) == ("failure", reason)
    assert all(node.status is not Status.RUNNING for node in run.root.iterate())


def broken() -> bool:
    return 1 / 0 > 1


def no_such_name() -> None:
    raise KeyError("x")


class Valued(Event):
    x: float


def sampled() -> Behaviour:
    variable = Sampled(broken, elapsed(0.1), 0)
    variable.name = "v"
    return Parallel("p", Sampling([variable], Wait(elapsed(1.0))), Wait(elapsed(1.0)))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Wait(broken), "x.osc:1: the condition has no value: division by zero"),
        (lambda: Wait(rise(broken)), "x.osc:1: the condition has no value: division by zero"),
        (
            lambda: Until(Drive(HERO), fall(broken)),
            "x.osc:1: the condition has no value: division by zero",
        ),
        (
            lambda: Parallel(
                "p",
                Wait(elapsed(1.0)),
                On(
                    broken,
                ),
            ),
            "x.osc:3: the condition has no value: division by zero",
        ),
        (
            lambda: Serial("s", Emit(Valued(name="a"), x=broken)),
            "x.osc:2: an argument of emit a has no value: division by zero",
        ),
        (lambda: Call(no_such_name), "x.osc:1: call no_such_name: KeyError: 'x'"),
        (sampled, "x.osc:2: v has no value: division by zero"),
    ],
)
def test_what_cannot_go_on_names_its_place(make: Callable[[], Behaviour], message: str) -> None:
    message += " (at 0.100 s)" if make is sampled else " (at 0.000 s)"
    run = Run(numbered(make()), ids=("hero",), max_time=2.0)
    with pytest.raises(ScenarioError) as caught:
        run.go()
    assert str(caught.value) == message
    last = json.loads(run.lines[-1])
    assert (last["status"], last["reason"]) == ("error", message)
    assert all(node.status is not Status.RUNNING for node in run.root.iterate())


def test_the_trace_of_a_failing_run_says_why_actions_ended() -> None:
    tree = Parallel("p", Task(HERO, 2, fails=True), Drive(NPC))
    run = Run(numbered(tree), ids=("hero", "npc")).go()
    ends = [
        json.loads(line)
        for line in run.lines
        if line.startswith('{"t"') and '"action"' in line and '"start"' not in line
    ]
    assert [(x["t"], x["status"], x["name"], x["source"], x["reason"]) for x in ends] == [
        (0.1, "fail", "hero task", "x.osc:2", "gave up"),
        (0.1, "end", "npc drive", "x.osc:3", "stopped"),
    ]

"""What ends a composition, and with which result."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import py_trees
import pytest

from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.language.tree import (
    Behaviour,
    Call,
    Emit,
    OneOf,
    Parallel,
    Serial,
    Status,
    Until,
    Wait,
    elapsed,
    every,
)
from tests.runtime.tree.kit import Drive, FakeActor, Run, Switch, Task, event

HERO: Any = FakeActor("hero")
NPC: Any = FakeActor("npc")
IDS = ("hero", "npc")


def run(tree: Behaviour, **options: Any) -> Run:
    return Run(tree, ids=IDS, **options).go()


@pytest.mark.parametrize("dt", [0.05, 0.01, 0.03])
@pytest.mark.parametrize("seconds", [0.0, 0.1, 5.0, 0.3])
def test_elapsed_ends_at_the_first_step_at_or_after_its_time(seconds: float, dt: float) -> None:
    done = run(Wait(elapsed(seconds)), dt=dt)
    least = Fraction(str(seconds)) / Fraction(str(dt))
    assert done.outcome.steps == math.ceil(least)


def test_serial_elapsed_adds_up_without_gaps() -> None:
    done = run(Serial("s", *(Wait(elapsed(0.1)) for _ in range(30))))
    assert done.outcome.steps == 60


@pytest.mark.parametrize(
    ("period", "offset", "first"), [(0.2, 0.0, 0), (0.2, 0.1, 2), (0.01, 0.02, 1)]
)
def test_every_first_hit(period: float, offset: float, first: int) -> None:
    assert run(Wait(every(period, offset=offset))).outcome.steps == first


def test_parallel_ends_with_the_last_bounded_member() -> None:
    drive = Drive(HERO)
    done = run(Parallel("p", drive, Task(NPC, 4), Task(NPC, 7)))
    assert (done.outcome.status, done.outcome.steps) == ("success", 7)
    assert drive.status is Status.SUCCESS
    ended = '"status":"end","name":"hero drive","actor":"hero","source":""}'
    assert [line for line in done.lines if line.endswith(ended)] == [
        '{"t":0.35,"kind":"action",' + ended
    ]


def test_parallel_of_open_members_runs_on() -> None:
    done = run(Parallel("p", Drive(HERO), Drive(NPC)), max_time=0.5)
    assert done.outcome.status == "timeout"
    assert done.outcome.reason == "not finished at 0.5 s; still running: hero drive, npc drive"


def test_zero_time_members_bound_nothing() -> None:
    tree = Parallel("p", Drive(HERO), Emit(event("a")), Switch(HERO, "on"))
    assert run(tree, max_time=0.2).outcome.status == "timeout"
    assert run(Parallel("p", Emit(event("a")), Call(lambda: None))).outcome.steps == 0


def test_open_member_may_be_nested() -> None:
    tree = Parallel(
        "p", Serial("s", Wait(elapsed(0.1)), Parallel("q", Drive(HERO), Drive(NPC))), Task(NPC, 5)
    )
    done = run(tree)
    assert (done.outcome.status, done.outcome.steps) == ("success", 5)


def test_open_ended_member_before_another_is_reported() -> None:
    drive = Drive(HERO)
    drive.source = "x.osc:3"
    with pytest.raises(UnsupportedError, match=r"x.osc:3: hero drive never ends by itself"):
        run(Serial("s", drive, Task(HERO, 1)))


def test_failure_fails_the_parallel_and_cuts_the_others_short() -> None:
    other = Task(HERO, 9)
    bad = Task(NPC, 3, fails=True)
    bad.source = "x.osc:12"
    done = run(Parallel("p", other, bad))
    assert done.outcome.status == "failure"
    assert done.outcome.reason == "npc task (x.osc:12) failed at 0.150 s: gave up"
    assert other.log == ["start", "stop"]
    assert any('"end","name":"hero task"' in line and '"stopped"' in line for line in done.lines)
    assert any('"fail","name":"npc task"' in line and '"gave up"' in line for line in done.lines)


def test_two_failures_of_one_instant_are_named_in_order_of_the_tree() -> None:
    one, two = Task(HERO, 3, fails=True), Task(NPC, 3, fails=True)
    one.position, two.position = 10, 9
    reason = run(Parallel("p", one, two)).outcome.reason
    assert reason.index("npc") < reason.index("hero")


def test_race_survives_a_failing_member() -> None:
    done = run(OneOf("r", Task(HERO, 2, fails=True), Task(NPC, 5), Task(HERO, 8)))
    assert (done.outcome.status, done.outcome.steps) == ("success", 5)


def test_race_success_beats_failure_of_the_same_instant() -> None:
    assert run(OneOf("r", Task(HERO, 2, fails=True), Task(NPC, 2))).outcome.status == "success"


def test_race_fails_when_all_failed() -> None:
    done = run(OneOf("r", Task(HERO, 2, fails=True), Task(NPC, 4, fails=True)))
    assert (done.outcome.status, done.outcome.steps) == ("failure", 4)


def test_race_ties_go_to_the_first_in_the_source() -> None:
    race = OneOf("r", Task(HERO, 2), Task(NPC, 2))
    run(race)
    assert race.current_child is race.children[0]


def test_losers_of_a_race_are_cut_short() -> None:
    drive = Drive(HERO)
    done = run(OneOf("r", drive, Task(NPC, 2)))
    assert drive.status is Status.INVALID
    assert [line for line in done.lines if "drive" in line and '"end"' in line] == [
        '{"t":0.1,"kind":"action","status":"end","name":"hero drive","actor":"hero","source":"",'
        '"reason":"stopped"}'
    ]


def test_one_of_first_and_seeded() -> None:
    def chosen(policy: str, seed: int) -> list[int]:
        race = OneOf("r", *(Task(HERO, 1) for _ in range(3)))
        run(race, one_of=policy, seed=seed)
        return [i for i, task in enumerate(race.children) if task.log]  # type: ignore[attr-defined]

    assert chosen("first", 5) == [0]
    assert all(len(chosen("seeded", seed)) == 1 for seed in range(5))
    assert [chosen("seeded", s) for s in range(9)] == [chosen("seeded", s) for s in range(9)]
    assert {chosen("seeded", seed)[0] for seed in range(40)} == {0, 1, 2}


def test_until_is_asked_before_the_child() -> None:
    task = Task(HERO, 9)
    assert run(Until(task, lambda: True)).outcome.steps == 0
    assert task.log == []


def test_until_ends_a_running_child_with_success() -> None:
    drive = Drive(HERO)
    done = run(Serial("s", Until(drive, elapsed(0.25)), Task(NPC, 1)))
    assert (done.outcome.steps, drive.status) == (6, Status.SUCCESS)


def test_until_passes_the_end_of_its_child_on() -> None:
    done = run(Until(Task(HERO, 2), elapsed(9))).outcome
    assert (done.status, done.steps) == ("failure", 2)  # it has to go on until then
    assert "ended by itself after 0.1 s, before until elapsed 9 s" in done.reason
    assert run(Until(Task(HERO, 2, fails=True), elapsed(9))).outcome.status == "failure"


@pytest.mark.parametrize(
    ("content", "duration", "status", "steps"),
    [
        (lambda **o: Drive(HERO, **o), 0.5, "success", 10),
        (lambda **o: Task(HERO, 6, **o), 0.3, "success", 6),
        (lambda **o: Task(HERO, 4, **o), (0.3, 0.5), "failure", 4),  # nothing fills the rest
        (lambda **o: Task(HERO, 5, **o), (0.1, 0.3), "success", 5),
        (lambda **o: Task(HERO, 7, **o), 0.3, "failure", 6),
        (lambda **o: Serial("s", Task(HERO, 2), Drive(HERO), **o), 0.3, "success", 6),
        (lambda **o: Serial("s", Task(HERO, 7), **o), (0.0, 0.3), "failure", 6),
        (lambda **o: Serial("s", Wait(elapsed(0.3)), Emit(event("a")), **o), 0.3, "success", 6),
        (lambda **o: Parallel("p", Drive(HERO), Drive(NPC), **o), 0.3, "success", 6),
        (lambda **o: OneOf("r", Drive(HERO), Task(NPC, 2), **o), 0.3, "success", 6),
    ],
)
def test_duration(content: Any, duration: Any, status: str, steps: int) -> None:
    done = run(content(duration=duration))
    assert (done.outcome.status, done.outcome.steps) == (status, steps)
    if status == "failure":
        why = "ended after 0.2 s" if steps == 4 else "not finished within 0.3 s"
        assert why in done.outcome.reason


def test_open_content_ends_somewhere_in_a_range_of_durations() -> None:
    """Times are drawn evenly: means of 200 seeds within four standard errors."""
    steps = [run(Drive(HERO, duration=(1.0, 3.0)), seed=seed).outcome.steps for seed in range(200)]
    assert 20 <= min(steps) < 24 and 56 < max(steps) <= 60
    assert abs(sum(steps) / len(steps) - 40.0) < 4 * (40.0 / 12**0.5) / 200**0.5 + 0.5


def test_an_event_of_the_last_instant_still_ends_the_content() -> None:
    a = event("a")
    tree = Parallel(
        "p",
        Serial("s", Wait(a), duration=(0.0, 0.3)),
        Serial("e", Wait(elapsed(0.3)), Emit(a)),
    )
    assert run(tree).outcome.status == "success"


def test_exception_in_a_leaf_leaves_nothing_running() -> None:
    class Broken(Task):
        def on_update(self) -> Status:
            if self.elapsed_steps == 2:
                raise RuntimeError("bug")
            return Status.RUNNING

    drive, broken = Drive(NPC), Broken(HERO, 1)
    made = Run(Parallel("p", drive, broken), ids=IDS)
    with pytest.raises(ScenarioError, match=r"hero task: .*Broken raised RuntimeError: bug \(at 0"):
        made.go()
    assert all(node.status is not Status.RUNNING for node in made.root.iterate())
    assert not made.context.slots.live()
    assert broken.log == ["start", "stop"]
    assert '"status":"error","reason":"hero task: ' in made.lines[-1]


def test_exception_in_on_stop_leaves_nothing_running() -> None:
    class Broken(Drive):
        def on_stop(self) -> None:
            raise RuntimeError("no connection")

    made = Run(Parallel("p", Broken(HERO), Drive(NPC)), ids=IDS, max_time=0.1)
    with pytest.raises(ScenarioError, match="Broken raised RuntimeError: no connection"):
        made.go()
    assert all(node.status is not Status.RUNNING for node in made.root.iterate())
    assert not made.context.slots.live()


def test_exception_in_on_start_leaves_nothing_running() -> None:
    class Broken(Drive):
        def on_start(self) -> None:
            raise ScenarioError("no road")

    broken = Broken(HERO)
    broken.source = "x.osc:2"
    made = Run(Parallel("p", Drive(NPC), broken), ids=IDS)
    with pytest.raises(ScenarioError, match=r"x.osc:2: no road"):
        made.go()
    assert all(node.status is not Status.RUNNING for node in made.root.iterate())
    assert not made.context.slots.live()


def test_other_py_trees_behaviours_can_be_members() -> None:
    foreign = py_trees.behaviours.TickCounter("count", 3, py_trees.common.Status.SUCCESS)
    done = run(Serial("s", foreign, Task(HERO, 1)))
    assert (done.outcome.status, done.outcome.steps) == ("success", 4)


def test_the_tree_works_under_py_trees_own_tick_and_display() -> None:
    tree = Serial(
        "hello", Parallel("both", Task(HERO, 1), Wait(event("go"))), OneOf("x", Task(NPC, 1))
    )
    made = Run(tree, ids=IDS)
    for node in tree.iterate():
        node.setup(context=made.context)
    made.context.begin_pass()
    visited = list(tree.tick())
    assert visited[-1] is tree
    assert [node.name for node in visited] == ["hero task", "wait @go", "both", "hello"]
    text = py_trees.display.ascii_tree(tree)
    assert [line.strip() for line in text.splitlines()][1:4] == [
        "/_/ both",
        "--> hero task",
        "--> wait @go",
    ]


def test_a_negative_duration_is_an_error_of_the_scenario() -> None:
    with pytest.raises(ScenarioError, match="a duration of -1 s is negative"):
        Serial("late", Wait(elapsed(1.0)), duration=-1.0)

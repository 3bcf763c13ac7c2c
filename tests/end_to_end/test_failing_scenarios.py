"""Scenarios that cannot be carried out: each says which action, in which line, when, and why."""

from __future__ import annotations

from pathlib import Path

import pytest

from osc2tx.backends.py_trees import emit
from osc2tx_runtime import RunSettings, Scenario, run_scenario
from osc2tx_runtime.errors import InputError, PlacementError, ScenarioError
from tests.capabilities.conftest import Load
from tests.capabilities.conftest import load as load  # the fixture
from tests.end_to_end.harness import asam
from tests.end_to_end.mistakes import FAILURES, POINT, Case, source_of


def scenario(case: Case, load: Load, folder: Path) -> type[Scenario]:
    return load(emit(asam(source_of(case)[0], folder)))


@pytest.mark.parametrize("case", FAILURES, ids=[case.name for case in FAILURES])
def test_the_verdict_says_what_failed(case: Case, load: Load, tmp_path: Path) -> None:
    result = run_scenario(scenario(case, load, tmp_path), RunSettings(max_time=100.0))
    assert result.status == "failure"
    line = source_of(case)[1] + case.line
    place, _, reason = result.reason.partition(f" (case.osc:{line}) failed at {case.at:.3f} s: ")
    assert reason.startswith(case.reason), result.reason
    # The action is named as it is written.
    first = case.body.splitlines()[case.line - 1].strip()
    assert place.removeprefix("ego: ").split("(")[0] == first.split("(")[0]


TIMEOUTS = [
    Case(
        "a condition that never holds",
        "wait ego.speed > 60mps",
        20.0,
        1,
        "wait ego.speed > 60 * mps (case.osc:{line})",
    ),
    Case(
        "an event that nobody emits",
        "wait @never",
        20.0,
        1,
        "wait @never (case.osc:{line})",
        "event never",
    ),
    Case(
        "a lane change of a car that stands",
        "ego.assign_speed(0mps)\nego.change_lane(num_of_lanes: 1, side: left)",
        20.0,
        2,
        'ego.change_lane(num_of_lanes=1, side="left") (case.osc:{line}), while ego stands',
    ),
    Case(
        "a headway to a car that stands",
        "ego.assign_speed(0mps)\n"
        "ego.change_time_headway(target: 2s, direction: ahead, reference: npc)",
        20.0,
        2,
        'ego.change_time_headway(target=2 * s, direction="ahead", reference=npc) (case.osc:{line}),'
        " while the time headway is",
    ),
    Case(
        "an edge of what is true already",
        "wait rise(ego.speed > 1mps)",
        20.0,
        1,
        "wait rise(ego.speed > 1 * mps) (case.osc:{line}); wait rise(ego.speed > 1 * mps)"
        " (case.osc:{line}) never occurred: its condition was true from the start, and only a"
        " change counts",
    ),
    Case(
        "an action until an edge of what is true already",
        "ego.keep_speed() with:\n    until fall(ego.speed > 60mps)",
        20.0,
        1,
        "ego.keep_speed() (case.osc:{line}); until fall(ego.speed > 60 * mps) (case.osc:{until})"
        " never occurred: its condition was true from the start, and only a change counts",
    ),
]
"""What just never comes about: the time of the run is over."""


@pytest.mark.parametrize("case", TIMEOUTS, ids=[case.name for case in TIMEOUTS])
def test_a_run_without_end_says_what_it_waits_for(case: Case, load: Load, tmp_path: Path) -> None:
    result = run_scenario(scenario(case, load, tmp_path), RunSettings(max_time=20.0))
    assert result.status == "timeout"
    line = source_of(case)[1] + case.line
    expected = (
        f"not finished at 20 s; still running: {case.reason.format(line=line, until=line + 1)}"
    )
    assert result.reason.startswith(expected), result.reason


ERRORS: list[tuple[Case, type[ScenarioError]]] = [
    (
        Case(
            "two speeds at a time",
            "parallel:\n    ego.change_speed(target: 20mps)\n    ego.change_speed(target: 5mps)",
            1.0,
            3,
            "ego.change_speed(target=20 * mps) (case.osc:19) and ego.change_speed(target=5 * mps)"
            " (case.osc:20) control the longitudinal slot of ego at the same time; let them run one"
            " after the other (at 1.000 s)",
        ),
        ScenarioError,
    ),
    (
        Case(
            "a race for one car",
            "one_of:\n    ego.drive(duration: 9s) with:\n        speed(20mps)\n"
            "    serial:\n        wait elapsed(1s)\n        ego.change_speed(target: 5mps)",
            2.0,
            6,
            "ego.drive(speed(20 * mps), duration=9 * s) (case.osc:19) and"
            " ego.change_speed(target=5 * mps) (case.osc:23) control the longitudinal slot of ego"
            " at the same time; all members of a race run: let `--one-of first` or `seeded` choose"
            " one of them (at 2.000 s)",
        ),
        ScenarioError,
    ),
    (
        Case(
            "a division by zero",
            "wait 1 / (ego.speed / 1mps - 10) > 5",
            1.0,
            1,
            "the condition has no value: float division by zero (at 1.000 s)",
        ),
        ScenarioError,
    ),
    (
        Case(
            "ends that cannot agree",
            "parallel(overlap: equal):\n    ego.drive(duration: 3s)\n    either: one_of:\n"
            "        npc.drive(duration: 4s)\n        npc.drive(duration: 5s)",
            0.0,
            1,
            "parallel(overlap: equal) cannot be scheduled: either does not fit"
            " the length of ego.drive(duration=3 * s)",
        ),
        ScenarioError,
    ),
    (
        Case(
            "a start beside the road's lanes",
            "npc.drive(duration: 1s) with:\n    lane(9, at: start)\n    position(50m, at: start)",
            0.0,
            1,
            "npc: map highway has no free position on a road with a lane 9 from the right, 50 m"
            " from its start",
            beside=True,
        ),
        PlacementError,
    ),
    (
        Case(
            "two starts that need each other",
            "npc.drive(duration: 1s) with:\n"
            "    position(5m, behind: walker, at: start)\n"
            "walker.walk(duration: 1s) with:\n"
            "    position(5m, behind: npc, at: start)",
            0.0,
            3,
            "the starts of npc (case.osc:18), walker (case.osc:20) depend on each other",
            beside=True,
        ),
        PlacementError,
    ),
    (
        Case(
            "two cars at one place",
            "npc.drive(duration: 1s) with:\n"
            "    position(at_point: p, at: start)\n"
            "walker.walk(duration: 1s) with:\n"
            "    position(at_point: p, at: start)",
            0.0,
            3,
            "walker overlaps npc by",
            POINT.format("p", 90, -8.75),
            beside=True,
        ),
        PlacementError,
    ),
    (
        Case(
            "a map that is not there",
            "wait elapsed(1s)",
            0.0,
            0,
            "map `atlantis.xodr` not found in",
            map="atlantis.xodr",
        ),
        InputError,
    ),
]
"""What keeps the run from starting or going on: an error at a place, no verdict."""


@pytest.mark.parametrize(("case", "kind"), ERRORS, ids=[case.name for case, _ in ERRORS])
def test_what_cannot_go_on_is_an_error(
    case: Case, kind: type[ScenarioError], load: Load, tmp_path: Path
) -> None:
    with pytest.raises(ScenarioError) as caught:
        run_scenario(scenario(case, load, tmp_path), RunSettings(max_time=20.0))
    assert isinstance(caught.value, kind)
    assert caught.value.message.startswith(case.reason), caught.value.message
    if case.line:
        assert caught.value.source == f"case.osc:{source_of(case)[1] + case.line}"

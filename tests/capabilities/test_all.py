"""What holds for all scenarios of the capabilities, whatever they are about."""

import math
import subprocess
import sys

import pytest

from osc2tx_runtime import RunSettings
from osc2tx_runtime.language.resting import Resting
from osc2tx_runtime.report.trace_reader import read_run
from osc2tx_shared.classes import replace
from tests.capabilities.conftest import SETTINGS, Load
from tests.capabilities.kit import CAPABILITIES, Line, Perform, Performance
from tests.end_to_end.harness import (
    REPOSITORY,
    compilation_of,
    compile_scenario,
    permuted_module,
    run,
)
from tests.runtime.world.motion_scan import impossible

NAMES = sorted(path.stem for path in CAPABILITIES.glob("*.osc"))
MODULES = sorted((REPOSITORY / "generated" / "capabilities").glob("*.py"))
# These run elsewhere: one needs a package, one is to end with an error.
RUNNING = [n for n in NAMES if n not in ("C33_custom_action", "C34_conflict_reported")]
# In most overlaps the first member is the one that the others lie around, so it is not one of many.
WITHOUT_ORDER = [n for n in RUNNING if n != "C31_overlaps"]
# All is in closed form and starts at times that both step sizes have.
CLOSED_FORMS = [
    *("C01_action_lifecycle", "C02_actor_binding", "C03_composition", "C04_duration"),
    *("C05_move_drive_walk", "C08_stationary", "C20_acceleration_modifier", "C30_serial"),
    *("C31_parallel", "C34_conflict_resolution", "C36_one_of", "C37_rise"),
    *("C19_speed_shape", "C20_acceleration_shape", "C34_override", "C12_relative_trajectory"),
]


@pytest.mark.parametrize("name", NAMES)
def test_it_builds_without_a_diagnostic(name: str) -> None:
    compilation = compilation_of(CAPABILITIES / f"{name}.osc")
    assert compilation.is_supported
    assert compilation.diagnostics == ()


@pytest.mark.parametrize("name", RUNNING)
def test_it_runs_to_its_end(perform: Perform, name: str) -> None:
    run = perform(name)
    assert (run.status, run.result["reason"]) == ("success", "")
    assert run.of_kind("collision") == []
    assert read_run(run.trace.text.splitlines()).skipped == 0  # the report knows every line


class Awake(set[object]):
    """Takes nobody up."""

    def add(self, _: object) -> None:
        """Let it be visited."""


class Restless(Resting):
    """Where nobody rests."""

    def __init__(self) -> None:
        super().__init__()
        self.nodes = Awake()


@pytest.mark.parametrize("name", RUNNING)
def test_who_rests_has_nothing_to_do(
    perform: Perform, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The trace is the same, to the byte, if every node is visited in every pass."""
    trace = perform(name).trace.text
    monkeypatch.setattr("osc2tx_runtime.language.context.Resting", Restless)
    assert perform(name, replace(SETTINGS)).trace.text == trace


# What is not as vehicles move, and who asked for it: kinds of findings of the scan by scenario.
ASKED_FOR: dict[str, tuple[set[str], str]] = {
    "C09_assign_position": ({"jump"}, "a place is assigned"),
    "C10_assign_orientation": ({"course", "across"}, "a heading is assigned"),
    "C11_follow_path": ({"jump", "course", "across"}, "a path is replayed that begins elsewhere"),
    "C11_relative_path": ({"course", "across"}, "a path with a corner is replayed"),
    "C12_follow_trajectory": ({"jump", "along"}, "a trajectory is replayed that begins slower"),
    "C12_relative_trajectory": ({"across"}, "a trajectory with a corner is replayed"),
    "C18_braking_distances": ({"jump", "along"}, "a speed is assigned"),
    "C22_lane_offset": ({"across"}, "a lane change at a constant rate, which the run names"),
    "C22_lateral_speeds": ({"across"}, "a shape of its own ends moving, which the run names"),
    "C23_physical_movement": ({"along"}, "physics need not hold"),
}


@pytest.mark.parametrize("name", RUNNING)
def test_motion_is_possible_or_asked_for(perform: Perform, name: str) -> None:
    assert impossible(perform(name).lines, smoothing=0.0) == ASKED_FOR.get(name, (set(), ""))[0]


@pytest.mark.slow
@pytest.mark.parametrize("name", WITHOUT_ORDER)
def test_members_of_a_parallel_have_no_order(perform: Perform, load: Load, name: str) -> None:
    module = compile_scenario(CAPABILITIES / f"{name}.osc")
    assert run(load(permuted_module(module)), SETTINGS).ordered == perform(name).trace.ordered


@pytest.mark.slow
@pytest.mark.parametrize("name", CLOSED_FORMS)
def test_the_step_size_changes_nothing(perform: Perform, name: str) -> None:
    """Speeds are in closed form; ways are sums of trapezoids, so they differ by millimetres."""
    fine = perform(name, RunSettings(max_time=60.0, dt=0.01))
    coarse = perform(name)
    assert round(fine.result["steps"] / 5) == coarse.result["steps"]
    by_time: dict[tuple[float, str], Line] = {
        (line["t"], line["actor"]): line for line in fine.of_kind("state")
    }
    for line in coarse.of_kind("state"):
        other = by_time[line["t"], line["actor"]]
        assert line["v"] == pytest.approx(other["v"], abs=2e-6)
        assert (line["x"], line["y"]) == pytest.approx((other["x"], other["y"]), abs=5e-3)
        assert line["lane"] == other["lane"]


# Feedback on others sees the step before, so that the ends of approaches that are flat, and of who
# waits for them, come later at steps of 0.05 s than at shorter ones (s beyond two steps).
LATER = {"C13_time_gap": 0.02, "C15_headway": 0.05, "C29_crossing": 0.02}
AWAY = 0.2  # m
# Who is led, by others, by a function of time or along a line, is told each step anew (m more).
LED = {
    "C12_follow_trajectory": 0.1,
    "C17_careful_crossing": 0.4,
    "C19_speed_modifier": 0.02,
    "C23_physical_movement": 0.06,
    "C25_relative_modifiers": 0.12,
}


def departures(usual: Performance, other: Performance, late: float, away: float) -> list[str]:
    """Places of two runs that are farther apart than what ends later explains.

    Args:
        usual: A run.
        other: One at another step.
        late: How much later (s) actions end in one of them: who begins something then has gone on
            so long.
        away: Metres that are nothing.
    """
    states = {(line["t"], line["actor"]): line for line in other.of_kind("state")}
    fastest: dict[str, float] = {}
    for line in usual.of_kind("state"):
        fastest[line["actor"]] = max(fastest.get(line["actor"], 0.0), abs(line["v"]))
    found, compared = [], 0
    for line in usual.of_kind("state"):
        there = states.get((line["t"], line["actor"]))
        if there is not None:
            compared += 1
            apart = math.dist((line["x"], line["y"]), (there["x"], there["y"]))
            if apart > away + late * fastest[line["actor"]]:
                found.append(f"{line['actor']} at {line['t']:.2f} s: {apart:.2f} m")
    assert compared or not fastest  # some are about lights only
    return found


# Those of 0.002 s cost 25 times a usual run.
@pytest.mark.slow
@pytest.mark.parametrize("dt", [0.1, 0.01, 0.002])
@pytest.mark.parametrize("name", RUNNING)
def test_any_step_tells_the_same_story(perform: Perform, name: str, dt: float) -> None:
    """The same verdict and the same actions, within two steps of time and 0.2 m of place."""
    usual, other = perform(name), perform(name, RunSettings(max_time=60.0, dt=dt))
    assert other.status == usual.status
    late = 2.0 * max(dt, 0.05) + LATER.get(name, 0.0) + 1e-9
    ends, others = (
        sorted((e["name"], e["status"], e["t"]) for e in run.of_kind("action"))
        for run in (usual, other)
    )
    assert [end[:2] for end in ends] == [end[:2] for end in others]
    for end, another in zip(ends, others, strict=True):
        assert another[2] == pytest.approx(end[2], abs=late), end
    shown = max((abs(end[2] - another[2]) for end, another in zip(ends, others, strict=True)))
    assert departures(usual, other, shown, AWAY + LED.get(name, 0.0)) == []


def tool(*arguments: str) -> None:
    done = subprocess.run(
        [sys.executable, "-m", *arguments, *map(str, MODULES)],
        capture_output=True,
        text=True,
        cwd=REPOSITORY,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_committed_modules_are_those_of_the_scenarios() -> None:
    assert [path.stem for path in MODULES] == NAMES


def test_black_leaves_the_modules_alone() -> None:
    tool("black", "--check", "--line-length", "100")


def test_ruff_has_nothing_to_say_with_its_own_defaults() -> None:
    tool("ruff", "check", "--isolated", "--line-length", "100")

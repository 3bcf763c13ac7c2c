"""What holds for all scenarios of the capabilities, whatever they are about."""

import subprocess
import sys

import pytest

from osc2tx_runtime import RunSettings
from osc2tx_runtime.report.trace_reader import read_run
from tests.capabilities.conftest import SETTINGS, Load
from tests.capabilities.kit import CAPABILITIES, Line, Perform
from tests.end_to_end.harness import (
    REPOSITORY,
    compilation_of,
    compile_scenario,
    permuted_module,
    run,
)

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


@pytest.mark.slow
def test_they_pass_strict_mypy() -> None:
    tool("mypy", "--strict")

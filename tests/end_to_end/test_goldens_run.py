"""Every golden module runs to a verdict or to a clear error of the scenario."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx_runtime import RunSettings, Scenario, ScenarioError, run_scenario
from tests.golden.test_stages import options_for

CASES = sorted((Path(__file__).parents[1] / "golden" / "py_trees").iterdir())
# What a case says about itself in the file `expected/verdict.txt`, so that changes show.
Golden = Callable[[str, Path], None]


@pytest.mark.parametrize("case", CASES, ids=lambda path: path.name)
def test_runs_to_a_verdict(
    case: Path, load: Callable[[GeneratedModule], type[Scenario]], golden: Golden
) -> None:
    options = options_for(case)
    path = case / "input.osc"
    compilation = Compilation(path, path.name, options)
    assert compilation.ir is not None
    scenario = load(emit(compilation.ir))
    try:
        result = run_scenario(scenario, RunSettings(max_time=30.0))
        verdict = f"{result.status} after {result.time:.2f} s: {result.reason}"
    except ScenarioError as error:
        verdict = f"{error.source}: {error.message}"
    golden(verdict.rstrip(": ") + "\n", case / "expected" / "verdict.txt")

"""Each benchmark runs at its smallest size; what it measures decides nothing here."""

import gc
import runpy
import sys
from pathlib import Path

import pytest

from tests.processes import forked

FOLDER = Path(__file__).parent.parent / "benchmarks"
MODULES = {"costs", "long_runs", "maps", "repository", "trees"}  # or too long for a test
MAP = FOLDER.parent / "runtime_lib/osc2tx_runtime/maps/highway.xodr"
SMALLEST = {
    "build": ["--scenarios", "4"],
    "diffs": ["comment cut_in:"],
    "frontend": ["--no-start", "60"],
    "growth": ["choices"],
    "importing": ["--size", "0.02", "times"],
    "language_server": ["40"],
    "opendrive": [str(MAP)],
    "runtime": ["--largest", "10"],
}


def test_all_are_here() -> None:
    assert {path.stem for path in FOLDER.glob("*.py")} == MODULES | set(SMALLEST)


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(SMALLEST))
def test_runs(name: str) -> None:
    def run() -> None:
        gc.freeze()  # what all tests have left here is not searched before each measurement
        sys.path.insert(0, str(FOLDER))
        sys.argv = [name, *SMALLEST[name]]
        runpy.run_path(str(FOLDER / f"{name}.py"), run_name="__main__")

    ended = forked(run)
    assert ended.code == 0, ended.err
    assert ended.out

"""The compiled wheel of the runtime does what its files do, to the last digit of the traces."""

import importlib.machinery
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

FOLDER = os.environ.get("OSC2TX_COMPILED", "")
pytestmark = pytest.mark.skipif(not FOLDER, reason="OSC2TX_COMPILED names no folder of wheels")

GENERATED = Path(__file__).parents[2] / "generated"
SUFFIX = importlib.machinery.EXTENSION_SUFFIXES[0]
RUN = """
import importlib, pathlib, sys
from osc2tx_runtime import RunSettings, Scenario, ScenarioError, run_scenario
folder = pathlib.Path(sys.argv[1])
sys.path[:0] = [str(folder), str(folder / "capabilities")]
for path in sorted(folder.rglob("*.py")):
    for scenario in vars(importlib.import_module(path.stem)).values():
        if isinstance(scenario, type) and scenario.__module__ == path.stem:
            if issubclass(scenario, Scenario) and "." not in scenario.name:
                if scenario.is_abstract():
                    continue
                try:
                    lines = run_scenario(scenario, RunSettings(max_time=30.0)).trace_lines
                except ScenarioError as error:
                    lines = (str(error),)
                print(path.stem, scenario.name, *lines, sep="\\n")
"""


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with what the wheel holds."""
    (wheel,) = Path(FOLDER).glob("osc2tx_runtime-*-cp*.whl")
    folder = tmp_path_factory.mktemp("compiled")
    zipfile.ZipFile(wheel).extractall(folder)
    return folder


def test_the_step_of_the_world_is_compiled(compiled: Path) -> None:
    assert (compiled / "osc2tx_runtime" / "world" / f"embedded{SUFFIX}").is_file()


def test_traces_are_the_same(compiled: Path) -> None:
    command = [sys.executable, "-c", RUN, str(GENERATED)]
    said = [
        subprocess.run(command, env={**os.environ, **more}, capture_output=True, check=True).stdout
        for more in ({}, {"PYTHONPATH": str(compiled)})
    ]
    assert said[0].count(b"\n") > 10_000
    assert said[0] == said[1]

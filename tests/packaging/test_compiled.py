"""The compiled wheels do what their files do: the same outputs, and traces to the last digit."""

import importlib.machinery
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

FOLDER = os.environ.get("OSC2TX_COMPILED", "")
pytestmark = pytest.mark.skipif(not FOLDER, reason="OSC2TX_COMPILED names no folder of wheels")

ROOT = Path(__file__).parents[2]
GENERATED = ROOT / "generated"
SOURCES = [ROOT / "scenarios", ROOT / "tests"]
if os.environ.get("OSC2TX_TEST_DATA"):
    SOURCES.append(Path(os.environ["OSC2TX_TEST_DATA"], "corpus"))
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
COMPILE = """
import pathlib, sys
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
for path in sorted(path for folder in sys.argv[1:] for path in pathlib.Path(folder).rglob("*.osc")):
    made = Compilation(path, path.name, CompileOptions())
    print(path, made.is_supported, *made.levels, sep="\\n")
    for each in made.sink.sorted():
        print(each, each.primary and (each.primary.start, each.primary.end), each.fixes)
    if made.is_supported:
        print(made.draft and (made.draft.python, made.draft.source_map), made.ir)
        for scenario in made.xml:
            print(scenario.xml, scenario.parameters, scenario.report_json)
"""


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with what the wheels hold."""
    folder = tmp_path_factory.mktemp("compiled")
    for name in ("osc2tx", "osc2tx_runtime"):
        (wheel,) = Path(FOLDER).glob(f"{name}-*-cp*.whl")
        zipfile.ZipFile(wheel).extractall(folder)
    return folder


def said_by_both(compiled: Path, *arguments: str) -> list[bytes]:
    """Return what a script prints with the files, and with the compiled wheels."""
    return [
        subprocess.run(
            [sys.executable, "-c", *arguments],
            env={**os.environ, **more},
            capture_output=True,
            check=True,
        ).stdout
        for more in ({}, {"PYTHONPATH": str(compiled)})
    ]


def test_the_step_of_the_world_is_compiled(compiled: Path) -> None:
    assert (compiled / "osc2tx_runtime" / "world" / f"embedded{SUFFIX}").is_file()


def test_traces_are_the_same(compiled: Path) -> None:
    of_files, of_wheels = said_by_both(compiled, RUN, str(GENERATED))
    assert of_files.count(b"\n") > 10_000
    assert of_files == of_wheels


def test_the_compiler_is_compiled(compiled: Path) -> None:
    assert (compiled / "osc2tx" / "semantics" / f"symbols{SUFFIX}").is_file()
    assert not (compiled / "osc2tx" / "syntax" / f"packed_ast{SUFFIX}").is_file()


def test_outputs_are_the_same(compiled: Path) -> None:
    """Messages, levels, IR, modules, source maps and XML of all sources in reach."""
    of_files, of_wheels = said_by_both(compiled, COMPILE, *map(str, SOURCES))
    assert of_files.count(b"\n") > 10_000
    assert of_files.splitlines() == of_wheels.splitlines()

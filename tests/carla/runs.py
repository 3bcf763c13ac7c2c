"""Runs of the generated modules, in the embedded world and in CARLA."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from osc2tx.module_loading import scenarios_of_file
from osc2tx_runtime import RunResult, RunSettings, Scenario, run_scenario
from osc2tx_runtime.errors import ScenarioError
from tests.conftest import DATA_VARIABLE

REPOSITORY = Path(__file__).parents[2]
GENERATED = REPOSITORY / "generated"
SHOWN = ("action", "collision", "event", "result")


def modules() -> list[Path]:
    """Return all generated modules that have a map here."""
    found = [path for path in sorted(GENERATED.rglob("*.py")) if path.stem != "__init__"]
    return [path for path in found if path.stem != "hello_world" or towns()]


def towns() -> tuple[Path, ...]:
    """Return the folder of CARLA's towns, if there is test data."""
    folder = os.environ.get(DATA_VARIABLE)
    return (Path(folder, "maps", "carla-2020"),) if folder else ()


def settings_for(module: Path) -> RunSettings:
    """Return what a module needs to run."""
    if module.stem != "hello_world":
        return RunSettings()
    return RunSettings(map_path=towns(), signal={"go_signal": 1.0}, spawn={"hero": ("16", -3, 5.0)})


def in_carla(settings: RunSettings, port: int, **options: Any) -> RunSettings:
    """Return settings for a run in CARLA.

    Args:
        settings: Of the run.
        port: Of the server.
        **options: Of the world, beside its address; `control` says who moves the actors.
    """
    control = options.pop("control", {})
    at = {"carla": ("127.0.0.1", port), "carla_load": True, "carla_keep": True}
    world_options = {**at, **options}
    return replace(settings, world="carla", control=control, world_options=world_options)


@cache
def in_the_world(module: Path) -> dict[str, RunResult | str]:
    """Run the scenarios of a module in the embedded world, once for all comparisons with it."""
    return run_all(module, settings_for(module))


def run_all(module: Path, settings: RunSettings) -> dict[str, RunResult | str]:
    """Run the scenarios of a module; the text of its error stands for a run without a verdict."""
    results: dict[str, RunResult | str] = {}
    with scenarios_of_file(module, f"run_{module.stem}") as scenarios:
        for name, scenario in scenarios.items():
            results[name] = run_one(scenario, settings)
    return results


def run_one(scenario: type[Scenario], settings: RunSettings) -> RunResult | str:
    """Run a scenario."""
    try:
        return run_scenario(scenario, settings)
    except ScenarioError as error:
        return str(error)


def lines_of(result: RunResult | str) -> Sequence[str]:
    """Return the trace after its header, or the error."""
    return result if isinstance(result, str) else result.trace_lines[1:]


Happening = tuple[tuple[Any, ...], float]


def happenings(result: RunResult) -> list[Happening]:
    """Return events, begins and ends of actions, contacts and the verdict, with their times."""
    found = []
    for line in map(json.loads, result.trace_lines):
        if line["kind"] in SHOWN:
            what = (line["kind"], line.get("name"), line.get("status"), line.get("source"))
            found.append((what, line.get("t", result.time)))
    return found

"""Runs each scenario of `scenarios/capabilities` once, however many tests look at it."""

import importlib.util
import sys
from collections.abc import Callable, Iterator

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx_runtime import RunSettings, Scenario
from tests.capabilities.kit import CAPABILITIES, Perform, Performance
from tests.end_to_end.harness import generate, run

Load = Callable[[GeneratedModule], type[Scenario]]
SETTINGS = RunSettings(max_time=60.0)


@pytest.fixture(scope="session")
def load(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Load]:
    """Import a generated module from files, its map beside it; give its last scenario."""
    names: list[str] = []

    def import_module(module: GeneratedModule) -> type[Scenario]:
        path = tmp_path_factory.mktemp("capability") / f"{module.stem}.py"
        path.write_text(module.python, encoding="utf-8")
        path.with_suffix(".map.json").write_text(module.source_map, encoding="utf-8")
        names.append(f"capability_{len(names)}_{module.stem}")
        spec = importlib.util.spec_from_file_location(names[-1], path)
        assert spec is not None and spec.loader is not None
        loaded = importlib.util.module_from_spec(spec)
        sys.modules[names[-1]] = loaded
        spec.loader.exec_module(loaded)
        own = [each for each in vars(loaded).values() if isinstance(each, type)]
        return [each for each in own if issubclass(each, Scenario) and not each.is_abstract()][-1]

    yield import_module
    for name in names:
        sys.modules.pop(name, None)  # a run of pytest inside a test has its own fixtures


@pytest.fixture(scope="session")
def perform(load: Load) -> Perform:
    """Build and run a scenario by the name of its file; give what was recorded."""
    scenarios: dict[str, type[Scenario]] = {}
    done: dict[str, Performance] = {}

    def perform_one(name: str, settings: RunSettings = SETTINGS) -> Performance:
        if settings is SETTINGS and name in done:
            return done[name]
        if name not in scenarios:
            scenarios[name] = load(generate(CAPABILITIES / f"{name}.osc"))
        made = Performance(run(scenarios[name], settings))
        if settings is SETTINGS:  # others are looked at once, and may be long
            done[name] = made
        return made

    return perform_one

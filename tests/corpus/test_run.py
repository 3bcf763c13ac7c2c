"""Public scenarios that build also run: each ends in a verdict, none in a traceback."""

import importlib.util
import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import pytest

from osc2tx_runtime import Scenario, main
from tests.corpus.report import INVALID, compilation_of, manifest

MAX_TIME = 20.0  # s of simulated time
MAPS = ("carla-2020", "carla-2019", "esmini")
# What `main` returns of a scenario: succeeded, failed or ran out of time, cannot be read (no such
# map). Wrong usage (2) would be a mistake of this test.
VERDICTS = {0: "success", 4: "unreadable", 5: "failed"}


@dataclass(frozen=True)
class Ended:
    """How a scenario of a file ended."""

    file: str
    scenario: str
    verdict: str


def load(path: Path, name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def own_scenarios(module: ModuleType) -> list[type[Scenario]]:
    """Return those that one may run by themselves, as `main` of the module has them."""
    classes = [each for each in vars(module).values() if isinstance(each, type)]
    own = [each for each in classes if issubclass(each, Scenario) and each is not Scenario]
    return [each for each in own if "." not in each.name]


@pytest.fixture(scope="module")
def ended(test_data: Path, tmp_path_factory: pytest.TempPathFactory) -> list[Ended]:
    folder = tmp_path_factory.mktemp("modules")
    maps = [f"--map-path={test_data / 'maps' / name}" for name in MAPS]
    found = []
    patch = pytest.MonkeyPatch()
    for number, row in enumerate(manifest(test_data / "corpus")):
        module = None
        if row["kind"] != INVALID:
            module = compilation_of(test_data / "corpus", row).module
        if module is None:
            continue
        path = folder / f"m{number}" / f"{module.stem}.py"
        path.parent.mkdir()
        path.write_text(module.python, encoding="utf-8")
        path.with_suffix(".map.json").write_text(module.source_map, encoding="utf-8")
        patch.syspath_prepend(path.parent)
        name = f"corpus_{number}"
        for scenario in own_scenarios(load(path, name)):
            try:
                code = main(scenario, argv=[f"--max-time={MAX_TIME}", *maps])
            except Exception as error:  # any exception is a finding; the others run all the same
                verdict = f"{type(error).__name__}: {error}"
            else:
                verdict = VERDICTS.get(code, f"exit code {code}")
            found.append(Ended(row["file"], scenario.name, verdict))
        del sys.modules[name]
    patch.undo()
    return found


@pytest.mark.slow
def test_every_scenario_ends_in_a_verdict(ended: list[Ended]) -> None:
    assert [each for each in ended if each.verdict not in VERDICTS.values()] == []


@pytest.mark.slow
def test_some_of_them_succeed(ended: list[Ended]) -> None:
    """Without this, a run that refuses everything would pass."""
    assert Counter(each.verdict for each in ended)["success"] >= 3

"""Fixtures of the end-to-end tests."""

import importlib.util
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx_runtime import Scenario
from tests.unit.cli.shell import Shell


@pytest.fixture(scope="module")
def load(
    tmp_path_factory: pytest.TempPathFactory,
) -> Iterator[Callable[[GeneratedModule], type[Scenario]]]:
    """Import a generated module from files, its map beside it."""
    names: list[str] = []

    def import_module(generated: GeneratedModule) -> type[Scenario]:
        folder = tmp_path_factory.mktemp("module")
        path = folder / f"{generated.stem}.py"
        path.write_text(generated.python, encoding="utf-8")
        path.with_suffix(".map.json").write_text(generated.source_map, encoding="utf-8")
        name = f"generated_for_test_{len(names)}_{generated.stem}"
        names.append(name)
        spec = importlib.util.spec_from_file_location(name, path)
        assert spec is not None and spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
        classes = [
            value
            for value in vars(module).values()
            if isinstance(value, type) and issubclass(value, Scenario) and not value.is_abstract()
        ]
        return next((each for each in classes if each.name == "top"), classes[-1])

    yield import_module
    for name in names:
        del sys.modules[name]


@pytest.fixture
def shell(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Shell:
    """A command line whose working directory is a folder of the test."""
    monkeypatch.chdir(tmp_path)
    return Shell(capsys, tmp_path)

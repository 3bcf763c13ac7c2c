"""Imports generated modules from files."""

from __future__ import annotations

import importlib.util
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from osc2tx_runtime import Scenario

if TYPE_CHECKING:
    from osc2tx.backends.py_trees.emitter import GeneratedModule


@contextmanager
def scenarios_of_module(module: GeneratedModule) -> Iterator[Mapping[str, type[Scenario]]]:
    """Give the scenario classes of a module that was just generated, by names in the source."""
    with tempfile.TemporaryDirectory(prefix="osc2tx-run-") as folder:
        place = Path(folder, f"{module.stem}.py")
        place.write_text(module.python, encoding="utf-8")
        place.with_suffix(".map.json").write_text(module.source_map, encoding="utf-8")
        with scenarios_of_file(place, Path(folder).name) as scenarios:
            yield scenarios


@contextmanager
def scenarios_of_file(place: Path, name: str) -> Iterator[Mapping[str, type[Scenario]]]:
    """Give the scenario classes of a written module; it is imported under a name of its own.

    Raises:
        ImportError, SyntaxError, ValueError, OSError: If it cannot be imported.
    """
    spec = importlib.util.spec_from_file_location(name, place)
    assert spec is not None and spec.loader is not None, "every .py file has a loader"
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
        yield _scenarios_in(module)
    finally:
        del sys.modules[name]


def _scenarios_in(module: ModuleType) -> dict[str, type[Scenario]]:
    return {
        value.name: value
        for value in vars(module).values()
        if isinstance(value, type)
        and issubclass(value, Scenario)
        and value.__module__ == module.__name__
    }

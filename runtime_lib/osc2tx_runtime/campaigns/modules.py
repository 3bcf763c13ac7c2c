"""Imports a generated module and the modules that it requires, from their texts."""

from __future__ import annotations

import importlib
import importlib.util
import os
import sys
import tempfile
from collections.abc import Mapping
from itertools import count
from pathlib import Path, PureWindowsPath
from types import ModuleType

from osc2tx_runtime.domain.scenario import Scenario
from osc2tx_runtime.errors import OwnCode, SettingsError
from osc2tx_shared.own_folders import CAMPAIGN, hold, remove_left_over

_NUMBERS = count()  # modules of one process have names of their own


class Modules:
    """The modules of a campaign in a temporary folder, which `close` deletes.

    A process can have one instance at a time: modules find each other on `sys.path`.

    Args:
        files: Path of each module in the folder to its text.

    Raises:
        SettingsError: A path leads out of the folder; the store of a campaign is untrusted.
    """

    def __init__(self, files: Mapping[str, str]) -> None:
        for name in files:
            _require_inside(name)
        self._files = frozenset(files)
        remove_left_over(CAMPAIGN)
        self._folder = tempfile.TemporaryDirectory(prefix=CAMPAIGN)
        self._mark = hold(self._folder.name)
        self._name = f"osc2tx_campaign_{next(_NUMBERS)}"
        self._path = list(sys.path)
        self._known = set(sys.modules)
        for name, text in files.items():
            place = Path(self._folder.name, name)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text, encoding="utf-8")

    def load(self, name: str) -> dict[str, type[Scenario]]:
        """Import a module; return its scenarios by their names in the source.

        Raises:
            SettingsError: It is not one of the modules.
        """
        if name not in self._files or not name.endswith(".py"):
            raise SettingsError(f"{name!r} is not a module of the campaign")
        place = Path(self._folder.name, name)
        folders = [str(place.parent), *map(str, place.parent.parents)]
        root = folders.index(self._folder.name)
        sys.path[:0] = folders[: root + 1]
        importlib.invalidate_caches()
        spec = importlib.util.spec_from_file_location(self._name, place)
        assert spec is not None and spec.loader is not None, "every .py file has a loader"
        module = importlib.util.module_from_spec(spec)
        sys.modules[self._name] = module
        with OwnCode(f"{name} cannot be imported:"):
            spec.loader.exec_module(module)
        return scenarios_of(module)

    def close(self) -> None:
        """Unload all modules of the folder."""
        sys.path[:] = self._path
        for name in set(sys.modules) - self._known:
            place = getattr(sys.modules[name], "__file__", None)
            if name == self._name or (place and place.startswith(self._folder.name)):
                del sys.modules[name]
        self._folder.cleanup()
        if self._mark is not None:
            os.close(self._mark)


def _require_inside(name: str) -> None:
    place = PureWindowsPath(name)  # knows the separators and drives of all platforms
    parts = name.replace("\\", "/").split("/")
    if place.anchor or "\0" in name or any(part in ("", ".", "..") for part in parts):
        raise SettingsError(f"{name!r} is not the path of a module inside the campaign")


def scenarios_of(module: ModuleType) -> dict[str, type[Scenario]]:
    """Return the scenarios that a module declares, by their names in the source."""
    return {
        value.name: value
        for value in vars(module).values()
        if isinstance(value, type)
        and issubclass(value, Scenario)
        and not value.is_abstract()
        and value.__module__ == module.__name__
    }


def scenario_in(scenarios: Mapping[str, type[Scenario]], name: str) -> type[Scenario]:
    """Return a scenario by its name.

    Raises:
        SettingsError: It does not exist.
    """
    if name not in scenarios:
        raise SettingsError(f"there is no scenario `{name}`; available: {', '.join(scenarios)}")
    return scenarios[name]

"""Imports a generated module, and those that it needs, from their texts."""

from __future__ import annotations

import importlib
import importlib.util
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Mapping
from contextlib import suppress
from itertools import count
from pathlib import Path, PureWindowsPath
from types import ModuleType

from osc2tx_runtime.domain.scenario import Scenario
from osc2tx_runtime.errors import OwnCode, SettingsError

if sys.platform != "win32":
    import fcntl

PREFIX = "osc2tx-campaign-"
"""How the names of the folders begin."""

FRESH = 60.0
"""Seconds: a folder that is younger may be one that its process is about to lock."""

_NUMBERS = count()  # modules of one process have names of their own


class Modules:
    """The modules of a campaign in a folder of their own, which is gone when this is closed.

    A process can have one of them at a time: modules find each other on `sys.path`.

    Args:
        files: Path of each module inside of the folder to its text.

    Raises:
        SettingsError: A path leads out of the folder: the store of a campaign may be a stranger's.
    """

    def __init__(self, files: Mapping[str, str]) -> None:
        for name in files:
            _require_inside(name)
        self._files = frozenset(files)
        remove_left_over()
        self._folder = tempfile.TemporaryDirectory(prefix=PREFIX)
        self._mark = _hold(self._folder.name)
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
            SettingsError: It is none of the modules.
        """
        if name not in self._files or not name.endswith(".py"):
            raise SettingsError(f"{name!r} is no module of the campaign")
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
        """Forget all modules of the folder."""
        sys.path[:] = self._path
        for name in set(sys.modules) - self._known:
            place = getattr(sys.modules[name], "__file__", None)
            if name == self._name or (place and place.startswith(self._folder.name)):
                del sys.modules[name]
        self._folder.cleanup()
        if self._mark is not None:
            os.close(self._mark)


def remove_left_over() -> None:
    """Remove the folders of processes that were killed: they are no longer locked."""
    if sys.platform == "win32":  # no locks of folders there
        return
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        with suppress(OSError):  # of another user, or removed meanwhile
            found = folder.lstat()
            if found.st_uid != os.getuid() or time.time() - found.st_mtime < FRESH:
                continue
            mark = _hold(str(folder))
            if mark is not None:
                shutil.rmtree(folder, ignore_errors=True)
                os.close(mark)


def _hold(folder: str) -> int | None:
    """Lock a folder until the descriptor is closed; None if it is locked, or cannot be."""
    if sys.platform == "win32":
        return None
    mark = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        fcntl.flock(mark, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(mark)
        return None
    return mark


def _require_inside(name: str) -> None:
    place = PureWindowsPath(name)  # knows the separators and drives of all platforms
    parts = name.replace("\\", "/").split("/")
    if place.anchor or "\0" in name or any(part in ("", ".", "..") for part in parts):
        raise SettingsError(f"{name!r} is no path of a module inside of the campaign")


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
        SettingsError: There is none.
    """
    if name not in scenarios:
        raise SettingsError(f"there is no scenario `{name}`; there is: {', '.join(scenarios)}")
    return scenarios[name]

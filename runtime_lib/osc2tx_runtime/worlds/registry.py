"""Worlds by name: of this package, and of installed packages."""

from __future__ import annotations

import re
from typing import Any

from osc2tx_runtime.errors import OwnCode, ScenarioError, SettingsError
from osc2tx_runtime.world.checks.values import problem_of
from osc2tx_runtime.world.protocol import ControlMode

from .embedded import EMBEDDED
from .world_type import Option, WorldType

ENTRY_POINTS = "osc2tx.worlds"
"""Group of entry points; each names a `WorldType`, by the name that `--world` takes."""

NAME = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


def find_world(name: str) -> WorldType:
    """Return a world by its name.

    Raises:
        SettingsError: There is none, or it cannot be loaded.
    """
    if name == EMBEDDED.name:
        return EMBEDDED
    from importlib.metadata import entry_points

    entries = {entry.name: entry for entry in entry_points(group=ENTRY_POINTS)}
    if name not in entries:
        known = ", ".join(sorted({EMBEDDED.name, *entries}))
        raise SettingsError(f"--world {name}: there is no such world; available: {known}")
    try:
        with OwnCode(f"--world {name}: {entries[name].value}:"):
            found: object = entries[name].load()
    except ScenarioError as error:
        raise SettingsError(error.message) from error
    if not isinstance(found, WorldType):
        raise SettingsError(f"--world {name}: {entries[name].value} is not a WorldType")
    if problem := _problem_of(found):
        raise SettingsError(f"--world {name}: {entries[name].value}: {problem}")
    return found


def _problem_of(found: Any) -> str:
    """Return the error in the fields of a world; empty without one."""
    if not isinstance(found.name, str) or not callable(found.make):
        return "a name and a function `make` are missing"
    if problem := problem_of(found.controls, tuple[ControlMode, ...]) or (
        "is empty" if not found.controls else ""
    ):
        return f"controls {problem}"
    if problem := problem_of(found.options, tuple[Option, ...]):
        return f"options {problem}"
    for option in found.options:
        texts = (option.name, option.metavar, option.help)
        if not all(isinstance(text, str) for text in texts) or not NAME.fullmatch(option.name):
            return "name, metavar and help of an option are texts, the name of a-z, 0-9 and -"
        if not callable(option.parse) or not (option.gather is None or callable(option.gather)):
            return f"option {option.name}: parse and gather are functions"
    names = [option.name for option in found.options]
    return "two options have the same name" if len(set(names)) < len(names) else ""

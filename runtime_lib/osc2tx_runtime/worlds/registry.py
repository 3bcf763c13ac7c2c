"""Worlds by name: that of this package, and those of installed packages."""

from __future__ import annotations

from osc2tx_runtime.errors import OwnCode, ScenarioError, SettingsError

from .embedded import EMBEDDED
from .world_type import WorldType

__all__ = ["ENTRY_POINTS", "find_world"]

ENTRY_POINTS = "osc2tx.worlds"
"""Group of entry points; each names a `WorldType`, by the name that `--world` takes."""


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
        raise SettingsError(f"--world {name}: there is no such world; there is: {known}")
    try:
        with OwnCode(f"--world {name}: {entries[name].value}:"):
            found: object = entries[name].load()
    except ScenarioError as error:
        raise SettingsError(error.message) from error
    if not isinstance(found, WorldType):
        raise SettingsError(f"--world {name}: {entries[name].value} is no WorldType")
    return found

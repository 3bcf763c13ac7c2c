"""Search for the map file of a scenario."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from osc2tx_runtime.errors import InputError
from osc2tx_shared.map_files import DEFAULT_MAP, map_names, map_places

LONGEST_SHOWN = 80


def find_map(name: str | None, folders: Sequence[Path]) -> Path:
    """Return the file of a map.

    A file among `folders` is the map itself. Folders are searched in their order, then the maps
    of this package; `Town06` also finds `Town06.xodr`.

    Args:
        name: The name in the scenario; None for the default map.
        folders: Of the settings.

    Raises:
        InputError: There is no such file; the message lists the searched folders.
    """
    try:
        return _find(name, folders)
    except (OSError, ValueError) as error:  # not a possible file name
        why = error.strerror if isinstance(error, OSError) else error
        raise InputError(
            f"map `{_short(name or DEFAULT_MAP)}` cannot be searched: {why}"
        ) from error


def _find(name: str | None, folders: Sequence[Path]) -> Path:
    for entry in folders:
        if entry.is_file():
            return entry
        if not entry.is_dir():
            raise InputError(
                f"{entry}: there is no such folder or map"
                " (from --map-path, or `map_paths` of the settings)"
            )
    wanted = name or DEFAULT_MAP
    for path in map_places(wanted, folders):
        if path.is_file():
            return path
    searched = ", ".join([*map(str, folders), "the maps of osc2tx_runtime"])
    shipped = ", ".join(map_names(()))
    raise InputError(
        f"map `{_short(wanted)}` not found in {searched}; give its folder with --map-path."
        f" Shipped maps: {shipped or 'none'}"
    )


def _short(name: str) -> str:
    """Return a name, shortened if it is long."""
    return name if len(name) <= LONGEST_SHOWN else f"{name[:LONGEST_SHOWN]}…"

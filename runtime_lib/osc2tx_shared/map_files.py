"""Where the map file of a scenario is looked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

SHIPPED = Path(__file__).parents[1] / "osc2tx_runtime" / "maps"
DEFAULT_MAP = "highway.xodr"

_SUFFIXES = ("", ".xodr")


def map_places(name: str, folders: Sequence[Path]) -> Iterator[Path]:
    """Yield the files that a map can be, in the order in which they are looked for.

    A file among `folders` is the map itself. Folders come in their order, then the maps of the
    runtime; `Town06` also finds `Town06.xodr`.

    Args:
        name: The name of the map in the scenario.
        folders: Folders with maps, or the map itself.
    """
    for entry in (*folders, SHIPPED):
        if entry.is_file():
            yield entry
        else:
            yield from (entry / f"{name}{suffix}" for suffix in _SUFFIXES)


def places_in_project(name: str | None, folders: Sequence[Path]) -> tuple[Path, ...]:
    """Return where a map is looked for, maps of the runtime and paths to elsewhere apart.

    Args:
        name: The name of the map in the scenario; None for the default map.
        folders: Folders with maps, or the map itself.
    """
    wanted = Path(name or DEFAULT_MAP)
    if wanted.is_absolute() or ".." in wanted.parts:
        return ()
    places = map_places(str(wanted), folders)
    return tuple(place for place in places if not place.is_relative_to(SHIPPED))


def map_names(folders: Sequence[Path]) -> list[str]:
    """Return the names of the maps in folders, and those of the runtime."""
    places = (path for folder in (*folders, SHIPPED) for path in folder.glob("*.xodr"))
    return sorted({path.name for path in places if path.is_file()})

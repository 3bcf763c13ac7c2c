"""The folders in which the map of a scenario is looked for."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

from osc2tx.backends.xosc.facts import refusing
from osc2tx.backends.xosc.facts.maps import Roads
from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.errors import InputError
from osc2tx_runtime.opendrive import read_map
from osc2tx_shared.map_files import DEFAULT_MAP, places_in_project

MOST_MAPS = 32
"""Maps that are kept once read."""


class MapFolders:
    """Folders with maps. A map is looked for once for all documents of a scenario.

    Args:
        folders: The folders, or a map itself.
    """

    def __init__(self, folders: Sequence[Path]) -> None:
        self._folders = tuple(folders)
        self._roads: dict[str | None, Roads | None] = {}
        self._places: dict[str | None, tuple[Path, ...]] = {}

    def roads(self, map_file: str | None) -> Roads | None:
        """Return a map, looked for as `osc2tx run` does; `None` if it is not found.

        Raises:
            Inexpressible: It is found and is no map.
        """
        if map_file not in self._roads:
            self._roads[map_file] = self._found(map_file)
        return self._roads[map_file]

    def places(self, map_file: str | None) -> tuple[Path, ...]:
        """Return where a map is looked for, outside of the runtime library."""
        if map_file not in self._places:
            self._places[map_file] = places_in_project(map_file, self._folders)
        return self._places[map_file]

    def _found(self, map_file: str | None) -> Roads | None:
        wanted = Path(map_file or DEFAULT_MAP)
        if wanted.is_absolute() or ".." in wanted.parts:
            return None  # nothing outside of the folders is read
        try:
            return _read_now(find_map(map_file, [f for f in self._folders if f.exists()]))
        except InputError:
            return None


def _read_now(path: Path) -> Roads:
    """Return a map as its file is now: between two builds of one process it may change."""
    now = path.stat()
    return _read(path, now.st_mtime_ns, now.st_size)


@lru_cache(maxsize=MOST_MAPS)
def _read(path: Path, modified: int, size: int) -> Roads:
    with refusing(about=f"map {path.name} cannot be read: "):
        return Roads(read_map(path), path)

"""Notices when something that a build reads has changed.

Times and sizes are looked at every now and then: that works on every file system, in containers and
on network drives, and what has not changed is found out by the build itself.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

from osc2tx.building.results import FileResult
from osc2tx.support.paths import SETTINGS_FILES, real_path

Snapshot = dict[str, tuple[int, int] | None]


def rounds(
    paths: Sequence[str | Path], also: Callable[[], Iterable[str]], pause: Callable[[], None]
) -> Iterator[None]:
    """Yield at once, and then each time after something has changed and come to rest.

    Args:
        paths: Files and folders to watch.
        also: Returns further files; asked for after each round.
        pause: Waits a little.
    """
    while True:
        seen = _snapshot(paths, ())
        yield
        files = tuple(also())
        seen = {**_snapshot((), files), **seen}
        while (now := _snapshot(paths, files)) == seen:
            pause()
        while True:
            pause()
            before, now = now, _snapshot(paths, files)
            if before == now:
                break


def files_read(results: Iterable[FileResult]) -> set[str]:
    """Return the places of imports, whether there is a file or not."""
    return {entry.asked for result in results for entry in result.dependencies or ()}


def _snapshot(paths: Sequence[str | Path], files: Iterable[str]) -> Snapshot:
    found = {file: _stamp(file) for file in files}
    for path in map(Path, paths):
        found[str(path)] = None if path.is_dir() else _stamp(str(path))
        for parent in (path, *real_path(path).parents):
            for name in SETTINGS_FILES:
                found[str(parent / name)] = _stamp(str(parent / name))
        for folder, folders, names in os.walk(path):
            folders[:] = [name for name in folders if not name.startswith(".")]
            for name in names:
                if name.endswith(".osc") or name in SETTINGS_FILES:
                    place = os.path.join(folder, name)
                    found[place] = _stamp(place)
    return found


def _stamp(path: str) -> tuple[int, int] | None:
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return None
    return status.st_mtime_ns, status.st_size

"""Where `import a.b` is looked for (§7.7.5.1.2 leaves it to the implementation)."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from osc2tx.diagnostics.suggestions import nearest

SUFFIX = ".osc"
SEPARATORS = frozenset("/\\:")  # on some system


def module_place(module: Sequence[str]) -> Path | None:
    """Return the file of a module below a folder: `a/b.osc` for `a.b`.

    Returns:
        The relative path; `None` if a name of the module is none that a file may have, as names
        between bars (`|..|`) can hold anything.
    """
    if not all(map(_is_file_name, module)):
        return None
    return Path(*module[:-1], module[-1] + SUFFIX)


def _is_file_name(name: str) -> bool:
    return name.isprintable() and name[:1] not in ("", ".") and not SEPARATORS & set(name)


def places_text(place: Path, folders: Sequence[Path]) -> str:
    """Return a sentence on where a module was looked for.

    Args:
        place: Its file, relative to each of the folders.
        folders: Those besides the folder of the importing file, in the order of the search.
    """
    looked = (f"`{folder}`" + ("" if folder.is_dir() else " (no folder)") for folder in folders)
    return f"looked for `{place.as_posix()}` " + ", ".join(["beside this file", *looked])


def similar_module(module: Sequence[str], folders: Sequence[Path]) -> tuple[str, ...] | None:
    """Return the names of the module in the folders that looks most like one, if any does."""
    known = {".".join(found): found for folder in folders for found in _alike(folder, module)}
    close = nearest(".".join(module), known)
    return known[close] if close else None


def _alike(folder: Path, module: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """Yield the modules in the folder that the names lead to if each may be misspelt."""
    names: list[str] = []
    for name in module[:-1]:
        found = nearest(name, _entries(folder, is_folder=True))
        if found is None:
            return
        folder /= found
        names.append(found)
    for last in _entries(folder, is_folder=False):
        yield (*names, last)


def _entries(folder: Path, *, is_folder: bool) -> list[str]:
    """Return the folders in a folder, or its modules; no links, nothing if it is unreadable."""
    try:
        with os.scandir(folder) as entries:
            found = [
                entry.name
                for entry in entries
                if (entry.is_dir if is_folder else entry.is_file)(follow_symlinks=False)
            ]
    except OSError:
        return []
    if not is_folder:
        found = [name.removesuffix(SUFFIX) for name in found if name.endswith(SUFFIX)]
    return [name for name in found if _is_file_name(name)]

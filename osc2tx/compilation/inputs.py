"""Source files from the paths of a command line."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from osc2tx.support.paths import real_path
from osc2tx_shared.classes import dataclass


class InputError(Exception):
    """A path that cannot be used; the message names it.

    Attributes:
        unreadable: Whether the path itself is at fault; else there is nothing to do in it.
    """

    def __init__(self, message: str, *, unreadable: bool = True) -> None:
        """Take the message."""
        super().__init__(message)
        self.unreadable = unreadable


@dataclass(frozen=True, slots=True)
class Input:
    """One source file to compile.

    Attributes:
        path: Its path, as requested.
        place: The same with links among the folders followed; the file itself may be a link.
        folder: The requested folder, or the folder of the requested file.
        is_asked: Whether this very file was requested.
    """

    path: Path
    place: Path
    folder: Path
    is_asked: bool


def find_inputs(paths: Sequence[str | Path]) -> list[Input]:
    """Return the files named, and the `.osc` files of the folders named, each once.

    Folders are walked in the order of names; those that start with a dot are left out.

    Raises:
        InputError: If a path does not exist, or a folder holds no scenario file.
    """
    found: dict[Path, Input] = {}
    folders: dict[Path, Path] = {}
    for path in map(Path, paths):
        for item in _inputs_of(path, folders):
            found.setdefault(item.place, item)
    return list(found.values())


def _input(path: Path, folder: Path, folders: dict[Path, Path], *, is_asked: bool) -> Input:
    """Return an input; links are followed once for all files of a folder."""
    if path.parent not in folders:
        folders[path.parent] = real_path(path.parent)
    return Input(path, folders[path.parent] / path.name, folder, is_asked)


def _inputs_of(path: Path, known: dict[Path, Path]) -> list[Input]:
    try:
        if not path.exists():
            raise InputError(f"{path}: no such file or folder")
        if not path.is_dir():
            return [_input(path, path.parent, known, is_asked=True)]
    except (OSError, ValueError) as error:
        raise InputError(f"{str(path)!r}: {error}") from None
    inputs = []
    for folder, folders, files in os.walk(path, onerror=_refuse):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        inputs += [
            _input(Path(folder, name), path, known, is_asked=False)
            for name in sorted(files)
            if _is_source(name)
        ]
    if not inputs:
        raise InputError(f"{path}: no .osc file in this folder", unreadable=False)
    return inputs


def _is_source(name: str) -> bool:
    return name.endswith(".osc") and not name.startswith(".")


def _refuse(error: OSError) -> None:
    raise InputError(f"{error.filename}: {error.strerror}")


def is_unicode(name: str) -> bool:
    """Return whether a text file could cite a name."""
    return not any("\ud800" <= char <= "\udfff" for char in name)

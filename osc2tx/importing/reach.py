"""Which files a document may name: those of its project.

A document is untrusted, so what it names is only read inside its project: the working tree of its
version control, else the folders up to three above it; the current folder, if the document is
below it; and the folders that the user names. Links are followed first. Addresses are never read.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path

MOST_ABOVE = 3
"""Libraries keep maps and catalogs beside the folders of their scenarios."""

_ADDRESS = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:")
_DRIVE = re.compile(r"[A-Za-z]:")


class Reach:
    """The folders from which a document may name files.

    Args:
        folder: The folder of the document.
        named: Folders and files that the user names.
    """

    def __init__(self, folder: Path, named: Sequence[Path] = ()) -> None:
        real = _real(folder)
        roots = [_project(real), *(_real(each) for each in named)]
        here = _real(Path())
        if real.is_relative_to(here) and here != _top(here):
            roots.append(here)
        self._roots = tuple(dict.fromkeys(roots))

    def holds(self, path: Path) -> bool:
        """Whether a file is in one of the folders, links followed."""
        real = _real(path)
        return any(real.is_relative_to(root) for root in self._roots)

    def problem(self, named: str, folders: Sequence[Path]) -> str:
        """Return why a document may not name a file; nothing if it may.

        Args:
            named: The path in the document.
            folders: Folders that it may start from.
        """
        if "\0" in named:
            return "no path has such a name"
        if _DRIVE.match(named) is None and _ADDRESS.match(named) is not None:
            return "addresses are not read"
        if any(self.holds(folder / named) for folder in folders):
            return ""
        return "it leads out of the project"


def _real(path: Path) -> Path:
    return Path(os.path.realpath(path))


def _top(path: Path) -> Path:
    return Path(path.anchor)


def _project(folder: Path) -> Path:
    """Return the working tree that a folder is in, else the folder a few above it."""
    for each in (folder, *folder.parents):
        if (each / ".git").exists() and each != _top(each):
            return each
    above = [each for each in folder.parents[:MOST_ABOVE] if each != _top(each)]
    return above[-1] if above else folder

"""Links that lead out of the working folder: nothing is written through them.

Folders come from archives and repositories of other people. A path of the command line may lead
anywhere, but a link in such a folder is not part of what the user wrote.
"""

from __future__ import annotations

import os
from pathlib import Path


def target_outside(path: Path, folder: Path | None = None) -> str | None:
    """Return where a path leads that lies in a folder as written, but not with its links followed.

    Args:
        path: The path as written; relative to the current folder.
        folder: The folder; the current one if left out.

    Returns:
        The file that would be written; `None` if the path is in the folder, or never was.

    Raises:
        ValueError: No file can have this path.
    """
    base = os.path.realpath(folder or os.curdir)
    target = os.path.realpath(path)
    if _is_below(target, base):
        return None
    written = Path(os.path.abspath(path))
    starts_below = any(os.path.realpath(parent) == base for parent in written.parents)
    return target if starts_below else None


def _is_below(path: str, folder: str) -> bool:
    return path == folder or path.startswith(folder.rstrip(os.sep) + os.sep)

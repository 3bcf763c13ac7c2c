"""Temporary folders that a process locks: those of killed processes can be told and removed."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

if sys.platform != "win32":
    import fcntl

REVISION, CAMPAIGN = "osc2tx-revision-", "osc2tx-campaign-"
"""How the names of the folders begin: of revisions, of campaigns."""

FRESH = 60.0
"""Seconds: a folder that is younger may be one that its process is about to lock."""


@contextmanager
def own_folder(prefix: str) -> Iterator[str]:
    """Make a temporary folder; it is locked while it is in use, and removed at the end.

    Args:
        prefix: How its name begins.
    """
    from tempfile import TemporaryDirectory  # takes long to import

    with TemporaryDirectory(prefix=prefix) as folder:
        mark = hold(folder)
        try:
            yield folder
        finally:
            if mark is not None:
                os.close(mark)


def remove_left_over(prefix: str) -> None:
    """Remove the folders of processes that were killed: they are no longer locked."""
    if sys.platform == "win32":  # no locks of folders there
        return
    from shutil import rmtree
    from tempfile import gettempdir

    for folder in Path(gettempdir()).glob(f"{prefix}*"):
        with suppress(OSError):  # of another user, or removed meanwhile
            found = folder.lstat()
            if found.st_uid != os.getuid() or time.time() - found.st_mtime < FRESH:
                continue
            mark = hold(str(folder))
            if mark is not None:
                rmtree(folder, ignore_errors=True)
                os.close(mark)


def hold(folder: str) -> int | None:
    """Lock a folder until the descriptor is closed; None if it is locked, or cannot be."""
    if sys.platform == "win32":
        return None
    mark = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        fcntl.flock(mark, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(mark)
        return None
    return mark

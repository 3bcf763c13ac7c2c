"""One build at a time writes to an output folder; a second one waits for it."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from osc2tx.support.records import digest
from osc2tx_shared.cache import cache_folder

if sys.platform == "win32":
    import msvcrt

    def _take(file: IO[str], *, wait: bool) -> None:
        file.seek(0)
        msvcrt.locking(file.fileno(), msvcrt.LK_LOCK if wait else msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _take(file: IO[str], *, wait: bool) -> None:
        fcntl.flock(file, fcntl.LOCK_EX if wait else fcntl.LOCK_EX | fcntl.LOCK_NB)


_NO_LINK = getattr(os, "O_NOFOLLOW", 0)  # any user can create one among temporary files


@contextmanager
def only_build(out_dir: Path, waiting: Callable[[str], None]) -> Iterator[None]:
    """Hold the lock of an output folder; the system lets it go with the process.

    It lies in the user's cache or, without one, among temporary files: the output folder need not
    be there yet.

    Args:
        out_dir: The output folder.
        waiting: Called with the number of the process that holds the lock, if another one does.
    """
    folder = _folder()
    name = digest(os.path.realpath(out_dir).encode("utf-8", "surrogateescape"))
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        descriptor = os.open(folder / name, os.O_RDWR | os.O_CREAT | _NO_LINK, 0o600)
        file = os.fdopen(descriptor, "r+", encoding="ascii")
    except OSError:  # nothing can be written anywhere: the build will say so
        yield
        return
    with file:
        try:
            _take(file, wait=False)
        except OSError:
            file.seek(0)
            waiting(file.read(20).strip() or "?")
            _take(file, wait=True)
        file.seek(0)
        file.truncate()
        file.write(f"{os.getpid()}\n")
        file.flush()
        yield


def _folder() -> Path:
    from tempfile import gettempdir

    user = str(os.getuid()) if hasattr(os, "getuid") else ""
    return (cache_folder() or Path(gettempdir(), f"osc2tx-{user}")) / "locks"

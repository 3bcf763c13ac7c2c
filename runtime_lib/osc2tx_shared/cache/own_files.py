"""Files in the user's cache folder, read only if no other user can have written them.

Their content affects the results of osc2tx and its runtime, so a folder or a file that belongs to
another user, or that others may write, is not read. `OSC2TX_NO_CACHE=1` disables the cache.
"""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Callable
from pathlib import Path

# Links are not followed, and a pipe instead of the file does not block.
_READ_FLAGS = os.O_RDONLY
_WRITE_FLAGS = os.O_WRONLY | os.O_CREAT | os.O_EXCL
for _flag in ("O_NOFOLLOW", "O_NONBLOCK", "O_BINARY"):
    _READ_FLAGS |= getattr(os, _flag, 0)
    _WRITE_FLAGS |= getattr(os, _flag, 0)


def cache_folder(wanted: Path | None = None) -> Path | None:
    """Return the folder of osc2tx in the user's cache, by the conventions of the platform.

    `platformdirs` gives the same result, but its import takes longer than loading a snapshot.

    Args:
        wanted: Another folder to use instead.
    """
    if os.environ.get("OSC2TX_NO_CACHE"):
        return None
    if wanted is not None:
        return wanted
    home = os.path.expanduser("~")
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA", "")
    elif sys.platform == "darwin":
        base = os.path.join(home, "Library", "Caches")
    else:
        base = os.environ.get("XDG_CACHE_HOME", "")
        base = base if os.path.isabs(base) else os.path.join(home, ".cache")
    return Path(base, "osc2tx") if os.path.isabs(base) else None


def read_own(path: Path) -> bytes | None:
    """Return the bytes of a file if file and folder are the user's own; `None` if not."""
    try:
        if not _is_ours(os.lstat(path.parent), stat.S_ISDIR):
            return None
        descriptor = os.open(path, _READ_FLAGS)
        with os.fdopen(descriptor, "rb") as stream:
            return stream.read() if _is_ours(os.fstat(descriptor), stat.S_ISREG) else None
    except OSError:
        return None


def write_own(path: Path, data: bytes) -> bool:
    """Write a file atomically; return whether that was possible."""
    folder = path.parent
    temporary = folder / f".{path.name}.{os.urandom(8).hex()}"  # `tempfile` takes long to import
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not _is_ours(os.lstat(folder), stat.S_ISDIR):
            return False
        descriptor = os.open(temporary, _WRITE_FLAGS, 0o600)
    except OSError:
        return False
    try:
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(data)
        os.replace(temporary, path)
    except OSError:
        temporary.unlink(missing_ok=True)
        return False
    return True


def evict_oldest(folder: Path, most: int) -> None:
    """Keep only this number of files of a folder, the most recent ones."""
    try:
        files = [(entry.stat().st_mtime_ns, entry.path) for entry in os.scandir(folder)]
        for _, path in sorted(files, reverse=True)[most:]:
            os.unlink(path)
    except OSError:  # another process does the same
        return


def _is_ours(status: os.stat_result, is_kind: Callable[[int], bool]) -> bool:
    """Whether a file or folder has a type, belongs to the user, and no other user may write it."""
    if not is_kind(status.st_mode):
        return False
    if sys.platform in ("win32", "emscripten"):
        return True  # user profiles and page memory are not accessible to others
    return status.st_uid == os.geteuid() and not status.st_mode & 0o022

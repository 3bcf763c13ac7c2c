"""Snapshots: plain data computed by code, kept for the next process.

A snapshot is data, not code: a forged one could at most falsify the data read from it, which
requires write access to a folder of the user (`own_files`). A snapshot is not used if it is
damaged, or comes from other inputs, other code or another Python.
"""

from __future__ import annotations

import marshal
import os
import sys
import time
from pathlib import Path
from typing import Any
from zlib import crc32

from osc2tx_shared.cache.own_files import cache_folder, read_own, write_own

_CHECKSUM = 4  # bytes of the checksum after the magic word
_STARTED = time.time_ns()

Stamp = tuple[object, ...]


class Snapshots:
    """The snapshots of one kind.

    Args:
        kind: The first line of their files: their content, the number of their format, and the
            version of the code if it has one.
        code: The folder of the code that computes them.
        parts: The folders below it whose modules affect their content.
    """

    def __init__(self, kind: str, code: Path, parts: tuple[str, ...]) -> None:
        self._magic = f"{kind}\n".encode()
        self._code, self._parts = code, parts

    def path(self, name: str) -> Path | None:
        """Return the file of a snapshot, `None` without a cache.

        Each installation has its own file.
        """
        folder = cache_folder()
        place = crc32(str(self._code).encode("utf-8", "surrogateescape"))
        tag = sys.implementation.cache_tag
        return folder and folder / f"{name}-{tag}-{place:08x}.snapshot"

    def load(self, name: str, made_of: object) -> Any | None:
        """Return the data of a valid snapshot, `None` without one.

        Args:
            name: Of the snapshot.
            made_of: The inputs of the data, as plain data.
        """
        path, stamp = self.path(name), self._stamp()
        if path is None or stamp is None:
            return None
        found = read_own(path)
        if found is None or not found.startswith(self._magic):
            return None
        start = len(self._magic) + _CHECKSUM
        if found[len(self._magic) : start] != _checksum(found[start:]):
            return None
        try:
            found_stamp, found_source, data = marshal.loads(found[start:])
        except (EOFError, ValueError, TypeError):
            return None
        return data if (found_stamp, found_source) == (stamp, made_of) else None

    def save(self, name: str, made_of: Any, data: Any) -> Path | None:
        """Keep plain data for the next process; return the file if possible."""
        path, stamp = self.path(name), self._stamp()
        if path is None or stamp is None:
            return None
        contents: Any = (stamp, made_of, data)
        content = marshal.dumps(contents)
        is_kept = write_own(path, self._magic + _checksum(content) + content)
        return path if is_kept else None

    def _stamp(self) -> Stamp | None:
        """Return the identity of the code: Python, and its files.

        `None` if it is unknown: the files are missing, or changed after this process began.
        """
        files: list[tuple[str, int, int]] = []
        try:
            for part in self._parts:
                with os.scandir(self._code / part) as entries:
                    for entry in entries:
                        if entry.name.endswith(".py"):
                            status = entry.stat()
                            files.append((entry.name, status.st_size, status.st_mtime_ns))
        except OSError:
            return None
        if not files or max(changed for _, _, changed in files) > _STARTED:
            return None
        return (sys.version_info[:3], *sorted(files))


def _checksum(content: bytes) -> bytes:
    """Detects damage; forgery is excluded by the permissions of the folder."""
    return crc32(content).to_bytes(_CHECKSUM, "big")

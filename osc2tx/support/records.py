"""Digests, and records in the cache, each under a digest of all that it depends on."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

from osc2tx_shared.cache import evict_oldest, read_own, write_own

MOST_FILES = 128  # in each of the 256 folders


def digest(data: bytes) -> str:
    """Return the digest of a text: half of SHA-256."""
    return hashlib.sha256(data).hexdigest()[:32]


class Records:
    """A folder of records, as JSON."""

    def __init__(self, folder: Path, stamp: str) -> None:
        """Take the folder.

        Args:
            folder: The folder.
            stamp: Identifies the program on which records depend as well.
        """
        self._folder, self._stamp = folder, stamp

    def place(self, *parts: object) -> Path:
        """Return the file of a record.

        Args:
            parts: All that it depends on, besides the program.
        """
        name = digest(json.dumps([self._stamp, *parts]).encode())
        return self._folder / name[:2] / name[2:]

    def read(self, place: Path) -> dict[str, Any] | None:
        """Return a record; `None` if there is none, or a damaged one."""
        try:
            found = json.loads(read_own(place) or b"null")
        except (ValueError, RecursionError):
            return None
        return found if isinstance(found, dict) else None

    def write(self, place: Path, record: dict[str, Any]) -> None:
        """Store a record; not being able to is no problem."""
        if write_own(place, json.dumps(record).encode()):
            evict_oldest(place.parent, MOST_FILES)

"""Snapshots of maps in the user's cache folder: a large map is parsed once.

The key of a snapshot is the content of a map and the code that read it.
"""

from __future__ import annotations

import stat
from dataclasses import replace
from pathlib import Path

from osc2tx_shared.cache import Snapshots, evict_oldest

from .packed_map import PackingError, pack, unpack
from .reader import MapContent, read_content

SMALLEST = 200_000
"""Least size (bytes) of a map with a snapshot."""

MOST_KEPT = 64
"""Greatest number of snapshots; each has at most a fifth of the size of its map."""

SNAPSHOTS = Snapshots(
    kind="OpenDRIVE map 1",
    code=Path(__file__).resolve().parent.parent,
    parts=("opendrive", "."),
)


def read_content_once(path: Path) -> MapContent:
    """Reads a file, or its snapshot if that is trustworthy.

    Raises:
        MapError: The file is not a usable OpenDRIVE map.
    """
    digest = _digest(path)
    if digest is None:
        return read_content(path)
    name = f"maps/{digest[:32]}"
    packed = SNAPSHOTS.load(name, digest)
    if packed is not None:
        try:
            return replace(unpack(packed), file=str(path), name=path.stem)
        except PackingError:
            pass  # as without a snapshot
    content = read_content(path)
    if _digest(path) == digest:  # unchanged meanwhile
        kept = SNAPSHOTS.save(name, digest, pack(content))
        if kept is not None:
            evict_oldest(kept.parent, MOST_KEPT)
    return content


def _digest(path: Path) -> str | None:
    """Return the digest of a large file; `None` for others, and for unreadable files."""
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode) or status.st_size < SMALLEST:
            return None
        import hashlib  # most maps are small

        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return None

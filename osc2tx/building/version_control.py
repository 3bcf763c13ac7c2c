"""Files of a folder as the last commit has them."""

from __future__ import annotations

import hashlib
import subprocess
from collections.abc import Mapping
from pathlib import Path

_HASHES = {40: hashlib.sha1, 64: hashlib.sha256}
"""Digits of an object's name to what makes it."""


def committed_objects(folder: Path) -> Mapping[str, str]:
    """Return the files below a folder in the last commit, each with the name of its object.

    There are none without git, outside of repositories, and before the first commit. Git only lists
    what it has stored; no command of the repository's settings is run.
    """
    try:
        ended = subprocess.run(
            ["git", "-C", str(folder), "ls-tree", "-r", "-z", "HEAD"],
            capture_output=True,
            check=False,
        )
    except OSError:
        return {}
    objects = {}
    for line in ended.stdout.decode("utf-8", "surrogateescape").split("\0"):
        head, _, path = line.partition("\t")
        if path:
            objects[path] = head.rpartition(" ")[2]
    return objects


def is_object(data: bytes, name: str) -> bool:
    """Return whether git stores a text under a name."""
    blob = b"blob %d\0%b" % (len(data), data)
    return _HASHES[len(name)](blob).hexdigest() == name

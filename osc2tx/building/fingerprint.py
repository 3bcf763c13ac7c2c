"""The stamp that identifies this installation of osc2tx."""

from __future__ import annotations

import hashlib
import os
import sys
import time
from collections.abc import Iterator
from functools import cache
from importlib.util import find_spec
from operator import attrgetter
from pathlib import Path

from osc2tx.resources import resource_dir
from osc2tx.support.records import digest
from osc2tx.version import __version__
from osc2tx_shared.cache import read_own, write_own

_PACKAGE = Path(__file__).resolve().parent.parent
_KINDS = (".py", ".osc", ".json", ".toml", ".j2", ".xodr")

# What else reports and outputs depend on: the rules of calls, how texts are escaped, and, as
# OpenSCENARIO XML holds its sizes, courses and maps, the runtime. Of the others one file tells the
# version.
_OURS = ("osc2tx_shared.classes", "osc2tx_shared.rules", "osc2tx_runtime", "osc2tx_shared.text")
_LIBRARIES = ("antlr4", "black", "jinja2", "pint")
STARTED = time.time_ns()
_VERSIONS = f"{__version__} {sys.version_info[:3]}"


@cache
def tool_stamp(folder: Path) -> str | None:
    """Return what identifies this osc2tx: its files, its libraries, the Python that runs it.

    The version alone would not do: between two versions the compiler, the templates and the
    table of the runtime's interface change as well. Contents count, so that all installations of
    the same code have the same stamp; they are read again once sizes or times of files changed, as
    for Python's own cache of compiled modules.

    It is worked out once: this process goes on with the files that it began with.

    Args:
        folder: Folder of the cache, which remembers the stamp of this installation.

    Returns:
        The stamp; `None` if it is unknown, as a file changed after this process began.
    """
    files = list(_files())
    if any(status.st_mtime_ns > STARTED for _, _, status in files):
        return None
    seen = [f"{path} {status.st_size} {status.st_mtime_ns}" for _, path, status in files]
    place = (
        folder / "stamps" / digest("\n".join((_VERSIONS, *seen)).encode("utf-8", "surrogateescape"))
    )
    known = read_own(place)
    if known is not None and len(known) == 32 and known.isalnum():
        return known.decode()
    found = hashlib.sha256(_VERSIONS.encode())
    for name, path, _ in files:
        with open(path, "rb", buffering=0) as stream:  # in half the time of `read_bytes`
            found.update(f"\0{name}\0".encode() + stream.read())
    stamp = found.hexdigest()[:32]
    write_own(place, stamp.encode())
    return stamp


def _files() -> Iterator[tuple[str, str, os.stat_result]]:
    """Yield the files that decide what comes out: name, path and state, in a fixed order."""
    folders = [("", str(_PACKAGE)), ("templates", str(resource_dir("templates")))]
    for name in (*_OURS, *_LIBRARIES):
        spec = find_spec(name)
        if spec is None or spec.origin is None:
            continue
        if name in _OURS:
            folders.append((name, os.path.dirname(spec.origin)))
        else:
            yield name, spec.origin, os.stat(spec.origin)
    while folders:  # a thousand files, looked at by each process: loops without calls of ours
        inner, folder = folders.pop()
        for entry in sorted(os.scandir(folder), key=attrgetter("name")):
            own = entry.name
            if own.endswith(_KINDS):
                yield f"{inner}/{own}", entry.path, entry.stat()
            elif "." not in own and own != "__pycache__" and entry.is_dir():
                folders.append((f"{inner}/{own}", entry.path))

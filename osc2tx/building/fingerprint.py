"""Digests of texts, and the stamp that identifies this installation of osc2tx."""

from __future__ import annotations

import hashlib
import os
import sys
import time
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

from osc2tx.resources import resource_dir
from osc2tx.version import __version__

_PACKAGE = Path(__file__).resolve().parent.parent
_KINDS = (".py", ".osc", ".json", ".toml", ".j2", ".xodr")

# What else reports and outputs depend on: the rules of calls, how texts are escaped, and, as
# OpenSCENARIO XML holds its sizes, courses and maps, the runtime. Of the others one file tells the
# version.
_OURS = ("osc2tx_shared.classes", "osc2tx_shared.rules", "osc2tx_runtime", "osc2tx_shared.text")
_LIBRARIES = ("antlr4", "black", "jinja2", "lxml", "pint")
_STARTED = time.time_ns()


def digest(data: bytes) -> str:
    """Return the digest of a text: half of SHA-256, so that lines of the manifest stay short."""
    return hashlib.sha256(data).hexdigest()[:32]


def tool_stamp() -> str | None:
    """Return what identifies this osc2tx: all its files, its libraries, the Python that runs it.

    The version alone would not do: between two versions the compiler, the templates and the
    table of the runtime's interface change as well. Sizes and times of files count, as for Python's
    own cache of compiled modules.

    Returns:
        The stamp; `None` if it cannot be told, as a file changed after this process began.
    """
    found = [f"{__version__} {sys.version_info[:3]}"]
    for path, status in _files():
        if status.st_mtime_ns > _STARTED:
            return None
        found.append(f"{path} {status.st_size} {status.st_mtime_ns}")
    return digest("\n".join(found).encode("utf-8", "surrogateescape"))


def _files() -> Iterator[tuple[str, os.stat_result]]:
    """Yield the files that decide what comes out, in a fixed order."""
    folders = [str(_PACKAGE), str(resource_dir("templates"))]
    for name in (*_OURS, *_LIBRARIES):
        spec = find_spec(name)
        if spec is None or spec.origin is None:
            continue
        if name in _OURS:
            folders.append(os.path.dirname(spec.origin))
        else:
            yield spec.origin, os.stat(spec.origin)
    while folders:
        with os.scandir(folders.pop()) as entries:
            for entry in sorted(entries, key=lambda entry: entry.name):
                if entry.is_dir():
                    folders.append(entry.path)
                elif entry.name.endswith(_KINDS):
                    yield entry.path, entry.stat()

"""Digests of the outputs as osc2tx wrote them into a folder on this machine.

They tell an output that may be replaced from one that was edited by hand, and which source made it.
They lie beside the outputs, in a folder that git ignores; without them, as after a clone, version
control tells.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import NamedTuple

FOLDER = ".osc2tx"
DIGESTS_NAME = f"{FOLDER}/written.json"
IGNORE_NAME = f"{FOLDER}/.gitignore"
IGNORE_TEXT = "*\n"
FORMAT = 2


class Written(NamedTuple):
    """An output that osc2tx wrote.

    Attributes:
        source: The source that makes it.
        digests: The digests that it may have; two while a build replaces it.
    """

    source: str
    digests: tuple[str, ...]


Digests = Mapping[str, Written]
"""Path of an output to its records."""


def read_digests(out_dir: Path) -> Digests:
    """Return the records of a folder; nothing if the file is missing or damaged."""
    try:
        document = json.loads((out_dir / DIGESTS_NAME).read_bytes())
        if document["format"] != FORMAT:
            return {}
        return {
            path: Written(str(source), tuple(digests))
            for path, (source, *digests) in document["digests"].items()
            if is_inside(path)
        }
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}


def render_digests(digests: Digests) -> str:
    """Return the text of the file."""
    listed = {path: [entry.source, *entry.digests] for path, entry in sorted(digests.items())}
    document = {"format": FORMAT, "digests": listed}
    return json.dumps(document, ensure_ascii=False, indent=1) + "\n"


def is_inside(path: str) -> bool:
    """Return whether a path stays in the output folder, on any system."""
    parts = PurePosixPath(path).parts
    windows = PureWindowsPath(path)
    is_plain = bool(parts) and "/".join(parts) == path and ".." not in windows.parts
    return is_plain and "\0" not in path and not (windows.drive or windows.root)

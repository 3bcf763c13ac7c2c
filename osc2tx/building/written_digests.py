"""Digests of the outputs as osc2tx wrote them into a folder on this machine.

They tell an output that may be replaced from one that was edited by hand. They lie beside the
outputs, in a folder that git ignores; without them, as after a clone, version control tells.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

FOLDER = ".osc2tx"
DIGESTS_NAME = f"{FOLDER}/written.json"
IGNORE_NAME = f"{FOLDER}/.gitignore"
IGNORE_TEXT = "*\n"
FORMAT = 1

Digests = Mapping[str, tuple[str, ...]]
"""Path of an output to the digests that it may have; two while a build replaces it."""


def read_digests(out_dir: Path) -> Digests:
    """Return what is known of a folder; nothing if the file is missing or damaged."""
    try:
        document = json.loads((out_dir / DIGESTS_NAME).read_bytes())
        if document["format"] != FORMAT:
            return {}
        return {path: tuple(digests) for path, digests in document["digests"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}


def render_digests(digests: Digests) -> str:
    """Return the text of the file."""
    document = {"format": FORMAT, "digests": dict(sorted(digests.items()))}
    return json.dumps(document, ensure_ascii=False, indent=1) + "\n"

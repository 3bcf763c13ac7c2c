"""Writes source files that a command corrects or lays out."""

from __future__ import annotations

from pathlib import Path

from osc2tx.building.write import replace_file
from osc2tx.cli.reporting import Exit
from osc2tx.support.paths import real_path
from osc2tx_shared.links import target_outside
from osc2tx_shared.text import complain


def write_source(path: Path, data: bytes) -> Exit:
    """Replace a source file in one step; complain if it is not ours to write or cannot be."""
    target = target_outside(path)
    if target is not None:
        complain(f"{path}: a link leads to {target}, out of the current folder; name that file")
        return Exit.UNREADABLE
    try:
        replace_file(real_path(path), data)
    except OSError as error:
        complain(f"{path}: cannot be written: {error.strerror}")
        return Exit.UNREADABLE
    return Exit.OK

"""Changes of files: printed as diffs, in color on a terminal, or written."""

from __future__ import annotations

from pathlib import Path

import click

from osc2tx.building.write import replace_file
from osc2tx.cli.reporting import Exit, wants_color
from osc2tx.support.paths import real_path
from osc2tx_shared.links import target_outside
from osc2tx_shared.text import complain, put, visible

_STYLES = {"+": "green", "-": "red", "@": "cyan"}


def print_diff(path: str, old: str | None, new: str | None) -> None:
    """Print how an output changes."""
    from osc2tx.building.compare import diff_lines  # loads the code that extracts revisions

    color = wants_color()
    for line in diff_lines(visible(path), old, new):
        put(_painted(line) if color else line, colored=color)


def _painted(line: str) -> str:
    text = "\t".join(map(visible, line.removesuffix("\n").split("\t")))
    if line.startswith(("+++", "---")):
        return click.style(text, bold=True)
    return click.style(text, fg=_STYLES[line[0]]) if line[0] in _STYLES else text


def read_text(path: Path) -> str | None:
    """Return the present content of a file; `None` if there is none."""
    try:
        return None if path.is_symlink() else path.read_text(encoding="utf-8", errors="replace")
    except (FileNotFoundError, NotADirectoryError, IsADirectoryError):
        return None


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

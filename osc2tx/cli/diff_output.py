"""Prints diffs, in color on a terminal."""

from __future__ import annotations

from pathlib import Path

import click

from osc2tx.cli.reporting import wants_color
from osc2tx_shared.text import put, visible

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

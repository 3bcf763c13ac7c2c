"""Prints diffs, in color on a terminal."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import click

from osc2tx.building.diff import diff_lines

_STYLES = {"+": "green", "-": "red", "@": "cyan"}


def print_diff(path: str, old: str | None, new: str | None) -> None:
    """Print how an output changes."""
    is_terminal = sys.stdout.isatty()
    color = is_terminal and "NO_COLOR" not in os.environ
    for line in diff_lines(path, old, new):
        text = _printable(line) if is_terminal else line
        if color and line.startswith(("+++", "---")):
            text = click.style(text, bold=True)
        elif color and line[0] in _STYLES:
            text = click.style(text, fg=_STYLES[line[0]])
        click.echo(text, nl=False, color=color)


def read_text(path: Path) -> str | None:
    """Return what a file says now; `None` if there is none."""
    try:
        return None if path.is_symlink() else path.read_text(encoding="utf-8", errors="replace")
    except (FileNotFoundError, NotADirectoryError, IsADirectoryError):
        return None


def _printable(line: str) -> str:
    """Keep what somebody wrote into a file from steering the terminal."""
    return "".join(char if char >= " " or char in "\n\t" else "\ufffd" for char in line)

"""Sources that a command works on where its command line names none."""

from __future__ import annotations

import os
from pathlib import Path

import click

from osc2tx.config import Config, ConfigFiles


def sources_or_stated(paths: tuple[str, ...], what: str) -> tuple[str, ...]:
    """Return the paths of a command line, or those of the settings of this folder.

    Args:
        paths: What was written.
        what: What the command does to them, as in `check`.

    Raises:
        click.UsageError: If there are neither.
    """
    return paths or stated_sources(ConfigFiles().for_folder(Path.cwd()), what)


def stated_sources(project: Config, what: str) -> tuple[str, ...]:
    """Return the `sources` of a settings file, as somebody in this folder would write them.

    Raises:
        click.UsageError: If it states none.
    """
    if not project.sources:
        raise click.UsageError(f"say what to {what}: name a file or folder, or set `sources`")
    return tuple(str(seen_from(path, Path.cwd())) for path in project.sources)


def seen_from(path: Path, folder: Path) -> Path:
    """Return a path as somebody who works in a folder would write it."""
    path = Path(os.path.normpath(path))
    return path.relative_to(folder) if path.is_relative_to(folder) else path

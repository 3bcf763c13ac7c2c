"""Texts from standard input, as editors and hooks give them."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from osc2tx.building.jobs import Job, job_of_text
from osc2tx.compilation.inputs import InputError
from osc2tx.config import GivenOptions

WORD = "-"
UNNAMED = "stdin.osc"

stdin_filename = click.option(
    "--stdin-filename",
    metavar="PATH",
    help="With `-` for PATH: path of the text, for messages, settings and imports.",
)


def is_standard_input(paths: tuple[str, ...], name: str | None) -> bool:
    """Whether a command line requests the text of standard input.

    Raises:
        click.UsageError: If it requests files as well, or names a file that it does not request.
    """
    if WORD in paths and len(paths) > 1:
        raise click.UsageError("`-` is standard input, and cannot be combined with other paths")
    if name is not None and WORD not in paths:
        raise click.UsageError("--stdin-filename requires `-`, the text of standard input")
    return paths == (WORD,)


def job_of_standard_input(name: str | None, given: GivenOptions) -> tuple[Job, str]:
    """Return how to compile the text on standard input, and the text.

    Raises:
        InputError: If it is no text in UTF-8.
    """
    data = sys.stdin.buffer.read()
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"standard input: no UTF-8 at byte offset {error.start}") from None
    path = Path(name or UNNAMED)
    return job_of_text(path.name, path.parent, given), text

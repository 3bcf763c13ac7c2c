"""The files that a run writes: they replace only files of earlier runs, and are never partial."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from osc2tx_runtime.errors import InputError, SettingsError
from osc2tx_runtime.language.settings import RunSettings

__all__ = ["check_outputs", "may_replace", "write_output"]

BEGINS = {
    "trace": (b'{"kind":"header"',),
    "report": (b"<!DOCTYPE html>",),
    "table": (b"number,seed,", b'{"number": '),
    "summary": (b'{\n "format": ',),
    "junit": (b'<?xml version="1.0" encoding="UTF-8"?>\n<testsuites',),
}
"""Begins of the files that are written; a file to overwrite must have the same begin."""


def check_outputs(settings: RunSettings) -> None:
    """Refuse to overwrite what no run has written: a scenario, a map, a report by a trace.

    Raises:
        SettingsError: An output would.
    """
    places = {"trace": settings.trace, "report": settings.report}
    try:
        given = {name: Path(os.path.realpath(path)) for name, path in places.items() if path}
    except ValueError as error:
        raise SettingsError(f"--trace or --report: no file can have this name: {error}") from None
    if len(set(given.values())) < len(given):
        raise SettingsError(f"--trace and --report are both {settings.trace}: give them two files")
    for name, path in given.items():
        if not may_replace(name, path):
            raise SettingsError(
                f"--{name} {places[name]}: there is a file, and it is no {name}; name another one"
            )


def may_replace(name: str, path: Path) -> bool:
    """Return whether a file is missing, or was written by this name."""
    begins = BEGINS[name]
    try:
        if not path.is_file() or path.stat().st_size == 0:
            return True
        with path.open("rb") as file:
            return file.read(max(map(len, begins))).startswith(begins)
    except (OSError, ValueError):  # writing it will report the error
        return True


def write_output(name: str, path: Path, text: str) -> None:
    """Write a file and the folders above it; one that is there is replaced at once.

    Raises:
        InputError: If that is not possible; the file that was there still is.
    """
    place = Path(os.path.realpath(path))
    temporary = place.with_name(f".{place.name[:200]}.{os.getpid()}.osc2tx-tmp")
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        if place.exists() and not place.is_file():  # a device, a pipe
            place.write_text(text, encoding="utf-8", newline="\n")
            return
        temporary.write_text(text, encoding="utf-8", newline="\n")
        os.replace(temporary, place)
    except (OSError, ValueError) as error:
        with suppress(OSError, ValueError):
            temporary.unlink(missing_ok=True)
        raise InputError(f"the {name} cannot be written: {error}") from error

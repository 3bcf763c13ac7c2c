"""The files that a run writes: they replace only files of earlier runs, and are never partial."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from osc2tx_runtime.errors import InputError, SettingsError
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_shared.links import target_outside

BEGINS = {
    "trace": (b'{"kind":"header"',),
    "report": (b"<!DOCTYPE html>",),
    "table": (b"number,seed,", b'{"number": '),
    "summary": (b'{\n "format": ',),
    "junit": tuple(  # of campaigns, and of pytest
        b'<?xml version="1.0" encoding="%b<testsuites' % rest
        for rest in (b'UTF-8"?>\n', b'utf-8"?>')
    ),
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
    for name in given:
        problem = problem_of(name, places[name] or Path())
        if problem is not None:
            raise SettingsError(f"--{name} {problem}")


def problem_of(name: str, path: Path) -> str | None:
    """Return why a file must not be written, if so.

    It replaces only a file that was written by this name, and does not follow a link out of the
    current folder.
    """
    try:
        target = target_outside(path)
    except ValueError:  # writing it will report the error
        return None
    if target is not None:
        return f"{path}: a link leads to {target}, out of the current folder; name that file"
    if not _may_replace(name, path):
        return f"{path}: there is a file, and it is no {name}; name another one"
    return None


def _may_replace(name: str, path: Path) -> bool:
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

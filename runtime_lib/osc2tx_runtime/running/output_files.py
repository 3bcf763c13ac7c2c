"""The files that a run writes: they replace only files of earlier runs, and are never partial."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TextIO

from osc2tx_runtime.errors import InputError, SettingsError
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_shared.links import target_outside

BEGINS = {
    "trace": (b'{"kind":"header"',),
    "report": (b"<!DOCTYPE html>",),
    "page": (b"<!DOCTYPE html>",),
    "table": (b"number,seed,", b'{"number": '),
    "summary": (b'{\n "format": ',),
    "junit": tuple(  # of campaigns, and of pytest
        b'<?xml version="1.0" encoding="%b<testsuites' % rest
        for rest in (b'UTF-8"?>\n', b'utf-8"?>')
    ),
}
"""First characters of the written files; a file to overwrite must start with them."""


def check_outputs(settings: RunSettings) -> None:
    """Reject overwriting files that no run has written: a scenario, a map, a report by a trace.

    Raises:
        SettingsError: An output would overwrite one.
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
    """Return why a file must not be written; empty if it may.

    It only replaces a file of the same kind, and does not follow a link out of the current folder.
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
    """Return whether a file is missing, or of the same kind."""
    begins = BEGINS[name]
    try:
        if not path.is_file() or path.stat().st_size == 0:
            return True
        with path.open("rb") as file:
            return file.read(max(map(len, begins))).startswith(begins)
    except (OSError, ValueError):  # writing it will report the error
        return True


class OutputFile:
    """A file that is written line by line, and the folders above it.

    It has a temporary name until it is complete, and then replaces an existing file atomically. It
    is opened with its first lines.

    Args:
        name: Its kind, for messages.
        path: Its path.
    """

    def __init__(self, name: str, path: Path) -> None:
        self._name = name
        self._place = Path(os.path.realpath(path))
        self._temporary = self._place.with_name(
            f".{self._place.name[:200]}.{os.getpid()}.osc2tx-tmp"
        )
        self._file: TextIO | None = None
        self._is_given_up = False

    def take(self, lines: Iterable[str]) -> None:
        """Write lines, which have no line ends.

        Raises:
            InputError: It cannot be written; an existing file is unchanged.
        """
        self.write("".join(f"{line}\n" for line in lines))

    def write(self, text: str) -> None:
        """Write a text; errors as in `take`."""
        if not self._is_given_up:
            with self._giving_up():
                self._file = self._file or self._opened()
                self._file.write(text)

    def close(self) -> None:
        """Move the file to its path, if anything was written.

        Raises:
            InputError: It cannot be written; an existing file is unchanged.
        """
        if self._file is not None and not self._is_given_up:
            with self._giving_up():
                self._file.close()
                if self._temporary.exists():
                    os.replace(self._temporary, self._place)

    def _opened(self) -> TextIO:
        self._place.parent.mkdir(parents=True, exist_ok=True)
        is_special = self._place.exists() and not self._place.is_file()  # a device, a pipe
        place = self._place if is_special else self._temporary
        return place.open("w", encoding="utf-8", newline="\n")

    @contextmanager
    def _giving_up(self) -> Iterator[None]:
        """Remove an incomplete file."""
        try:
            yield
        except (OSError, ValueError) as error:
            self._is_given_up = True
            with suppress(OSError, ValueError):
                if self._file is not None:
                    self._file.close()
            with suppress(OSError, ValueError):
                self._temporary.unlink(missing_ok=True)
            raise InputError(f"the {self._name} cannot be written: {error}") from error


def write_output(name: str, path: Path, text: str) -> None:
    """Write a file and the folders above it; an existing file is replaced atomically.

    Raises:
        InputError: It cannot be written; an existing file is unchanged.
    """
    file = OutputFile(name, path)
    file.write(text)
    file.close()

"""The exception for map files."""

from __future__ import annotations


class MapError(Exception):
    """A map cannot be read, or a query refers to an element that the map does not have.

    Attributes:
        file: Path or name of the map.
        line: Line in the file (1-based), None if unknown.
        message: Description of the error and its remedy.
    """

    def __init__(self, file: str, message: str, line: int | None = None) -> None:
        self.file = file
        self.line = line
        self.message = message
        where = file if line is None else f"{file}:{line}"
        super().__init__(f"{where}: {message}")

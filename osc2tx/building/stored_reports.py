"""Diagnostics and other parts of results as plain lists for `result_cache`, and back again.

A list begins with what it is: `tuple`, or a class and then its fields. A span has the number of its
text, its start and its end; source texts are read again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from enum import Enum
from pathlib import Path
from typing import Any

from osc2tx.building.places import Places
from osc2tx.building.results import OutputRecord
from osc2tx.compilation.file_reports import LossEntry
from osc2tx.diagnostics import Diagnostic, Label, Severity, SourceFile, Span
from osc2tx.diagnostics.fixes import Edit, Fix
from osc2tx.diagnostics.report import ScenarioEntry

_CLASSES = (Diagnostic, Edit, Fix, Label, LossEntry, OutputRecord, ScenarioEntry, Severity)
CLASSES: Mapping[str, Callable[..., Any]] = {each.__name__: each for each in _CLASSES}
TUPLE, SPAN, SOURCE = "tuple", "Span", "SourceFile"


class StoredTexts:
    """The source texts of a record, and the values that point into them.

    Args:
        source: The file itself, the first text.
        places: Its folders, from which paths are stored.
    """

    def __init__(self, source: SourceFile, places: Places) -> None:
        self._sources = [source]
        self._places = places

    def write(self, value: Any) -> Any:
        """Return a value as JSON."""
        match value:
            case Span():
                return [SPAN, self._number(value.source), value.start, value.end]
            case SourceFile():
                return [SOURCE, self._number(value)]
            case tuple():
                return [TUPLE, *map(self.write, value)]
            case Enum():
                return [type(value).__name__, value.value]
        if type(value).__name__ in CLASSES:
            own = (getattr(value, field.name) for field in fields(value))
            return [type(value).__name__, *map(self.write, own)]
        return dict(value) if isinstance(value, Mapping) else value

    def read(self, stored: Any) -> Any:
        """Return a value that was written.

        Raises:
            KeyError, IndexError, TypeError, ValueError: Nothing that was written.
        """
        if not isinstance(stored, list):
            return stored
        kind, *values = stored
        if kind == SPAN:
            return Span(self._sources[values[0]], *values[1:])
        if kind == SOURCE:
            return self._sources[values[0]]
        own = tuple(map(self.read, values))
        return own if kind == TUPLE else CLASSES[kind](*own)

    def _number(self, source: SourceFile) -> int:
        for index, known in enumerate(self._sources):
            if known is source:
                return index
        self._sources.append(source)
        return len(self._sources) - 1

    def write_others(self, keep: Callable[[str], str]) -> list[Any]:
        """Return the texts after the first: name, path, digest if it is one of the library.

        Args:
            keep: Stores a text of the library; returns its digest.
        """
        return [
            (
                [each.name, None, keep(each.text)]
                if each.path is None
                else [each.name, self._places.write(str(each.path)), None]
            )
            for each in self._sources[1:]
        ]

    def read_others(
        self,
        others: Sequence[Sequence[Any]],
        text_of: Callable[[str], bytes | None],
        library: Callable[[str], str],
    ) -> None:
        """Add the texts that were written.

        Args:
            others: As `write_others` returns them.
            text_of: Returns the text of a file.
            library: Returns a text of the library by its digest.

        Raises:
            ValueError: There is no such text any more.
        """
        for name, written, key in others:
            if written is None:
                self._sources.append(SourceFile(name, library(key)))
                continue
            path = self._places.read(written)
            data = text_of(path)
            if data is None:
                raise ValueError(path)
            self._sources.append(SourceFile(name, data.decode(), Path(path)))

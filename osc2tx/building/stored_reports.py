"""Diagnostics as plain lists for `result_cache`; source texts are read again."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from osc2tx.diagnostics import Diagnostic, Label, Severity, SourceFile, Span
from osc2tx.diagnostics.fixes import Edit, Fix
from osc2tx.diagnostics.report import ScenarioEntry
from osc2tx.support.records import digest


class ReportWriter:
    """Writes the reports of one source file; places are index of the text, start, end.

    Attributes:
        library: The texts of the library that are pointed into, by digest.
    """

    def __init__(self, source: SourceFile, write: Callable[[str], str]) -> None:
        """Begin with the file itself as text 0.

        Args:
            source: The file.
            write: Returns the text to store for a path.
        """
        self._sources = [source]
        self._write = write
        self.library: dict[str, str] = {}

    def report(self, report: Diagnostic) -> list[Any]:
        """Return a diagnostic as a list."""
        return [
            report.code,
            report.severity.value,
            report.message,
            self._place(report.primary) if report.primary else None,
            [[self._place(label.span), label.message] for label in report.labels],
            list(report.notes),
            report.help,
            [self._fix(fix) for fix in report.fixes],
        ]

    def _fix(self, fix: Fix) -> list[Any]:
        edits = [[self._place(edit.span), edit.text] for edit in fix.edits]
        return [fix.title, edits, fix.is_safe]

    def scenario(self, entry: ScenarioEntry) -> list[Any]:
        """Return an entry as a list."""
        texts = [entry.name, entry.level, list(entry.open), entry.summary]
        return [self._index(entry.source), *texts, entry.is_runnable, dict(entry.values)]

    def sources(self) -> list[Any]:
        """Return the texts after the first: name, path, digest if it is one of the library."""
        return [self._entry(source) for source in self._sources[1:]]

    def _entry(self, source: SourceFile) -> list[Any]:
        if source.path is not None:
            return [source.name, self._write(str(source.path)), None]
        key = digest(source.text.encode())
        self.library[key] = source.text
        return [source.name, None, key]

    def _place(self, span: Span) -> list[int]:
        return [self._index(span.source), span.start, span.end]

    def _index(self, source: SourceFile) -> int:
        for index, known in enumerate(self._sources):
            if known is source:
                return index
        self._sources.append(source)
        return len(self._sources) - 1


class ReportReader:
    """Reads what `ReportWriter` wrote."""

    def __init__(
        self,
        source: SourceFile,
        others: Sequence[Sequence[Any]],
        place: Callable[[str], str],
        read: Callable[[str], bytes | None],
        library: Callable[[str], str],
    ) -> None:
        """Take the texts.

        Args:
            source: The file itself.
            others: The others, as written.
            place: Returns the path that was written.
            read: Returns the text of a file.
            library: Returns a text of the library by its digest.
        """
        self._sources = [source]
        for name, written, key in others:
            if written is None:
                self._sources.append(SourceFile(name, library(key)))
                continue
            path = place(written)
            data = read(path)
            if data is None:
                raise ValueError(path)
            self._sources.append(SourceFile(name, data.decode(), Path(path)))

    def report(self, entry: Sequence[Any]) -> Diagnostic:
        """Return a diagnostic."""
        code, severity, message, primary, labels, notes, help, fixes = entry
        return Diagnostic(
            code,
            Severity(severity),
            message,
            self._span(primary) if primary else None,
            tuple(Label(self._span(place), remark) for place, remark in labels),
            tuple(notes),
            help,
            tuple(map(self._fix, fixes)),
        )

    def _fix(self, entry: Sequence[Any]) -> Fix:
        title, edits, is_safe = entry
        return Fix(title, tuple(Edit(self._span(place), text) for place, text in edits), is_safe)

    def scenario(self, entry: Sequence[Any]) -> ScenarioEntry:
        """Return the level of a scenario."""
        index, name, level, openings, *others = entry
        return ScenarioEntry(self._sources[index], name, level, tuple(openings), *others)

    def _span(self, place: Sequence[int]) -> Span:
        index, start, end = place
        return Span(self._sources[index], start, end)

"""The texts that are open in the editor, and the other files of their project."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from osc2tx.building.jobs import Job, find_jobs, job_of_text
from osc2tx.compilation.inputs import InputError
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.language_server.documents import Document
from osc2tx.semantics import SemanticModel
from osc2tx.support.paths import real_path

# Statements that replace the line at the cursor, until the rest can be parsed.
_FILLERS = ("", "wait elapsed(1s)", "keep(true)", "event cursor")


class Project:
    """Open documents by path."""

    def __init__(self) -> None:
        """Begin with nothing open."""
        self._open: dict[Path, Document] = {}

    def change(self, path: Path, text: str, uri: str | None = None) -> Document:
        """Take the present text of an open file."""
        document = Document(_job_for(path), text, uri or path.as_uri(), self._texts(path, text))
        self._open[path] = document
        return document

    def close(self, path: Path) -> None:
        """Forget the text of a file; the file on disk is used again."""
        self._open.pop(path, None)

    def renew_importers(self, path: Path) -> list[Document]:
        """Return the open documents that import a file, as they are after a change of it."""
        real = real_path(path)
        importers = [each for each in self._open if each != path and self._open[each].imports(real)]
        return [self._renewed(each) for each in importers]

    def _renewed(self, path: Path) -> Document:
        return self.change(path, self._open[path].text, self._open[path].uri)

    def _texts(self, path: Path, text: str) -> dict[Path, str]:
        texts = {real_path(each): document.text for each, document in self._open.items()}
        return {**texts, real_path(path): text}

    def document(self, path: Path) -> Document:
        """Return a file as it is in the editor, or else on disk.

        Raises:
            OSError, UnicodeDecodeError: If it is not open and cannot be read.
        """
        if path not in self._open:
            text = path.read_bytes().decode("utf-8-sig")
            return Document(_job_for(path), text, path.as_uri(), self._texts(path, text))
        return self._open[path]

    def refreshed(self) -> Iterator[Document]:
        """Compile the open documents again: a file that they import may have changed."""
        for path in list(self._open):
            yield self._renewed(path)

    def model_near(self, path: Path, offset: int) -> SemanticModel | None:
        """Return a program that is near to a text which may be unfinished at an offset."""
        document = self.document(path)
        if document.is_well_formed:
            return document.model
        return _without_line(document, offset) or document.model

    def documents_with(self, path: Path, word: str) -> list[Document]:
        """Return the documents of the project of a file in whose text a word occurs."""
        pattern = re.compile(rf"(?<!\w){re.escape(word)}(?!\w)")
        found = {path: self.document(path)}
        for each in [*self._open, *_sources_of(path)]:
            if each in found:
                continue
            try:
                document = self.document(each)
            except (OSError, UnicodeDecodeError):
                continue  # `check` reports it; no name in it can be found
            if pattern.search(document.text):
                found[each] = document
        return list(found.values())


def _job_for(path: Path) -> Job:
    return job_of_text(path.name, path.parent, GivenOptions())


def _sources_of(path: Path) -> list[Path]:
    """Return the files of the project of a file; without settings, those of its folder."""
    config = ConfigFiles().for_source(path)
    try:
        jobs = find_jobs(config.source_folders or (path.parent,), GivenOptions(), ConfigFiles())
    except InputError:
        return []
    return [job.path for job in jobs]


def _without_line(document: Document, offset: int) -> SemanticModel | None:
    """Return the program of a text without the unfinished part of the line of an offset."""
    text = document.text
    start = text.rfind("\n", 0, offset) + 1
    end = text.find("\n", offset)
    end = len(text) if end < 0 else end
    blanks = text[start : start + len(text[start:offset]) - len(text[start:offset].lstrip())]
    line = text[start:end]
    opened, closed = text.rfind("(", start, offset) - start, line.rfind(")")
    without_arguments = [f"{line[: opened + 1]}{line[closed:]}"] if 0 <= opened < closed else []
    for attempt in (*without_arguments, *(f"{blanks}{filler}" for filler in _FILLERS)):
        model = document.compilation_of(f"{text[:start]}{attempt}{text[end:]}").model
        if model is not None:
            return model
    return None

"""Which sources a change since a revision can affect.

A source is affected if its text, its settings, a map that it names, or what it uses of an imported
file is not what it was; `uses` states what counts. Texts of the revision are read as git stores
them (ADR 0007).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from osc2tx.building.jobs import Job
from osc2tx.building.source_index import IndexedFile, SourceIndex
from osc2tx.building.version_control import (
    Entry,
    commit_of,
    contents_of,
    entries_of,
    is_object,
    top_of,
)
from osc2tx.compilation.uses import UsedFile, used_digest
from osc2tx.config import ConfigFiles
from osc2tx.support.paths import real_path
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Affected:
    """A source that a change can affect.

    Attributes:
        path: The source, links followed.
        causes: The files that changed and that count for it; itself among them if it did.
    """

    path: Path
    causes: tuple[Path, ...]


def affected_since(
    revision: str, jobs: Sequence[Job], configs: ConfigFiles, index: SourceIndex | None = None
) -> list[Affected]:
    """Return the sources that changes since a revision can affect, in the order of the jobs.

    Args:
        revision: A commit, in any way git understands.
        jobs: The sources.
        configs: The settings files.
        index: What they import, if that is known.

    Raises:
        InputError: The sources are in no repository, or it has no such revision.
    """
    if not jobs:
        return []
    index = index or SourceIndex(jobs, configs)
    then = _Revision(revision, top_of(index.sources[0].parent))
    found = ((path, tuple(_causes(index, path, then))) for path in index.sources)
    return [Affected(path, causes) for path, causes in found if causes]


def _causes(index: SourceIndex, source: Path, then: _Revision) -> Iterator[Path]:
    file = index.files[source]
    if then.has_changed(source):
        yield source
    if file.settings is not None and then.has_changed(file.settings):
        yield file.settings
    imported = index.closure(source)
    changed = [each for each in imported if then.has_changed(each.path)]
    if changed and _uses(file, imported) != _uses(file, imported, then):
        yield from (each.path for each in changed)
    for each in (file, *imported):
        yield from (place for place in each.looked_for if then.has(place))
        for _, place in each.maps:
            if place is not None and then.is_inside(place) and then.has_changed(place):
                yield place


def _uses(file: IndexedFile, imported: Sequence[IndexedFile], then: _Revision | None = None) -> str:
    """Return the digest of what a file uses, of today's texts or those of a revision."""
    texts = ((each.name, each.text if then is None else then.text(each.path)) for each in imported)
    files = [UsedFile(name, text) for name, text in texts if text is not None]
    return used_digest(file.text, files, file.dialect)


class _Revision:
    """The files of a revision, compared with those of the working copy; each is read once."""

    def __init__(self, revision: str, top: Path) -> None:
        self._top = top
        commit = commit_of(top, revision)
        self._entries: Mapping[Path, Entry] = {
            top / entry.path: entry for entry in entries_of(top, commit)
        }
        self._changed: dict[Path, bool] = {}
        self._texts: dict[Path, str | None] = {}

    def is_inside(self, path: Path) -> bool:
        """Return whether the repository can have a file."""
        return path.is_relative_to(self._top)

    def has(self, path: Path) -> bool:
        """Return whether the revision has a file."""
        return real_path(path) in self._entries

    def has_changed(self, path: Path) -> bool:
        """Return whether a file is not as the revision has it; ends of lines do not count."""
        if path not in self._changed:
            entry = self._entries.get(path)
            self._changed[path] = entry is None or not _is_same(path, entry)
        return self._changed[path]

    def text(self, path: Path) -> str | None:
        """Return the text that a file had; `None` if there was none."""
        if path not in self._texts:
            entry = self._entries.get(path)
            data = next(contents_of(self._top, [entry])) if entry is not None else None
            text = None if data is None else data.decode("utf-8", "replace")
            self._texts[path] = text and text.removeprefix("\ufeff").replace("\r\n", "\n")
        return self._texts[path]


def _is_same(path: Path, entry: Entry) -> bool:
    try:
        data = path.read_bytes()
    except OSError:
        return False
    return is_object(data, entry.blob) or is_object(data.replace(b"\r\n", b"\n"), entry.blob)

"""Writes outputs atomically: no file is ever half written.

First the digests of the new outputs are saved, then every output is replaced in one step, then the
digests are marked as done. A build that is killed in between leaves each
output old or new, and the next one knows both for its own. One build at a time writes to a folder.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from osc2tx.building.plan import Folder, Orphan, Planned
from osc2tx.building.written_digests import (
    DIGESTS_NAME,
    IGNORE_NAME,
    IGNORE_TEXT,
    Digests,
    Written,
    render_digests,
)
from osc2tx_shared.classes import dataclass

TEMPORARY = ".osc2tx-tmp"
SYNCS_AT_ONCE = 16
RECORDS = (DIGESTS_NAME, IGNORE_NAME)
_WRITE_FLAGS = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)


@dataclass(frozen=True, slots=True)
class Update:
    """The changes to make in a folder.

    Attributes:
        current: Outputs that are as they should be.
        writes: Outputs to write, with their texts.
        removals: Files to remove.
        forgotten: Outputs that are no longer there.
    """

    current: Sequence[Planned]
    writes: Sequence[tuple[Planned, str]]
    removals: Sequence[Orphan]
    forgotten: Sequence[str]


def update_folder(out_dir: Path, written: Digests, update: Update) -> tuple[list[str], list[str]]:
    """Write and remove, and keep it known all the while what osc2tx wrote.

    Args:
        out_dir: The output folder.
        written: The digests that are known of it.
        update: What to do.

    Returns:
        The paths that were written or removed, and a sentence for each that could not be.
    """
    writer = _Writer(out_dir)
    records = _Records(writer, written)
    records.forget(update.forgotten)
    for planned in update.current:
        records.enter(planned)
    if update.writes:
        records.announce([planned for planned, _ in update.writes])
        if writer.failures:
            return [], writer.failures
    writer.stage({planned.path: text for planned, text in update.writes})
    for planned, _ in sorted(update.writes, key=lambda pair: not pair[0].is_committed):
        needs_other = planned.owned != planned.path  # a map needs its module
        is_wanted = not needs_other or records.has(planned.owned)
        if is_wanted and writer.put(planned.path):
            records.enter(planned)
    for orphan in update.removals:
        if writer.remove(orphan.path):
            records.forget([orphan.path])
    records.save()
    writer.end()
    return [path for path in writer.done if path not in RECORDS], writer.failures


class _Records:
    """The digests of a folder while it changes."""

    def __init__(self, writer: _Writer, written: Digests) -> None:
        self._writer = writer
        self._stored = written
        self._digests = dict(written)

    def has(self, path: str) -> bool:
        """Return whether an output is listed."""
        return path in self._digests

    def enter(self, planned: Planned) -> None:
        """List an output that is as it should be."""
        if planned.is_committed:
            self._digests[planned.path] = Written(planned.result.job.name, (planned.made.digest,))

    def forget(self, paths: Iterable[str]) -> None:
        """List outputs no more."""
        for path in paths:
            self._digests.pop(path, None)

    def announce(self, writes: Iterable[Planned]) -> None:
        """Save the digests of the new outputs, beside the present ones."""
        coming = {}
        for planned in filter(lambda each: each.is_committed, writes):
            known = self._digests.get(planned.path)
            digests = (*(known.digests if known else ()), planned.made.digest)
            coming[planned.path] = Written(planned.result.job.name, digests)
        self._save(self._digests | coming)

    def save(self) -> None:
        """Save the digests of the present outputs."""
        self._save(self._digests)

    def _save(self, digests: Digests) -> None:
        if digests == self._stored:
            return
        files = ((IGNORE_NAME, IGNORE_TEXT), (DIGESTS_NAME, render_digests(digests)))
        if all(self._writer.write(path, text) for path, text in files):
            self._stored = dict(digests)


class _Writer:
    """Changes files of one folder; remembers what was done and what could not be."""

    def __init__(self, out_dir: Path) -> None:
        self.done: list[str] = []
        self.failures: list[str] = []
        self._out_dir = out_dir
        self._folder = Folder(out_dir)
        self._swept: set[Path] = set()
        self._staged: dict[str, Path] = {}

    def write(self, path: str, text: str) -> bool:
        """Put a file in place."""
        self.stage({path: text})
        return self.put(path)

    def stage(self, texts: Mapping[str, str]) -> None:
        """Write files beside their places, all on the disk when this returns."""
        for path, text in texts.items():
            place = self._out_dir / path
            try:
                self._folder.require_inside(path)
                place.parent.mkdir(parents=True, exist_ok=True)
                self._sweep(place.parent)
                self._staged[path] = stage_file(place, text.encode())
            except OSError as error:
                self._fail(place, error)
        sync(self._staged.values())

    def put(self, path: str) -> bool:
        """Move a file that is staged to its place; return whether it is there."""
        staged = self._staged.pop(path, None)
        if staged is None:
            return False
        try:
            put_file(staged, self._out_dir / path)
        except OSError as error:
            self._fail(self._out_dir / path, error)
            return False
        self.done.append(path)
        return True

    def _fail(self, place: Path, error: OSError) -> None:
        self.failures.append(f"{place}: cannot be written: {error.strerror}")

    def end(self) -> None:
        """Remove unused temporary files; fsync the folders."""
        for staged in self._staged.values():
            staged.unlink(missing_ok=True)
        sync({(self._out_dir / path).parent for path in self.done})

    def remove(self, path: str) -> bool:
        """Remove a file, and the folders that it leaves empty."""
        place = self._out_dir / path
        try:
            self._folder.require_inside(path)
            place.unlink(missing_ok=True)
        except OSError as error:
            self.failures.append(f"{place}: cannot be removed: {error.strerror}")
            return False
        self.done.append(path)
        for folder in place.parents:
            if folder == self._out_dir:
                break
            try:
                folder.rmdir()
            except OSError:  # not empty
                break
        return True

    def _sweep(self, folder: Path) -> None:
        """Remove temporary files of a build that was killed."""
        if folder not in self._swept:
            self._swept.add(folder)
            with os.scandir(folder) as entries:
                left = [e.path for e in entries if e.name.endswith(TEMPORARY) and e.name[0] == "."]
            for path in left:
                os.unlink(path)


def replace_file(path: Path, data: bytes) -> None:
    """Write a file beside its place and move it there, once it is on the disk; permissions stay.

    Raises:
        OSError: If that is not possible; nothing has changed then.
    """
    staged = stage_file(path, data)
    sync([staged])
    put_file(staged, path)
    sync([path.parent])


def stage_file(path: Path, data: bytes) -> Path:
    """Write a file beside its place; return where."""
    temporary = path.with_name(f".{path.name}{TEMPORARY}")
    try:
        descriptor = os.open(temporary, _WRITE_FLAGS, 0o666)
        with os.fdopen(descriptor, "wb") as file:
            file.write(data)
        if path.exists() and not path.is_symlink():
            os.chmod(temporary, path.stat().st_mode & 0o777)
    except OSError:
        temporary.unlink(missing_ok=True)
        raise
    return temporary


def put_file(staged: Path, path: Path) -> None:
    """Move a staged file to its place."""
    try:
        os.replace(staged, path)
    except OSError:
        staged.unlink(missing_ok=True)
        raise


def sync(paths: Collection[Path]) -> None:
    """Return once files and folders are on the disk, where the system can tell.

    A disk writes many files in nearly the time of one if it is asked for all of them at once.
    """
    if len(paths) > 1:
        from concurrent.futures import ThreadPoolExecutor  # a build mostly writes nothing

        with ThreadPoolExecutor(SYNCS_AT_ONCE) as pool:
            list(pool.map(_sync, paths))
    else:
        for path in paths:
            _sync(path)


def _sync(path: Path) -> None:
    with suppress(OSError):  # not every system syncs folders, nor every file system at all
        descriptor = os.open(path, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)

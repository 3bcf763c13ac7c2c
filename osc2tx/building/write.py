"""Writes outputs atomically: no file is ever half written.

First the manifest says what is about to be written, then every output is put in place in one step,
then the manifest says that it is done. A build that is killed in between leaves each output old or
new, and the next one knows both for its own. One build at a time writes to a folder.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from osc2tx.building.manifest import MANIFEST_NAME, Entry, Manifest
from osc2tx.building.plan import Folder, Orphan, Planned
from osc2tx.support.light_dataclass import dataclass

TEMPORARY = ".osc2tx-tmp"
_WRITE_FLAGS = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)


@dataclass(frozen=True, slots=True)
class Update:
    """What is to be done to a folder.

    Attributes:
        current: Outputs that are as they should be.
        writes: Outputs to write, with their texts.
        removals: Files to remove.
        forgotten: Outputs that the manifest need not list any more.
    """

    current: Sequence[Planned]
    writes: Sequence[tuple[Planned, str]]
    removals: Sequence[Orphan]
    forgotten: Sequence[str]


def update_folder(out_dir: Path, manifest: Manifest, update: Update) -> tuple[list[str], list[str]]:
    """Write, remove, and keep the manifest true all the while.

    Args:
        out_dir: The output folder.
        manifest: The manifest that is in it.
        update: What to do.

    Returns:
        The paths that were written or removed, and a sentence for each that could not be.
    """
    writer = _Writer(out_dir)
    outputs = dict(manifest.settled(Folder(out_dir).has).outputs)
    for path in update.forgotten:
        outputs.pop(path, None)
    outputs |= _entries(update.current)
    if update.writes:
        unfinished = _entries(planned for planned, _ in update.writes)
        writer.write(MANIFEST_NAME, Manifest(outputs, unfinished).render())
        if writer.failures:
            return [], writer.failures
    for planned, text in sorted(update.writes, key=lambda pair: not pair[0].is_committed):
        if planned.is_committed:
            if writer.write(planned.path, text):
                outputs |= _entries([planned])
        elif planned.listed in outputs:  # a source map comes after its module, or not at all
            writer.write(planned.path, text)
    for orphan in update.removals:
        if writer.remove(orphan.path):
            outputs.pop(orphan.path, None)
    final = Manifest(outputs)
    if update.writes or final != manifest:
        writer.write(MANIFEST_NAME, final.render())
    return [path for path in writer.done if path != MANIFEST_NAME], writer.failures


def _entries(outputs: Iterable[Planned]) -> dict[str, Entry]:
    """Return what the manifest lists of outputs."""
    return {
        planned.path: Entry(planned.result.job.name, planned.made.digest)
        for planned in outputs
        if planned.is_committed
    }


class _Writer:
    """Changes files of one folder; remembers what was done and what could not be."""

    def __init__(self, out_dir: Path) -> None:
        self.done: list[str] = []
        self.failures: list[str] = []
        self._out_dir = out_dir
        self._folder = Folder(out_dir)
        self._swept: set[Path] = set()

    def write(self, path: str, text: str) -> bool:
        """Put a file in place."""
        place = self._out_dir / path
        try:
            self._folder.require_inside(path)
            place.parent.mkdir(parents=True, exist_ok=True)
            self._sweep(place.parent)
            replace_file(place, text.encode())
        except OSError as error:
            self.failures.append(f"{place}: cannot be written: {error.strerror}")
            return False
        self.done.append(path)
        return True

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
        """Remove what a build left that was killed."""
        if folder not in self._swept:
            self._swept.add(folder)
            with os.scandir(folder) as entries:
                left = [e.path for e in entries if e.name.endswith(TEMPORARY) and e.name[0] == "."]
            for path in left:
                os.unlink(path)


def replace_file(path: Path, data: bytes) -> None:
    """Write a file beside its place and move it there; permissions stay.

    Raises:
        OSError: If that is not possible; nothing has changed then.
    """
    temporary = path.with_name(f".{path.name}{TEMPORARY}")
    try:
        descriptor = os.open(temporary, _WRITE_FLAGS, 0o666)
        with os.fdopen(descriptor, "wb") as file:
            file.write(data)
        if path.exists() and not path.is_symlink():
            os.chmod(temporary, path.stat().st_mode & 0o777)
        os.replace(temporary, path)
    except OSError:
        temporary.unlink(missing_ok=True)
        raise

"""Plan of a build: planned outputs compared with the output folder."""

from __future__ import annotations

import os
import stat
import unicodedata
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from pathlib import Path

from osc2tx.building.fingerprint import digest
from osc2tx.building.manifest import Manifest, beside
from osc2tx.building.results import FileResult, OutputRecord
from osc2tx.building.version_control import committed_objects, is_object
from osc2tx.building.written_digests import Digests
from osc2tx.support.paths import (
    LOSS_REPORT,
    MODULE,
    XML,
    is_committed,
    is_portable,
    module_of,
    source_map_of,
)
from osc2tx_shared.classes import dataclass


class State(Enum):
    """How an output stands; the value ends the sentence that begins with its path."""

    CURRENT = "is current"
    MISSING = "is missing"
    STALE = "is stale"
    EDITED = "was edited by hand"
    FOREIGN = "was not made by osc2tx"
    ORPHANED = "is orphaned"


PROTECTED = (State.EDITED, State.FOREIGN)


@dataclass(frozen=True, slots=True)
class Planned:
    """An output that a source makes.

    Attributes:
        path: Where it goes, relative to the output folder, forward slashes.
        result: What the source gave.
        made: The output itself.
    """

    path: str
    result: FileResult
    made: OutputRecord

    @property
    def is_committed(self) -> bool:
        """Whether it belongs into version control, and into the manifest."""
        return is_committed(self.path)

    @property
    def listed(self) -> str:
        """The output that the manifest lists for it: itself, for a source map its module."""
        return self.path if self.is_committed else module_of(self.path)


@dataclass(frozen=True, slots=True)
class Orphan:
    """A file that osc2tx once wrote and that no source makes any more.

    Attributes:
        path: Where it is, relative to the output folder.
        source: The source that made it.
        is_untouched: Whether it still is as osc2tx wrote it.
        is_outdated: Whether the source was compiled, and makes other files now.
    """

    path: str
    source: str
    is_untouched: bool
    is_outdated: bool


class Folder:
    """An output folder as it is; its outputs may be links into the rest of the world."""

    def __init__(self, out_dir: Path, written: Digests | None = None) -> None:
        """Take the folder, and digests of what osc2tx wrote there."""
        self._out_dir = out_dir
        self._written = written or {}
        self._committed: Mapping[str, str] | None = None
        self._is_inside: dict[str, bool] = {}
        self._digests: dict[str, str | None] = {}

    def digest_of(self, path: str) -> str | None:
        """Return the digest of a file, none if it is missing, an impossible one for a link.

        Raises:
            OSError: If it cannot be read, or lies behind a link.
        """
        if path not in self._digests:
            self._digests[path] = self._read(path)
        return self._digests[path]

    def look_again(self) -> None:
        """Forget what was read: time has passed."""
        self._digests.clear()

    def _read(self, path: str) -> str | None:
        place = f"{self._out_dir}/{path}"
        self.require_inside(path)
        try:
            mode = os.lstat(place).st_mode
        except (FileNotFoundError, NotADirectoryError):
            return None
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(0, "there is a folder of this name")
        if not stat.S_ISREG(mode):
            return ""
        with open(place, "rb") as file:
            return digest(file.read())

    def require_inside(self, path: str) -> None:
        """Refuse what lies behind a link.

        Raises:
            OSError: If a folder on the way is a link.
        """
        folder = path.rpartition("/")[0]
        if folder not in self._is_inside:
            steps = [self._out_dir / folder, *(self._out_dir / folder).parents]
            steps = steps[: steps.index(self._out_dir)]
            self._is_inside[folder] = not any(step.is_symlink() for step in steps)
        if not self._is_inside[folder]:
            raise OSError(0, "a folder on the way is a link")

    def is_missing(self, path: str) -> bool:
        """Return whether there is certainly no such file."""
        try:
            return self.digest_of(path) is None
        except OSError:
            return False

    def state_of(self, planned: Planned, manifest: Manifest) -> State:
        """Return how an output stands.

        Raises:
            OSError: If it cannot be told.
        """
        present = self.digest_of(planned.path)
        if present is None:
            return State.MISSING
        if present == planned.made.digest:
            return State.CURRENT
        if planned.listed not in manifest.outputs:
            return State.FOREIGN
        may_be_replaced = not planned.is_committed or self.is_untouched(planned.path)
        return State.STALE if may_be_replaced else State.EDITED

    def is_untouched(self, path: str) -> bool:
        """Return whether an output is as osc2tx wrote it, as it was committed, or missing.

        Raises:
            OSError: As `digest_of`.
        """
        present = self.digest_of(path)
        if not present:
            return present is None
        return present in self._written.get(path, ()) or self._is_committed(path)

    def _is_committed(self, path: str) -> bool:
        if self._committed is None:
            self._committed = committed_objects(self._out_dir)
        name = self._committed.get(path)
        return name is not None and is_object((self._out_dir / path).read_bytes(), name)


def place_outputs(results: Sequence[FileResult]) -> tuple[list[Planned], list[str]]:
    """Return the outputs in order of path, and for those that have no place of their own, why.

    Two outputs must differ on every system, so case and the ways to write an accent do not count.
    """
    rivals: dict[str, list[FileResult]] = defaultdict(list)
    for result in results:
        if result.outputs:
            rivals[_folded(_path(result, ""))].append(result)
    folders = {
        _folded(parent): result
        for result in results
        if result.outputs
        for parent in _parents(result.job.name)
    }
    placed: list[Planned] = []
    problems = []
    for group in rivals.values():
        problem = _problem(group, folders)
        if problem:
            problems.append(problem)
            continue
        (result,) = group
        placed += [Planned(_path(result, made.suffix), result, made) for made in result.outputs]
    return sorted(placed, key=lambda planned: planned.path), sorted(problems)


def find_orphans(
    manifest: Manifest,
    placed: Sequence[Planned],
    results: Sequence[FileResult],
    folders: Sequence[Path],
    folder: Folder,
) -> Iterator[Orphan]:
    """Yield what the manifest lists and no source makes.

    Args:
        manifest: The manifest.
        placed: What the sources make.
        results: What became of the sources; those with errors, or bugs of ours, keep their outputs.
        folders: The folders of sources that were named; without any, nothing is known of sources
            that are not among the results.
        folder: The output folder.
    """
    made = {planned.path for planned in placed}
    having = {planned.result.job.name for planned in placed}
    failed = {
        result.job.name
        for result in results
        if not result.is_complete
        or result.bug
        or (result.outputs and result.job.name not in having)
    }
    compiled = {r.job.name for r in results} - failed
    targets = {result.job.name: result.job.options.target for result in results}
    for path, source in sorted(manifest.outputs.items()):
        if path in made or source in failed:
            continue
        if targets.get(source, "all") not in ("all", _target_of(path)):
            continue  # nobody asked for such files today
        is_gone = folders and not any(_is_source(each, source) for each in folders)
        if source not in compiled and not is_gone:
            continue
        try:
            is_untouched = folder.is_untouched(path)
        except OSError:
            is_untouched = False
        for each in (source_map_of(path), path) if path.endswith(MODULE) else (path,):
            if not folder.is_missing(each):
                yield Orphan(each, source, is_untouched, source in compiled)


def _target_of(path: str) -> str:
    return "xosc" if path.endswith((XML, LOSS_REPORT)) else "py"


def _is_source(folder: Path, name: str) -> bool:
    return os.path.lexists(folder / name) if ".." not in name.split("/") else False


def _problem(group: Sequence[FileResult], folders: dict[str, FileResult]) -> str | None:
    first = group[0]
    path = _path(first, first.outputs[0].suffix)
    if len(group) > 1:
        names = " and ".join(sorted(str(rival.job.path) for rival in group))
        if len({_path(rival, "") for rival in group}) == 1:
            return f"{path}: {names} make the same module; rename one of them"
        return f"{path}: {names} make modules that not every system can tell apart; rename one"
    odd = [part for part in first.job.name.split("/")[:-1] if not is_portable(part)]
    if odd:
        return f"{path}: not every system can have a folder {odd[0]!r}; rename it"
    for made in first.outputs:
        inner = folders.get(_folded(_path(first, made.suffix)))
        if inner is not None:
            return f"{path}: {inner.job.path} needs a folder of this name; rename it"
    return None


def _path(result: FileResult, suffix: str) -> str:
    return beside(result.job.name, f"{result.stem}{suffix}")


def _parents(name: str) -> Iterator[str]:
    """Yield the folders above a file."""
    while name := name.rpartition("/")[0]:
        yield name


def _folded(path: str) -> str:
    if path.isascii():
        return path.lower()
    return unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", path).casefold())

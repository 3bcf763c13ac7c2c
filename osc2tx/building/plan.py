"""Plan of a build: planned outputs compared with the output folder."""

from __future__ import annotations

import os
import stat
import unicodedata
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from pathlib import Path

from osc2tx.building.ownership import beside, is_in_conflict, outputs_below, stated_source
from osc2tx.building.results import FileResult, OutputRecord
from osc2tx.building.version_control import committed_objects, is_object
from osc2tx.building.written_digests import Digests, is_inside
from osc2tx.support.paths import (
    LOSS_REPORT,
    MODULE,
    SOURCE_MAP,
    XML,
    is_committed,
    is_portable,
    module_of,
    source_map_of,
)
from osc2tx.support.records import digest
from osc2tx_shared.classes import dataclass


class State(Enum):
    """How an output stands; the value ends the sentence that begins with its path."""

    CURRENT = "is current"
    MISSING = "is missing"
    STALE = "is stale"
    CONFLICTED = "has conflict markers of a merge"
    EDITED = "was edited by hand"
    FOREIGN = "was not made by osc2tx"
    ORPHANED = "is orphaned"


PROTECTED = (State.EDITED, State.FOREIGN)


@dataclass(frozen=True, slots=True)
class Planned:
    """An output that a source makes.

    Attributes:
        path: Its path, relative to the output folder, forward slashes.
        result: The result of the source.
        made: The output itself.
    """

    path: str
    result: FileResult
    made: OutputRecord

    @property
    def is_committed(self) -> bool:
        """Whether it belongs into version control."""
        return is_committed(self.path)

    @property
    def owned(self) -> str:
        """The output that tells whose it is: itself, for a source map its module."""
        return module_of(self.path) if self.path.endswith(SOURCE_MAP) else self.path


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
        """Return the digest of a file; none if it is missing, an impossible one for a link.

        The ends of its lines do not count: a working copy may have those of Windows.

        Raises:
            OSError: If it cannot be read, or lies behind a link.
        """
        if path not in self._digests:
            data = self._read(path)
            self._digests[path] = digest(data) if data else "" if data is not None else None
        return self._digests[path]

    def look_again(self) -> None:
        """Forget what was read: time has passed."""
        self._digests.clear()

    def _read(self, path: str) -> bytes | None:
        """Return the content of a file; nothing for a link, `None` if it is missing."""
        place = f"{self._out_dir}/{path}"
        self.require_inside(path)
        try:
            mode = os.lstat(place).st_mode
        except (FileNotFoundError, NotADirectoryError):
            return None
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(0, "there is a folder of this name")
        if not stat.S_ISREG(mode):
            return b""
        with open(place, "rb") as file:
            return file.read().replace(b"\r\n", b"\n")

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

    def source_of(self, path: str) -> str | None:
        """Return the source that made an output; `None` if osc2tx did not make it."""
        try:
            stated = stated_source(path, self._read(path) or b"")
        except OSError:
            return None
        written = self._written.get(path)
        return stated if stated is not None or written is None else written.source

    def outputs_below(self, inner: str = "") -> set[str]:
        """Return what may be outputs, in a folder of the folder or all of it."""
        found = set(outputs_below(self._out_dir, inner))
        return found | {p for p in self._written if p.startswith(f"{inner}/" if inner else "")}

    def state_of(self, planned: Planned) -> State:
        """Return how an output stands.

        Raises:
            OSError: If it is unknown.
        """
        present = self.digest_of(planned.path)
        if present is None:
            return State.MISSING
        if present == planned.made.digest:
            return State.CURRENT
        if self.source_of(planned.owned) is None:
            return State.FOREIGN
        if is_in_conflict(self._read(planned.path) or b""):
            return State.CONFLICTED
        return State.STALE if self.is_untouched(planned.path) else State.EDITED

    def is_untouched(self, path: str) -> bool:
        """Return whether an output is as osc2tx wrote it, as it was committed, or missing.

        Edits of files that are not committed do not count.

        Raises:
            OSError: As `digest_of`.
        """
        if not is_committed(path):
            return True
        present = self.digest_of(path)
        if not present:
            return present is None
        written = self._written.get(path)
        return (written is not None and present in written.digests) or self._is_committed(path)

    def _is_committed(self, path: str) -> bool:
        if self._committed is None:
            self._committed = committed_objects(self._out_dir)
        name = self._committed.get(path)
        data = self._read(path) or b""
        stored = (data, data.replace(b"\n", b"\r\n"))
        return name is not None and any(is_object(each, name) for each in stored)


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


@dataclass(frozen=True, slots=True)
class Scope:
    """The sources of which a build knows whether they are there.

    Attributes:
        roots: All folders in which a source of some name can be.
        asked: The folders that were named; an output is looked for only if its source could be
            in one of them.
    """

    roots: tuple[Path, ...]
    asked: tuple[Path, ...]

    def is_gone(self, source: str) -> bool:
        """Return whether a source would be in the folders that were named, and is nowhere."""
        if not is_inside(source):
            return False
        places = [root / source for root in self.roots]
        is_asked = any(place.is_relative_to(folder) for place in places for folder in self.asked)
        return is_asked and not any(os.path.lexists(place) for place in places)

    def folders(self) -> set[str]:
        """Return the folders of outputs of the folders that were named."""
        inner = {
            folder.relative_to(root).as_posix()
            for folder in self.asked
            for root in self.roots
            if folder.is_relative_to(root)
        }
        is_whole = any(root.is_relative_to(folder) for folder in self.asked for root in self.roots)
        return {""} if is_whole or "." in inner else inner


def find_orphans(
    placed: Sequence[Planned], results: Sequence[FileResult], scope: Scope, folder: Folder
) -> Iterator[Orphan]:
    """Yield outputs that no source makes any more.

    Args:
        placed: The outputs of the sources.
        results: The results of the sources; outputs of those with errors, or internal ones, stay.
        scope: The sources that the build knows of.
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
    inner = scope.folders() or {name.rpartition("/")[0] for name in compiled}
    candidates = {path for each in inner for path in folder.outputs_below(each)}
    for path in sorted(candidates - made):
        source = folder.source_of(path)
        if source is None or source in failed or folder.is_missing(path):
            continue
        if targets.get(source, "all") not in ("all", _target_of(path)):
            continue  # such files are not requested in this build
        if source not in compiled and not scope.is_gone(source):
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

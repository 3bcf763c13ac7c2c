"""Differences of outputs that a change of the sources causes."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from difflib import unified_diff
from itertools import count
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from osc2tx.building.jobs import Job, find_jobs
from osc2tx.building.plan import place_outputs
from osc2tx.building.result_cache import ResultCache
from osc2tx.building.results import FileResult
from osc2tx.building.version_control import (
    LINK,
    Entry,
    commit_of,
    contents_of,
    entries_of,
    top_of,
)
from osc2tx.building.workers import compile_jobs, with_siblings
from osc2tx.compilation.inputs import InputError
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import Severity
from osc2tx.support.paths import SETTINGS_FILES, real_path
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.own_folders import REVISION, own_folder

REFUSED_PARTS = ("", ".", "..", ".git")
"""Parts of paths that lead elsewhere or would be a repository."""


class Revision(NamedTuple):
    """The sources of a revision, laid out in a folder of their own.

    Attributes:
        paths: Where the paths of today are; those that the revision does not have are left out.
        libraries: Where the folders with libraries are.
        problems: What of the revision was not laid out, a sentence each.
    """

    paths: list[Path]
    libraries: tuple[str, ...]
    problems: list[str]


@contextmanager
def checked_out(
    paths: Sequence[str | Path], revision: str, import_paths: Sequence[str]
) -> Iterator[Revision]:
    """Lay out scenario and settings files of a revision; yield where paths and libraries are.

    Nothing of the repository's own folder is touched, and nothing of it runs: the files are read
    as git stores them.

    Args:
        paths: Files and folders by their present names.
        revision: A commit, in any way git understands.
        import_paths: Folders with libraries; those outside of the repository are used as they are.

    Raises:
        InputError: The paths are in no repository, it has no such revision, or the revision has
            names that git would not check out.
    """
    root = _repository(paths)
    commit = commit_of(root, revision)
    with own_folder(REVISION) as folder:
        top = Path(os.path.realpath(folder))
        try:
            problems = list(_lay_out(root, commit, top))
        except _RefusedName as error:
            raise InputError(
                f"{revision}: {error}; nothing is compared", unreadable=False
            ) from None
        inside = [top / _place(path).relative_to(root) for path in paths]
        libraries = [(str(path), _place(path)) for path in import_paths]
        yield Revision(
            [path for path in inside if path.exists() and _has_source(path)],
            tuple(
                str(top / place.relative_to(root)) if place.is_relative_to(root) else written
                for written, place in libraries
            ),
            [f"{revision}: {problem}" for problem in problems],
        )


def _has_source(path: Path) -> bool:
    return path.is_file() or any(path.rglob("*.osc"))


def _repository(paths: Sequence[str | Path]) -> Path:
    place = _place(paths[0])
    root = top_of(place if place.is_dir() else place.parent)
    for path in paths:
        if not _place(path).is_relative_to(root):
            raise InputError(f"{path}: is not in the repository {root}", unreadable=False)
    return root


def _place(path: str | Path) -> Path:
    """Return the absolute path; a link stays a link, as it does in the repository."""
    path = Path(path)
    return Path(os.path.realpath(path.parent), path.name) if path.name else real_path(path)


class _RefusedName(Exception):
    """A revision holds a name that git refuses to check out."""


def _lay_out(root: Path, commit: str, top: Path) -> Iterator[str]:
    """Write the files that a build may read, below `top` only; yield the omitted ones.

    Links come last: while files are written, there is none to follow.

    Raises:
        _RefusedName: A name leads elsewhere, or two entries are one file.
    """
    entries = [entry for entry in entries_of(root, commit) if _is_read(entry)]
    links = []
    for entry, data in zip(entries, contents_of(root, entries), strict=True):
        if any(part.casefold() in REFUSED_PARTS for part in entry.path.split("/")):
            raise _RefusedName(f"{entry.path!r} is no name that git would check out")
        if entry.mode == LINK:
            links.append((entry.path, os.fsdecode(data)))
            continue
        target = top / entry.path
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            with target.open("xb") as file:
                file.write(data)
        except (FileExistsError, NotADirectoryError):
            raise _RefusedName(f"{entry.path!r} is there twice") from None
    for path, goal in links:
        if not _leads_inside(top, path, goal):
            yield f"{path} is a link out of the repository, which is not read"
            continue
        target = top / path
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.symlink_to(goal)
        except (FileExistsError, NotADirectoryError):
            raise _RefusedName(f"{path!r} is there twice") from None


def _is_read(entry: Entry) -> bool:
    place = PurePosixPath(entry.path)
    return place.suffix == ".osc" or place.name in SETTINGS_FILES


def _leads_inside(top: Path, path: str, goal: str) -> bool:
    """Return whether a link stays below `top`; links that are there already do so."""
    place = os.path.realpath((top / path).parent / goal)
    return Path(place).is_relative_to(top)


def diff_lines(path: str, old: str | None, new: str | None) -> Iterator[str]:
    """Yield the lines of a diff as git writes it; `None` stands for no file."""
    path = path.lstrip("/")
    yield from (
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
        for line in unified_diff(
            _lines(old),
            _lines(new),
            "/dev/null" if old is None else f"a/{path}",
            "/dev/null" if new is None else f"b/{path}",
        )
    )


def _lines(text: str | None) -> list[str]:
    """Return lines with their ends; only a line feed ends one, unlike in `splitlines`."""
    lines = (text or "").split("\n")
    last = lines.pop()
    return [f"{line}\n" for line in lines] + ([last] if last else [])


@dataclass(frozen=True, slots=True)
class Difference:
    """An output that differs; `None` where there is no such file."""

    path: str
    old: str | None
    new: str | None


@dataclass(frozen=True, slots=True)
class Comparison:
    """The outputs of two states of the sources.

    Attributes:
        results: The outcomes of the sources of today.
        differences: The outputs that differ, in order.
        problems: What keeps outputs from being compared, a sentence each.
        bugs: Mistakes of osc2tx itself.
    """

    results: tuple[FileResult, ...]
    differences: tuple[Difference, ...]
    problems: tuple[str, ...]
    bugs: tuple[str, ...]


def compare_with(
    revision: str,
    paths: Sequence[str | Path],
    given: GivenOptions,
    *,
    workers: int,
    cache: Path | None = None,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> Comparison:
    """Compare the outputs of a revision with the present ones, each with its own settings.

    Args:
        revision: A commit, in any way git understands.
        paths: Present files and folders.
        given: Options that precede those of settings files, in both.
        workers: Number of processes that may compile.
        cache: Folder of earlier results; in the user's cache if left out.
        progress: Called with the numbers of compiled files and of all files.

    Raises:
        InputError, ConfigError: If either cannot be read.
    """
    new = _State(paths, given, workers, cache, progress)
    libraries = given.import_paths or ()
    with checked_out(paths, revision, libraries) as old_sources:
        old_given = replace(given, import_paths=old_sources.libraries or None)
        old = _State(old_sources.paths, old_given, workers, cache, progress)
        differences = [
            Difference(path, old.text(path), new.text(path))
            for path in sorted(old.placed.keys() | new.placed.keys())
            if old.digest(path) != new.digest(path)
        ]
    problems = [*new.problems, *old_sources.problems]
    problems += [
        f"{revision}: {result.job.name} has errors and makes nothing"
        for result in old.results
        if any(report.severity is Severity.ERROR for report in result.reports)
    ]
    return Comparison(
        results=tuple(new.results),
        differences=tuple(differences),
        problems=tuple(problems),
        bugs=tuple(result.bug for result in (*old.results, *new.results) if result.bug),
    )


class _State:
    """The outputs of the sources of one state; results of earlier builds count."""

    def __init__(
        self,
        paths: Sequence[str | Path],
        given: GivenOptions,
        workers: int,
        cache: Path | None,
        progress: Callable[[int, int], None],
    ) -> None:
        configs = ConfigFiles()
        self._workers = workers
        self._progress = progress
        self._memory = ResultCache("build", configs, cache)
        self.results = self._compile(find_jobs(paths, given, configs))
        made = with_siblings(self.results, self._compile, configs)
        self._memory.close()
        placed, self.problems = place_outputs(made)
        self.placed = {item.path: item for item in placed if item.owned == item.path}

    def digest(self, path: str) -> str | None:
        """Return the digest of an output; `None` if it makes none."""
        return self.placed[path].made.digest if path in self.placed else None

    def text(self, path: str) -> str | None:
        """Return the text of an output; `None` if it makes none."""
        if path not in self.placed:
            return None
        item = self.placed[path]
        result = item.result
        if item.made.text is None:
            whole = self._memory.with_texts(result)
            result = whole or compile_jobs([result.job], self._workers)[0]
        texts = {made.suffix: made.text for made in result.outputs}
        return texts[item.made.suffix]

    def _compile(self, jobs: Sequence[Job]) -> list[FileResult]:
        known = {job: result for job in jobs if (result := self._memory.load(job)) is not None}
        missing = [job for job in jobs if job not in known]
        numbers = count(1)

        def finished(result: FileResult) -> None:
            self._memory.keep(result)
            self._progress(next(numbers), len(missing))

        made = compile_jobs(missing, self._workers, finished)
        known |= dict(zip(missing, made, strict=True))
        return [known[job] for job in jobs]

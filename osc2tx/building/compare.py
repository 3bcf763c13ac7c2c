"""Differences of outputs that a change of the sources causes."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from difflib import unified_diff
from pathlib import Path

from osc2tx.building.jobs import Job, find_jobs
from osc2tx.building.plan import place_outputs
from osc2tx.building.result_cache import ResultCache
from osc2tx.building.results import FileResult, with_severities
from osc2tx.building.revision_files import checked_out
from osc2tx.building.workers import Progress, compile_jobs, no_progress, with_siblings
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import Severity
from osc2tx_shared.classes import dataclass, replace


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
    configs: ConfigFiles | None = None,
    progress: Progress = no_progress,
) -> Comparison:
    """Compare the outputs of a revision with the present ones, each with its own settings.

    Args:
        revision: A commit, in any way git understands.
        paths: Present files and folders.
        given: Options that precede those of settings files, in both.
        workers: Number of processes that may compile.
        cache: Folder of earlier results; in the user's cache if left out.
        configs: The present settings files, if the caller needs them afterwards.
        progress: Called with the numbers of compiled files and of all files.

    Raises:
        InputError, ConfigError: If either cannot be read.
    """
    configs = configs or ConfigFiles()
    new = _State(paths, given, configs, workers, cache, progress)
    libraries = given.import_paths or ()
    with checked_out(paths, revision, libraries) as old_sources:
        old_given = replace(given, import_paths=old_sources.libraries or None)
        old = _State(old_sources.paths, old_given, ConfigFiles(), workers, cache, progress)
        differences = [
            Difference(path, old.text(path), new.text(path))
            for path in sorted(old.placed.keys() | new.placed.keys())
            if old.digest(path) != new.digest(path)
        ]
        left_out = _folders_left_out(old.results, old_sources.top)
    problems = [*new.problems, *old_sources.problems]
    problems += [
        f"{revision}: {folder} of the settings is outside of the repository and not read"
        for folder in left_out
    ]
    problems += [
        f"{revision}: {result.job.name} has errors and makes nothing"
        for result in old.results
        if any(report.severity is Severity.ERROR for report in result.reports)
    ]
    return Comparison(
        results=tuple(with_severities(new.results, configs)),
        differences=tuple(differences),
        problems=tuple(problems),
        bugs=tuple(result.bug for result in (*old.results, *new.results) if result.bug),
    )


def _folders_left_out(results: Sequence[FileResult], top: Path) -> list[str]:
    """Return the folders that settings name by a path out of the repository, seen from its top."""
    options = (result.job.options for result in results)
    named = {folder for each in options for folder in (*each.import_paths, *each.xml.map_path)}
    places = map(os.path.normpath, named)
    return sorted(
        os.path.relpath(place, top)
        for place in places
        if not Path(place).is_relative_to(top) and not os.path.exists(place)
    )


class _State:
    """The outputs of the sources of one state; results of earlier builds count."""

    def __init__(
        self,
        paths: Sequence[str | Path],
        given: GivenOptions,
        configs: ConfigFiles,
        workers: int,
        cache: Path | None,
        progress: Progress,
    ) -> None:
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
        known = self._memory.load_all(jobs)
        return compile_jobs(jobs, self._workers, self._memory, known, self._progress)

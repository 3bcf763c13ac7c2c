"""Differences of outputs that a change of the sources causes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from osc2tx.building.jobs import find_jobs
from osc2tx.building.plan import place_outputs
from osc2tx.building.results import FileResult
from osc2tx.building.revision import checked_out
from osc2tx.building.workers import compile_jobs, with_siblings
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import Severity
from osc2tx_classes import dataclass, replace


@dataclass(frozen=True, slots=True)
class Difference:
    """An output that is not what it was; `None` where there is no such file."""

    path: str
    old: str | None
    new: str | None


@dataclass(frozen=True, slots=True)
class Comparison:
    """The outputs of two states of the sources.

    Attributes:
        results: What came of the sources of today.
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
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> Comparison:
    """Compile the sources of a revision and those of today, with the settings of each.

    Args:
        revision: A commit, in any way git understands.
        paths: Files and folders of today.
        given: Options that go before those of settings files, in both.
        workers: How many processes may compile.
        progress: Is told how many of how many files are compiled.

    Raises:
        InputError, ConfigError: If either cannot be read.
    """
    new_jobs = find_jobs(paths, given, ConfigFiles())
    libraries = given.import_paths or ()
    with checked_out(paths, revision, libraries) as (old_paths, old_libraries):
        old_given = replace(given, import_paths=old_libraries or None)
        old_jobs = find_jobs(old_paths, old_given, ConfigFiles())
        jobs = (*old_jobs, *new_jobs)
        results = compile_jobs(jobs, workers, lambda done: progress(done, len(jobs)))
        old, new = results[: len(old_jobs)], results[len(old_jobs) :]
        old_texts, _ = _texts(with_siblings(old, lambda more: compile_jobs(more, workers)))
    new_texts, problems = _texts(with_siblings(new, lambda more: compile_jobs(more, workers)))
    problems += [
        f"{revision}: {result.job.name} has errors and makes nothing"
        for result in old
        if any(report.severity is Severity.ERROR for report in result.reports)
    ]
    differences = [
        Difference(path, old_texts.get(path), new_texts.get(path))
        for path in sorted(old_texts | new_texts)
        if old_texts.get(path) != new_texts.get(path)
    ]
    return Comparison(
        results=tuple(new),
        differences=tuple(differences),
        problems=tuple(problems),
        bugs=tuple(result.bug for result in results if result.bug),
    )


def _texts(results: Sequence[FileResult]) -> tuple[dict[str, str], list[str]]:
    placed, problems = place_outputs(results)
    texts = {
        item.path: item.made.text
        for item in placed
        if item.is_committed and item.made.text is not None
    }
    return texts, problems

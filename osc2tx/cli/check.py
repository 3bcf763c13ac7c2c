"""`osc2tx check`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from osc2tx.building.baseline import Baselines
from osc2tx.building.jobs import Job, find_jobs, run_all
from osc2tx.building.results import check as check_compilation
from osc2tx.building.workers import check_jobs
from osc2tx.cli.options import (
    affected_option,
    affected_sources,
    cache_option,
    sources_or_stated,
    target_options,
    workers_option,
)
from osc2tx.cli.progress import progress_bar
from osc2tx.cli.reporting import Exit, Reporter, count_of, found, report_options
from osc2tx.cli.standard_input import is_standard_input, job_of_standard_input, stdin_filename
from osc2tx.compilation.file_reports import apply_suppressions
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics.report import LEVELS
from osc2tx_shared.cache import cache_folder
from osc2tx_shared.text import StreamName, recorded

if TYPE_CHECKING:
    from osc2tx.building.answers import Answer
    from osc2tx.building.results import FileResult

MOST_LISTED = 10  # scenarios that are in folders and not in named files


@click.command()
@click.argument("paths", metavar="[PATH]...", nargs=-1, type=click.Path())
@target_options
@affected_option
@click.option(
    "--write-baseline",
    is_flag=True,
    help="Write the warnings to the `baseline` of the settings, which are then not reported.",
)
@click.option("--fix", "is_fixing", is_flag=True, help="Apply the safe fixes to the files.")
@click.option(
    "--unsafe-fixes", "unsafe", is_flag=True, help="Also apply fixes that may not be intended."
)
@click.option(
    "--diff", "show_diff", is_flag=True, help="Write nothing; print the changes of fixes."
)
@click.option("--no-cache", is_flag=True, help="Also check unchanged files again.")
@cache_option
@workers_option
@stdin_filename
@report_options
def check(
    paths: tuple[str, ...],
    given: GivenOptions,
    affected: str | None,
    write_baseline: bool,
    is_fixing: bool,
    unsafe: bool,
    show_diff: bool,
    no_cache: bool,
    cache: Path | None,
    workers: int | None,
    stdin_filename: str | None,
    reporter: Reporter,
) -> Exit:
    """Report errors and warnings in scenario files; folders are searched for .osc files.

    If the map of a scenario is found, a run is prepared up to its first step.

    The levels of scenarios are listed, those of more than ten in folders counted.

    Without PATH, `sources` of the settings file are used; `-` is standard input, whose fixed text
    goes to standard output.
    """
    if show_diff and reporter.form != "text":
        raise click.UsageError("--diff and --output-format both print to standard output")
    is_fixing = is_fixing or show_diff
    if unsafe and not is_fixing:
        raise click.UsageError("--unsafe-fixes is for --fix and --diff")
    if is_standard_input(paths, stdin_filename):
        job, text = job_of_standard_input(stdin_filename, given)
        if is_fixing:
            from osc2tx.cli.fixing import fix_input  # loads the build

            return fix_input(job, text, reporter, unsafe=unsafe, show_diff=show_diff)
        return _check_input(job, text, reporter)
    asked = sources_or_stated(paths, "check")
    paths = affected_sources(asked, affected, given)
    configs = ConfigFiles()
    jobs = find_jobs(paths, given, configs)
    is_kept = not no_cache and cache_folder(cache) is not None
    checked = partial(
        _checked, remember=not no_cache, workers=workers, configs=configs, cache=cache
    )
    results = checked(jobs, is_kept=is_kept)
    outcome = Exit.OK
    if is_fixing:
        from osc2tx.cli.fixing import fix_files

        fixed, outcome = fix_files(results, reporter, unsafe=unsafe, show_diff=show_diff)
        if show_diff:
            return outcome
        again = dict(zip(fixed, checked(fixed, is_kept=is_kept), strict=True))
        results = [again.get(result.job, result) for result in results]
    baselines = Baselines(configs)
    whole = [result.job.path for result in results if result.is_complete]
    if write_baseline:
        _write_baselines(baselines, results, whole, reporter)
    with recorded() as printed:
        bugs = [result.bug for result in results if result.bug]
        code, report = reporter.report(results, bugs, baselines=baselines)
        code = max(code, reporter.warn(baselines.outdated(whole)))
        _print_levels(results, reporter)
        reporter.say(f"checked {count_of(len(results), 'file')}: {found(report)}")
    code = max(code, outcome)
    if any(Path(path).is_dir() for path in paths):
        return max(code, reporter.warn(configs.unmatched_tables()))
    answer = reporter.session.answer
    if not is_fixing and not write_baseline and is_kept and cache is None and answer is not None:
        _keep_answer(answer, code, printed, results, configs)
    return code


def _checked(
    jobs: Sequence[Job],
    *,
    is_kept: bool,
    remember: bool,
    workers: int | None,
    configs: ConfigFiles,
    cache: Path | None,
) -> list[FileResult]:
    with progress_bar("checking", is_kept=is_kept) as progress:
        return check_jobs(
            jobs,
            remember=remember,
            workers=workers,
            progress=progress,
            configs=configs,
            cache=cache,
        )


def _print_levels(results: Sequence[FileResult], reporter: Reporter) -> None:
    """Print the levels of scenarios; of many in folders, only how many have which."""
    in_folders = [e for result in results if not result.job.is_asked for e in result.scenarios]
    counted = in_folders if len(in_folders) > MOST_LISTED else []
    for result in results:
        if result.job.is_asked or not counted:
            for entry in result.scenarios:
                reporter.say(f"{result.job.name}: {entry.summary}")
    numbers = Counter(entry.level for entry in counted)
    if numbers:
        levels = ", ".join(f"{numbers[level]} {level}" for level in LEVELS if numbers[level])
        reporter.say(f"{count_of(len(counted), 'scenario')}: {levels}")


def _write_baselines(
    baselines: Baselines, results: Sequence[FileResult], whole: Sequence[Path], reporter: Reporter
) -> None:
    """Write the warnings of files to the baseline.

    Raises:
        click.UsageError: The settings name no baseline.
    """
    written = baselines.write(apply_suppressions(results).shown, whole)
    if whole and not written:
        raise click.UsageError(
            '--write-baseline: name a file in the settings, as in `baseline = "known.json"`'
        )
    for place, count in written.items():
        reporter.say(f"{place}: {count_of(count, 'known warning')}")


def _keep_answer(
    answer: Answer,
    code: Exit,
    printed: Sequence[tuple[StreamName, str]],
    results: Sequence[FileResult],
    configs: ConfigFiles,
) -> None:
    """Store the printed answer about files, if all of its inputs are known."""
    files: list[str] = []
    for result in results:
        if result.bug or result.dependencies is None or result.source is None:
            return
        links = (*result.job.roots, *map(Path, result.job.options.import_paths))
        files += [str(result.job.path), *map(str, links)]
        files += [each.asked for each in result.dependencies if each.found]
        sources = {each.primary.source.path for each in result.reports if each.primary}
        places = {configs.for_source(path).baseline for path in {result.job.path, *sources} if path}
        files += map(str, filter(None, places))
    answer.keep(code, printed, files)


def _check_input(job: Job, text: str, reporter: Reporter) -> Exit:
    compilation = job.compilation(text=text)
    bugs = run_all([compilation], partial(check_compilation, run=job.run))
    code, report = reporter.report([compilation], bugs)
    for entry in compilation.scenarios:
        reporter.say(f"{compilation.name}: {entry.summary}")
    reporter.say(f"checked {count_of(1, 'file')}: {found(report)}")
    return code

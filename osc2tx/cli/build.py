"""`osc2tx build`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from osc2tx.building.baseline import Baselines
from osc2tx.building.jobs import compile_all, run_all
from osc2tx.cli.file_changes import print_diff, read_text
from osc2tx.cli.options import (
    affected_option,
    affected_sources,
    cache_option,
    seen_from,
    stated_sources,
    target_options,
    workers_option,
)
from osc2tx.cli.progress import progress_bar
from osc2tx.cli.reporting import Exit, Reporter, count_of, found, report_options
from osc2tx.compilation.inputs import InputError
from osc2tx.config import Config, ConfigError, ConfigFiles, GivenOptions
from osc2tx.diagnostics.report import FileFault
from osc2tx.options import PRODUCT_NAMES, ProductName
from osc2tx.support.paths import is_committed, real_path
from osc2tx_shared.cache import cache_folder
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.links import target_outside
from osc2tx_shared.text import complain, put, visible

if TYPE_CHECKING:
    from osc2tx.building.build import BuildOptions, BuildResult, Change
    from osc2tx.building.results import FileResult
    from osc2tx.compilation.driver import Compilation

POLL_SECONDS = 0.3  # between two looks of --watch


@dataclass(frozen=True, slots=True)
class _Task:
    """The request of the command line and the settings."""

    paths: tuple[str, ...]
    out_dir: Path
    given: GivenOptions
    reporter: Reporter
    options: BuildOptions

    @property
    def is_kept(self) -> bool:
        """Whether results are kept for the next build."""
        return cache_folder(self.options.cache) is not None


@click.command()
@click.argument("paths", metavar="[PATH...]", nargs=-1, type=click.Path())
@click.option("-o", "--out", "out_dir", type=click.Path(path_type=Path), help="Output folder.")
@target_options
@click.option(
    "--emit",
    type=click.Choice(PRODUCT_NAMES),
    help="Print this product of the compiler and write nothing.",
)
@click.option(
    "--check",
    "check_only",
    is_flag=True,
    help="Write nothing; fail if an output is stale, missing, edited by hand or orphaned.",
)
@click.option("--diff", is_flag=True, help="Write nothing; print what would change.")
@click.option(
    "--diff-against",
    metavar="GIT_REV",
    help="Print what changed since the sources of a revision, both built by this osc2tx.",
)
@affected_option
@click.option("--watch", is_flag=True, help="Build again whenever a source changes.")
@click.option("--force", is_flag=True, help="Overwrite edited outputs as well.")
@click.option("--prune", is_flag=True, help="Remove outputs whose source no longer exists.")
@workers_option
@cache_option
@report_options
def build(
    paths: tuple[str, ...],
    out_dir: Path | None,
    given: GivenOptions,
    emit: ProductName | None,
    check_only: bool,
    diff: bool,
    diff_against: str | None,
    affected: str | None,
    watch: bool,
    force: bool,
    prune: bool,
    workers: int | None,
    cache: Path | None,
    reporter: Reporter,
) -> Exit:
    """Write a py_trees module for every scenario file, and OpenSCENARIO XML where it is exact.

    Without PATH and --out, `sources` and `out` of the settings file count. Without PATH, outputs
    whose source has vanished are removed.
    """
    reads_only = check_only or diff or diff_against is not None
    if emit is not None:
        if out_dir is not None or reads_only or watch or force or prune:
            raise click.UsageError("--emit prints to the terminal and takes only paths")
        if reporter.form != "text":
            raise click.UsageError("--emit and --output-format both print to standard output")
        return _print_product(paths, given, emit, reporter)
    if affected is not None and (watch or diff_against):
        raise click.UsageError("--affected-since is for one build, not --watch or --diff-against")
    if (reads_only and (watch or force or prune)) or (diff_against and (check_only or diff)):
        raise click.UsageError(
            "use one of --check/--diff, --diff-against and --watch; "
            "--force and --prune are for builds that write"
        )
    if diff and reporter.form != "text":
        raise click.UsageError("--diff and --output-format both print to standard output")
    from osc2tx.building.build import BuildOptions
    from osc2tx.building.workers import processors

    is_whole = not paths and affected is None
    sources, out = _places(paths, out_dir)
    sources = affected_sources(sources, affected, given)
    options = BuildOptions(
        check_only=reads_only,
        force=force,
        prune=prune or is_whole,
        workers=workers or processors(),
        want_texts=diff,
        cache=cache,
    )
    task = _Task(sources, out, given, reporter, options)
    if diff_against is not None:
        return _diff_against(task, diff_against)
    if reads_only:
        return _compare(task, check=check_only)
    return _watch(task) if watch else _write(task)[0]


def _places(paths: tuple[str, ...], out_dir: Path | None) -> tuple[tuple[str, ...], Path]:
    """Return sources and output folder, from the settings of this folder where none are given."""
    here = Path.cwd()
    project = ConfigFiles().for_folder(here) if not paths or out_dir is None else Config()
    sources = paths or stated_sources(project, "build")
    return sources, _stated_out_dir(project, here) if out_dir is None else _written_out_dir(out_dir)


def _written_out_dir(out_dir: Path) -> Path:
    target = target_outside(out_dir)
    if target is not None:
        raise click.UsageError(
            f"`-o {out_dir}`: a link leads to {target}, out of the current folder; name that folder"
        )
    if out_dir.exists() and not out_dir.is_dir():
        raise click.UsageError(f"`-o {out_dir}`: is a file; name a folder for the outputs")
    return out_dir


def _stated_out_dir(project: Config, here: Path) -> Path:
    """Return the output folder of the settings, seen from a folder.

    Raises:
        click.UsageError: There is none, or it is not in the project, which may be a stranger's.
    """
    if project.out is None or project.folder is None:
        raise click.UsageError("state the output folder, as in `-o generated`, or set `out`")
    out_dir = seen_from(project.out, here)
    if not real_path(project.out).is_relative_to(real_path(project.folder)):
        raise click.UsageError(
            f"{project.path}: `out` leads to {real_path(project.out)}, out of the project; to write"
            " there, name that folder with `-o`"
        )
    return out_dir


def _run(task: _Task) -> tuple[BuildResult, Exit, str]:
    """Build, print the diagnostics; return the exit code for them, and a summary."""
    from osc2tx.building.build import build as build_files

    configs = ConfigFiles()
    with progress_bar("compiling", is_kept=task.is_kept) as progress:
        result = build_files(
            task.paths,
            task.out_dir,
            task.given,
            task.options,
            configs=configs,
            progress=progress,
            waiting=_print_waiting,
        )
    changes = result.changes if task.options.check_only else ()
    faults = [
        FileFault(change.path.as_posix(), "stale-output", _fault(change)) for change in changes
    ]
    baselines = Baselines(configs)
    code, report = task.reporter.report(result.results, result.bugs, faults, baselines)
    if any(Path(path).is_dir() for path in task.paths):
        code = max(code, task.reporter.warn(configs.unmatched_tables()))
    for problem in (*result.collisions, *result.failures):
        complain(problem)
    if result.collisions:
        code = max(code, Exit.USAGE)
    if result.failures:
        code = max(code, Exit.UNREADABLE)
    return result, code, found(report)


def _print_waiting(process: str) -> None:
    complain(f"waiting for the build of process {process}")


def _write(task: _Task) -> tuple[Exit, Sequence[FileResult]]:
    from osc2tx.building.plan import PROTECTED, State

    result, code, counts = _run(task)
    for change in result.remaining():
        if change.state in PROTECTED:
            complain(f"{change.path}: {change.state.value}; --force overwrites it")
            code = max(code, Exit.STALE)
        elif change.state is State.ORPHANED and is_committed(change.path.name):
            remedy = "--prune" if change.is_untouched else "it was edited; --prune --force"
            complain(f"{change.path}: {_orphaned(change)}; {remedy} removes it")
    removed = [c for c in result.changes if c.state is State.ORPHANED and c.path in result.written]
    done = f"{count_of(len(result.written) - len(removed), 'file')} written"
    done += f", {len(removed)} removed" if removed else ""
    _print_losses(task.reporter, result.results)
    made = count_of(result.modules, "source" if task.given.target == "xosc" else "module")
    task.reporter.say(f"{made} in {task.out_dir}: {done}; {counts}")
    return code, result.results


def _print_losses(reporter: Reporter, results: Sequence[FileResult]) -> None:
    """Summarize the results of scenarios as XML; one line each if only XML is requested."""
    losses = [(result, loss) for result in results for loss in result.losses]
    for result, loss in losses:
        if result.job.options.target == "xosc":
            reporter.say(f"{result.job.name}: {loss.scenario}: {loss.summary}")
    others = [loss for result, loss in losses if result.job.options.target != "xosc"]
    written = sum(loss.is_written for loss in others)
    if written < len(others):
        scenarios = count_of(len(others), "scenario")
        reporter.say(f"XML for {written} of {scenarios}; the reports state the reasons")


def _compare(task: _Task, *, check: bool) -> Exit:
    diff = task.options.want_texts
    result, code, counts = _run(task)
    for change in result.changes:
        if diff and change.text is not None:
            print_diff(str(change.path), read_text(change.path), change.text)
    summary = f"{count_of(result.modules, 'module')} in {task.out_dir}: "
    summary += f"{count_of(len(result.changes), 'file')} would change; {counts}"
    (complain if diff else task.reporter.say)(summary)
    return max(code, Exit.STALE) if check and result.changes else code


def _fault(change: Change) -> str:
    return _orphaned(change) if change.origin else change.state.value


def _orphaned(change: Change) -> str:
    return f"{change.state.value}: {change.origin} does not produce this file"


def _diff_against(task: _Task, revision: str) -> Exit:
    """Print the outputs of the present sources, compared with those of a revision."""
    from osc2tx.building.compare import compare_with, diff_lines

    configs = ConfigFiles()
    with progress_bar("compiling", is_kept=task.is_kept) as progress:
        comparison = compare_with(
            revision,
            task.paths,
            task.given,
            workers=task.options.workers,
            cache=task.options.cache,
            configs=configs,
            progress=progress,
        )
    reads_document = task.reporter.form != "text"
    paths = {each: (task.out_dir / each.path).as_posix() for each in comparison.differences}
    faults = [
        FileFault(
            path,
            "changed-output",
            f"changed since {revision}",
            "".join(diff_lines(path, each.old, each.new)),
        )
        for each, path in paths.items()
        if reads_document
    ]
    code, report = task.reporter.report(
        comparison.results, comparison.bugs, faults, Baselines(configs)
    )
    for problem in comparison.problems:
        complain(problem)
    for each, path in () if reads_document else paths.items():
        print_diff(path, each.old, each.new)
    changed = count_of(len(comparison.differences), "file")
    complain(f"{changed} changed since {revision}; {found(report)}")
    return code


def _watch(task: _Task) -> Exit:
    """Build whenever a source changes, until interrupted."""
    from time import sleep

    from osc2tx.building.watch import files_read, rounds

    files: set[str] = set()
    for _ in rounds(task.paths, files.copy, lambda: sleep(POLL_SECONDS)):
        try:
            files |= files_read(_write(task)[1])
        except (ConfigError, InputError) as error:
            complain(f"osc2tx: error: {error}")
    return Exit.OK


def _print_product(
    paths: Sequence[str], given: GivenOptions, emit: ProductName, reporter: Reporter
) -> Exit:
    if not paths:
        raise click.UsageError("nothing to compile: name a file or folder")
    if emit == "xosc" and given.target is None:
        given = replace(given, target="xosc")
    from osc2tx.compilation.dump import dump_product

    compilations = compile_all(paths, given)

    texts: list[str] = []

    def dump(compilation: Compilation) -> None:
        if emit == "xosc":
            compilation.check()
        text = dump_product(compilation, emit)
        if text is not None:
            head = f"# {visible(str(compilation.path))}\n" if len(compilations) > 1 else ""
            texts.append(head + text)

    bugs = run_all(compilations, dump)
    for text in texts:
        put(text)
    return reporter.report(compilations, bugs)[0]

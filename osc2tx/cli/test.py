"""`osc2tx test`: runs the scenarios of a project as tests, with pytest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path

import click

from osc2tx.cli.options import (
    affected_option,
    affected_sources,
    cache_option,
    sources_or_stated,
    workers_option,
)
from osc2tx.cli.reporting import Exit, quiet_option, wants_color
from osc2tx.compilation.inputs import find_inputs
from osc2tx.config import GivenOptions
from osc2tx_runtime.running.output_files import problem_of
from osc2tx_shared.text import complain

FEWEST_FILES = 8  # for a second process, which loads everything anew
FILE = click.Path(dir_okay=False, path_type=Path)


@click.command()
@click.argument("paths", metavar="[PATH]...", nargs=-1, type=click.Path())
@click.option("-k", "keyword", metavar="EXPRESSION", help="Only names that match, as with pytest.")
@click.option(
    "--where",
    metavar="'NAME == VALUE'",
    multiple=True,
    help="Only scenarios that fix this value; also != < <= > >=. May be repeated.",
)
@click.option("--shard", metavar="K/N", help="Only the K-th of N parts, for jobs of CI.")
@affected_option
@workers_option
@click.option(
    "--fail-on", metavar="WHAT", multiple=True, help="Fail on this event, as `osc2tx run` does."
)
@click.option("--junit", type=FILE, metavar="FILE", help="Write the results as JUnit XML.")
@click.option(
    "--traces",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write traces, a page for each, and an index page.",
)
@click.option(
    "--page",
    type=FILE,
    metavar="FILE",
    help="Write the page of the project: verdicts by requirement or other value, XML by reason.",
)
@click.option(
    "--campaign",
    "campaigns",
    type=FILE,
    multiple=True,
    metavar="STORE",
    help="List a campaign on the page.",
)
@cache_option
@quiet_option
def test(
    paths: tuple[str, ...],
    keyword: str | None,
    where: tuple[str, ...],
    shard: str | None,
    affected: str | None,
    workers: int | None,
    fail_on: tuple[str, ...],
    junit: Path | None,
    traces: Path | None,
    page: Path | None,
    campaigns: tuple[Path, ...],
    cache: Path | None,
    quiet: bool,
) -> Exit:
    """Run scenarios, each with the settings of its file; folders are searched for .osc files.

    Without PATH, `sources` of the settings file count. A test passes if its run ends with the
    `verdict` of the settings, which is `success` unless stated. `pytest PATH` runs the same tests.
    """
    if find_spec("pytest") is None:
        raise click.UsageError("`osc2tx test` needs pytest: pip install pytest")
    import pytest

    sources = affected_sources(sources_or_stated(paths, "test"), affected, GivenOptions())
    if not sources:
        complain(f"no scenario is affected by changes since {affected}")
        return Exit.OK
    found = find_inputs(sources)
    if campaigns and page is None:
        raise click.UsageError("--campaign adds to the page: give --page as well")
    for name, place in {"junit": junit, "page": page}.items():
        problem = None if place is None else problem_of(name, place)
        if problem is not None:
            raise click.UsageError(f"--{name} {problem}")
    options = {
        "-k": keyword,
        "--osc-shard": shard,
        "--junitxml": junit,
        "--osc-traces": traces,
        "--osc-page": page,
        "--osc-cache-dir": cache,
        "--osc-jobs": workers,
    }
    arguments = [
        *(f"{name}={value}" if name != "-k" else f"-k{value}" for name, value in _given(options)),
        *(f"--osc-where={each}" for each in where),
        *(f"--osc-fail-on={each}" for each in fail_on),
        *(f"--osc-campaign={each}" for each in campaigns),
        *_processes(workers, len(found)),
    ]
    look = ["-qq" if quiet else "-q", "--tb=no", "-rN", "--no-header"]
    look += ["-W", "ignore::pytest.PytestAssertRewriteWarning"]  # osc2tx is loaded already
    look.append(f"--color={'yes' if wants_color() else 'no'}")
    code = pytest.main(
        [*look, *arguments, "-o", "python_files=", "--", *(str(each.path) for each in found)]
    )
    return _exit_code(pytest.ExitCode(code))


def _given(options: Mapping[str, object]) -> Iterator[tuple[str, object]]:
    yield from ((name, value) for name, value in options.items() if value is not None)


def _processes(workers: int | None, files: int) -> list[str]:
    """Return the options of pytest-xdist, if it is installed."""
    from osc2tx.building.workers import processors

    has_processes = find_spec("xdist") is not None
    if workers is not None and workers > 1 and not has_processes:
        raise click.UsageError("--jobs needs pytest-xdist: pip install pytest-xdist")
    count = min(workers or processors(), files)
    is_worth_it = has_processes and count > 1 and files >= FEWEST_FILES
    return [f"--numprocesses={count}"] if is_worth_it else []


def _exit_code(code: int) -> Exit:
    from pytest import ExitCode

    if code == ExitCode.NO_TESTS_COLLECTED:
        complain("no scenario to run: none can run by itself, or none is selected")
    return {
        ExitCode.OK: Exit.OK,
        ExitCode.TESTS_FAILED: Exit.FAILED,
        ExitCode.INTERRUPTED: Exit.INTERRUPTED,
        ExitCode.USAGE_ERROR: Exit.USAGE,
        ExitCode.NO_TESTS_COLLECTED: Exit.USAGE,
    }.get(ExitCode(code), Exit.BUG)

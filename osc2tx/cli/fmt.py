"""`osc2tx fmt`."""

from __future__ import annotations

from pathlib import Path

import click

from osc2tx.building.jobs import compile_all, run_all
from osc2tx.cli.file_changes import print_diff, write_source
from osc2tx.cli.options import compile_options, sources_or_stated
from osc2tx.cli.reporting import Exit, Reporter, count_of, report_options
from osc2tx.cli.standard_input import is_standard_input, job_of_standard_input, stdin_filename
from osc2tx.compilation.driver import Compilation
from osc2tx.config import GivenOptions
from osc2tx.diagnostics.report import FileFault
from osc2tx_shared.text import complain, put


@click.command()
@click.argument("paths", metavar="[PATH]...", nargs=-1, type=click.Path())
@click.option("--check", "check_only", is_flag=True, help="Write nothing; fail if a file differs.")
@click.option("--diff", "show_diff", is_flag=True, help="Write nothing; print what would change.")
@compile_options
@stdin_filename
@report_options
def fmt(
    paths: tuple[str, ...],
    check_only: bool,
    show_diff: bool,
    given: GivenOptions,
    stdin_filename: str | None,
    reporter: Reporter,
) -> Exit:
    """Format scenario files in the style of the standard; folders are searched for .osc files.

    Tokens and comments are not changed. Files with syntax errors are not touched. Without PATH,
    `sources` of the settings file are used; `-` is standard input, and its text goes to standard
    output.
    """
    if show_diff and reporter.form != "text":
        raise click.UsageError("--diff and --output-format both print to standard output")
    if is_standard_input(paths, stdin_filename):
        job, text = job_of_standard_input(stdin_filename, given)
        return _format_input(
            job.compilation(text=text), reporter, check_only=check_only, show_diff=show_diff
        )
    compilations = compile_all(sources_or_stated(paths, "format"), given)
    formatted: dict[Path, str] = {}

    def format_one(compilation: Compilation) -> None:
        text = compilation.formatted
        if text is not None and _differs(compilation.path, text):
            formatted[compilation.path] = text

    bugs = run_all(compilations, format_one)
    wrong = formatted if check_only and not show_diff else ()
    faults = [FileFault(path.as_posix(), "not-formatted", "is not formatted") for path in wrong]
    code, _ = reporter.report(compilations, bugs, faults)
    for path, text in formatted.items():
        if show_diff:
            print_diff(str(path), path.read_bytes().decode("utf-8"), text)
        elif not check_only:
            code = max(code, write_source(path, text.encode()))
    would = "would be " if check_only or show_diff else ""
    total = count_of(len(compilations), "file")
    say = complain if show_diff else reporter.say
    say(f"{len(formatted)} of {total} {would}formatted")
    return max(code, Exit.STALE) if formatted and (check_only or show_diff) else code


def _format_input(
    compilation: Compilation, reporter: Reporter, *, check_only: bool, show_diff: bool
) -> Exit:
    bugs = run_all([compilation], lambda item: item.formatted)
    code, _ = reporter.report([compilation], bugs)
    source, text = compilation.source, None if bugs else compilation.formatted
    if source is None or text is None:
        return code
    differs = text != source.text
    if show_diff and differs:
        print_diff(compilation.name, source.text, text)
    elif check_only and differs:
        complain(f"{compilation.name}: is not formatted")
    elif not check_only and not show_diff:
        put(text.removesuffix("\n"))
    return max(code, Exit.STALE) if differs and (check_only or show_diff) else code


def _differs(path: Path, text: str) -> bool:
    """Whether a file is not formatted; a working copy may have line ends of Windows throughout."""
    data = path.read_bytes()
    return data not in (text.encode(), text.replace("\n", "\r\n").encode())

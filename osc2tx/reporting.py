"""What a command says at its end: diagnostics in the form asked for, a summary, an exit code.

Text for people goes to stderr and the summary to stdout; with a form for programs, that form alone
goes to stdout, and all else to stderr.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args

import click

from osc2tx import __version__
from osc2tx.diagnostics import render
from osc2tx.diagnostics.report import Report, ScenarioEntry, make_report

if TYPE_CHECKING:
    from osc2tx.driver import Compilation

OutputFormat: TypeAlias = Literal["text", "json", "sarif", "github"]
OUTPUT_FORMATS: tuple[OutputFormat, ...] = get_args(OutputFormat)
FORMATS_FOR_READERS: tuple[OutputFormat, ...] = ("text", "github")
MOST_SHOWN = 50  # diagnostics of one file, where people read them
BUG_REPORT = "osc2tx: this is a bug of osc2tx; please report it with the lines above"


class Exit(IntEnum):
    """What the process returns."""

    OK = 0
    STALE = 1
    WARNINGS = 1  # under --strict
    USAGE = 2
    ERRORS = 3
    UNREADABLE = 4
    FAILED = 5
    BUG = 70
    INTERRUPTED = 130


@dataclass(frozen=True, slots=True)
class Reporter:
    """Prints what a command has to say.

    Attributes:
        form: How diagnostics are printed.
        is_strict: Whether warnings count for the exit code.
        most_shown: How many diagnostics of one file are shown, 0 for all; `None` leaves it to
            the form: readers are spared an avalanche, programs are not.
    """

    form: OutputFormat = "text"
    is_strict: bool = False
    most_shown: int | None = None

    def report(
        self, compilations: Sequence[Compilation], bugs: Sequence[str] = ()
    ) -> tuple[Exit, Report]:
        """Print all diagnostics, and bugs of ours.

        Returns:
            The exit code they call for, and what there is to report.
        """
        from osc2tx.driver import settle_all

        most = self.most_shown
        if most is None:
            most = MOST_SHOWN if self.form in FORMATS_FOR_READERS else 0
        settled = settle_all(compilations)
        report = make_report(
            settled.shown,
            files=len(compilations),
            suppressed=len(settled.suppressed),
            folder=Path.cwd(),
            most_shown=most,
        )
        report = replace(report, scenarios=tuple(_scenarios(compilations)))
        self._print(report, failed=bool(bugs))
        for bug in bugs:
            complain(bug)
        if bugs:
            complain(BUG_REPORT)
        return self._exit_code(compilations, report, bugs), report

    def report_nothing(self) -> None:
        """Print that there is nothing to report, where programs expect a document."""
        self._print(Report(), failed=False)

    def say(self, line: str) -> None:
        """Print a line that sums up, where it does not disturb."""
        click.echo(line, err=self.form != "text")

    def _print(self, report: Report, *, failed: bool) -> None:
        match self.form:
            case "text":
                _print_text(report)
            case "json":
                click.echo(render.render_json(report, version=__version__), nl=False)
            case "sarif":
                text = render.render_sarif(report, version=__version__, failed=failed)
                click.echo(text, nl=False)
            case "github":
                click.echo(render.render_github(report), nl=False)

    def _exit_code(
        self, compilations: Sequence[Compilation], report: Report, bugs: Sequence[str]
    ) -> Exit:
        if bugs:
            return Exit.BUG
        if not all(compilation.is_readable for compilation in compilations):
            return Exit.UNREADABLE
        if report.errors:
            return Exit.ERRORS
        return Exit.WARNINGS if self.is_strict and report.warnings else Exit.OK


def report_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options that say how to report; the command gets a `reporter`."""

    @wraps(command)
    def with_reporter(
        *args: Any,
        output_format: OutputFormat,
        strict: bool,
        max_diagnostics: int | None,
        **more: Any,
    ) -> Any:
        reporter = Reporter(output_format, strict, max_diagnostics)
        return command(*args, reporter=reporter, **more)

    options = (
        click.option(
            "--output-format",
            type=click.Choice(OUTPUT_FORMATS),
            default="text",
            help="Form of diagnostics; all but `text` go to standard output.",
        ),
        click.option("--strict", is_flag=True, help="Exit with 1 if there are warnings."),
        click.option(
            "--max-diagnostics",
            type=click.IntRange(min=0),
            metavar="N",
            help=f"Show at most N of one file, 0 for all.  [default: {MOST_SHOWN}; json, sarif: 0]",
        ),
    )
    for option in reversed(options):
        with_reporter = option(with_reporter)
    return with_reporter


def _print_text(report: Report) -> None:
    if not report.diagnostics:
        return
    color = sys.stderr.isatty() and "NO_COLOR" not in os.environ
    text = render.render_all(report.diagnostics, color=color, folder=report.folder)
    click.echo(text, err=True, color=color)
    for file, count in report.hidden.items():
        complain(f"{file}: {count} more not shown" if file else f"{count} more not shown")
    complain(f"`osc2tx explain {report.diagnostics[0].code}` says more about a code.")


def complain(message: str) -> None:
    """Print a message that belongs to no place in a source."""
    click.echo(message, err=True)


def found(report: Report) -> str:
    """Return the numbers of a report in words."""
    text = f"{count_of(report.errors, 'error')}, {count_of(report.warnings, 'warning')}"
    return f"{text}, {report.suppressed} suppressed" if report.suppressed else text


def count_of(number: int, noun: str) -> str:
    """Return a number with its noun."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _scenarios(compilations: Sequence[Compilation]) -> Iterator[ScenarioEntry]:
    for compilation in compilations:
        for found in compilation.levels:
            yield ScenarioEntry(
                source=found.scenario.span.source,
                name=found.scenario.qualified_name,
                level=found.level.value,
                open=tuple(opening.text for opening in found.open),
            )

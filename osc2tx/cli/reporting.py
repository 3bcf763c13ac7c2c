"""Output of a command: diagnostics in the requested form, a summary, an exit code.

Text for people goes to stderr and the summary to stdout; a form for programs goes to stdout alone,
everything else to stderr.
"""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Sequence
from enum import IntEnum
from pathlib import Path
from typing import Literal, TypeAlias, get_args

import click

from osc2tx.building.answers import Answer
from osc2tx.building.baseline import Baselines
from osc2tx.building.severities import Severities
from osc2tx.cli.options import gathered
from osc2tx.compilation.file_reports import Reportable, apply_suppressions
from osc2tx.config import ConfigFiles
from osc2tx.diagnostics import CODES, Severity
from osc2tx.diagnostics.report import FileFault, Report, display_name, make_report
from osc2tx.version import __version__
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.text import complain, is_watched, put, put_document, say


def wants_color(*, err: bool = False) -> bool:
    """Whether to color standard output, or standard error: `NO_COLOR`, `FORCE_COLOR`, a terminal.

    The first of the two variables that is not empty decides, else whether there is a terminal.
    """
    if os.environ.get("NO_COLOR"):
        return False
    return bool(os.environ.get("FORCE_COLOR")) or is_watched(err=err)


def columns() -> int | None:
    """Return the width of the terminal at standard output; None for files and pipes."""
    if not is_watched(err=False):
        return None
    from shutil import get_terminal_size  # with all that it knows of archives

    return get_terminal_size().columns


OutputFormat: TypeAlias = Literal["text", "json", "sarif", "github", "rdjson"]
OUTPUT_FORMATS: tuple[OutputFormat, ...] = get_args(OutputFormat)
FORMATS_FOR_READERS: tuple[OutputFormat, ...] = ("text", "github")
MOST_SHOWN = 50  # diagnostics of one file, where people read them
BUG_REPORT = "osc2tx: internal error; please report it with the lines above"


class Exit(IntEnum):
    """The exit code of the process."""

    OK = 0
    STALE = 1
    WARNINGS = 1  # under --strict
    USAGE = 2
    ERRORS = 3
    UNREADABLE = 4
    FAILED = 5
    BUG = 70
    INTERRUPTED = 130


@dataclass(slots=True)
class Session:
    """One run of the command line.

    Attributes:
        has_document: Whether a program that reads our output has got its document.
        answer: Where the answer to the command line is kept.
    """

    has_document: bool = False
    answer: Answer | None = None


@dataclass(frozen=True, slots=True)
class Reporter:
    """Prints the results of a command.

    Attributes:
        session: The run of the command line that this is for.
        form: How diagnostics are printed.
        is_strict: Whether warnings count for the exit code.
        most_shown: Number of diagnostics of one file to show, 0 for all; `None` leaves it to the
        form: few for readers, all for programs.
        is_quiet: Whether only errors are shown to readers.
        docs_url: Where the documentation is published, for programs that link to it.
    """

    session: Session
    form: OutputFormat = "text"
    is_strict: bool = False
    most_shown: int | None = None
    is_quiet: bool = False
    docs_url: str | None = None

    def report(
        self,
        compilations: Sequence[Reportable],
        bugs: Sequence[str] = (),
        faults: Sequence[FileFault] = (),
        baselines: Baselines | None = None,
    ) -> tuple[Exit, Report]:
        """Print all diagnostics, internal errors, and errors of files as a whole.

        Args and result are those of `judge`.
        """
        code, report = self.judge(compilations, bugs, faults, baselines)
        self._print(report, failed=bool(bugs))
        for bug in bugs:
            put(bug, err=True)
        if bugs:
            complain(BUG_REPORT)
        self._print_uncompiled(compilations)
        for fault in faults:
            if fault.diff is None:
                complain(f"{fault.file}: {fault.message}")
        return code, report

    def judge(
        self,
        compilations: Sequence[Reportable],
        bugs: Sequence[str] = (),
        faults: Sequence[FileFault] = (),
        baselines: Baselines | None = None,
    ) -> tuple[Exit, Report]:
        """Collect the report.

        Args:
            compilations: The files.
            bugs: Internal errors.
            faults: Errors of files as a whole.
            baselines: Hold the warnings that are known; those of the files if left out.

        Returns:
            The exit code, and the report.
        """
        most = self.most_shown
        if most is None:
            most = MOST_SHOWN if self.form in FORMATS_FOR_READERS else 0
        baselines = baselines or Baselines(ConfigFiles())
        settled = apply_suppressions(compilations, Severities(baselines.configs))
        shown = baselines.new_among(settled.shown)
        report = make_report(
            shown,
            files=len(compilations),
            suppressed=len(settled.suppressed) + len(settled.shown) - len(shown),
            folder=Path.cwd(),
            most_shown=most,
            is_for_readers=self.form in FORMATS_FOR_READERS and self.most_shown is None,
        )
        entries = (entry for item in compilations for entry in item.scenarios)
        report = replace(report, scenarios=tuple(entries), faults=tuple(faults))
        return self._exit_code(compilations, report, bugs), report

    def report_failed_start(self) -> None:
        """Print that there is nothing to report, where programs expect a document."""
        self._print(Report(), failed=False)

    def warn(self, sentences: Sequence[str]) -> Exit:
        """Print warnings without a position in a source; return the exit code they call for.

        Each is printed once, before all that is not a diagnostic.
        """
        for sentence in () if self.is_quiet else sentences:
            complain(f"warning: {sentence}")
        return Exit.WARNINGS if self.is_strict and sentences else Exit.OK

    @staticmethod
    def _print_uncompiled(compilations: Sequence[Reportable]) -> None:
        """Count files without an error of their own that a library keeps from being compiled."""
        waiting: Counter[str] = Counter()
        for each in compilations:
            errors = [r for r in each.reports if CODES[r.code].severity is Severity.ERROR]
            places = [report.primary.source for report in errors if report.primary is not None]
            own = each.source.identity if each.source is not None else None
            if places and all(place.identity != own for place in places):
                waiting[display_name(places[0], Path.cwd())] += 1
        for library, count in waiting.items():
            complain(f"{count_of(count, 'file')} not compiled because of errors in {library}")

    def say(self, line: str) -> None:
        """Print a line that sums up, where it does not disturb."""
        if not self.is_quiet:
            self.say_anyway(line)

    def say_anyway(self, line: str) -> None:
        """Print a line also under `--quiet`."""
        (say if self.form == "text" else complain)(line)

    def _print(self, report: Report, *, failed: bool) -> None:
        if self.form == "text":
            _print_text(_errors_of(report) if self.is_quiet else report)
        elif self.form != "github" and self.session.has_document:
            return  # a second document would spoil the first, as in the rounds of --watch
        else:
            self.session.has_document = True
            put_document(_document(report, self.form, failed=failed, docs_url=self.docs_url))

    def _exit_code(
        self, compilations: Sequence[Reportable], report: Report, bugs: Sequence[str]
    ) -> Exit:
        if bugs:
            return Exit.BUG
        if any(compilation.source is None for compilation in compilations):
            return Exit.UNREADABLE
        if report.errors:
            return Exit.ERRORS
        return Exit.WARNINGS if self.is_strict and report.warnings else Exit.OK


def _address(context: click.Context, parameter: click.Parameter, value: str | None) -> str | None:
    if value is not None and not re.fullmatch(r"https?://[!-~]+", value):
        raise click.BadParameter("is not an address that begins with `https://`")
    return value


quiet_option = click.option("-q", "--quiet", is_flag=True, help="Print only errors.")


def _reporter(
    output_format: OutputFormat,
    quiet: bool,
    strict: bool,
    max_diagnostics: int | None,
    docs_url: str | None,
) -> Reporter:
    session = click.get_current_context().find_object(Session) or Session()
    return Reporter(session, output_format, strict, max_diagnostics, quiet, docs_url)


report_options = gathered(
    "reporter",
    _reporter,
    click.option(
        "--output-format",
        type=click.Choice(OUTPUT_FORMATS),
        default="text",
        help="Form of diagnostics; all but `text` go to standard output.",
    ),
    quiet_option,
    click.option("--strict", is_flag=True, help="Exit with 1 if there are warnings."),
    click.option(
        "--max-diagnostics",
        type=click.IntRange(min=0),
        metavar="N",
        help=f"Show at most N of one file, 0 for all.  [default: {MOST_SHOWN}; documents: 0]",
    ),
    click.option(
        "--docs-url",
        metavar="URL",
        callback=_address,
        help="Address of a copy of this documentation, for links in SARIF and rdjson.",
    ),
)
"""Adds the options of reports; the command gets a `reporter`."""


def report_failure(message: str, arguments: Sequence[str], session: Session) -> None:
    """Print a document with the reason of a failed start, if a document is requested.

    Args:
        message: Why the command did not begin.
        arguments: The command line; it may be invalid, so only the form is read.
        session: Knows whether there is a document already.
    """
    form = _requested_form(arguments)
    if form != "text" and not session.has_document:
        session.has_document = True
        put_document(_document(Report(failure=message), form, failed=True))


def _requested_form(arguments: Sequence[str]) -> OutputFormat:
    form: OutputFormat = "text"
    for index, argument in enumerate(arguments):
        name, sign, value = argument.partition("=")
        if name == "--output-format":
            written = value if sign else "".join(arguments[index + 1 : index + 2])
            form = next((known for known in OUTPUT_FORMATS if known == written), form)
    return form


def _document(
    report: Report, form: OutputFormat, *, failed: bool, docs_url: str | None = None
) -> str:
    from osc2tx.diagnostics import render

    match form:
        case "json":
            return render.render_json(report, version=__version__)
        case "sarif":
            return render.render_sarif(
                report, version=__version__, failed=failed, docs_url=docs_url
            )
        case "github":
            return render.render_github(report)
        case "rdjson":
            return render.render_rdjson(report, docs_url=docs_url)
        case "text":
            raise ValueError("a text for people is no document")


def _errors_of(report: Report) -> Report:
    errors = tuple(d for d in report.diagnostics if d.severity is Severity.ERROR)
    return replace(report, diagnostics=errors)


def _print_text(report: Report) -> None:
    if not report.diagnostics:
        return
    from osc2tx.diagnostics.render import render_all  # mostly there is nothing to render

    color = wants_color(err=True)
    text = render_all(report.diagnostics, color=color, folder=report.folder)
    put(f"{text}\n", err=True, colored=color)
    for file, count in report.hidden.items():
        complain(f"{file}: {count} more not shown" if file else f"{count} more not shown")
    complain(f"`osc2tx explain {report.diagnostics[0].code}` explains the code.")


def found(report: Report) -> str:
    """Return the numbers of a report in words."""
    text = f"{count_of(report.errors, 'error')}, {count_of(report.warnings, 'warning')}"
    return f"{text}, {report.suppressed} suppressed" if report.suppressed else text


def count_of(number: int, noun: str) -> str:
    """Return a number with its noun."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"

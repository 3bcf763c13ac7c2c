"""`osc2tx check --fix`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from osc2tx.building.fixing import FixedText, fix_text, has_fix
from osc2tx.building.jobs import Job, run_all
from osc2tx.cli.diff_output import print_diff
from osc2tx.cli.reporting import Exit, Reporter
from osc2tx.cli.source_files import write_source
from osc2tx_shared.classes import dataclass
from osc2tx_shared.text import complain, put

if TYPE_CHECKING:
    from osc2tx.building.results import FileResult

BYTE_ORDER_MARK = b"\xef\xbb\xbf"


@dataclass(frozen=True, slots=True)
class Fixes:
    """Which fixes to apply.

    Attributes:
        unsafe: Whether to apply also those that may not be meant.
        show_diff: Whether to print the changes instead of writing them.
    """

    unsafe: bool
    show_diff: bool


def fixes_to_apply(*, is_fixing: bool, unsafe: bool, show_diff: bool) -> Fixes:
    """Return the fixes that a command line with these options requests.

    Raises:
        click.UsageError: If unsafe fixes are allowed without `--fix` or `--diff`.
    """
    if not is_fixing and not show_diff:
        raise click.UsageError("--unsafe-fixes is for --fix and --diff")
    return Fixes(unsafe, show_diff)


def fix_files(
    results: Sequence[FileResult], fixes: Fixes, reporter: Reporter
) -> tuple[list[Job], Exit]:
    """Fix files, or print how; return the jobs of those that were written, and the exit code."""
    written: list[Job] = []
    code, number = Exit.OK, 0
    for result in results:
        source = result.source
        if source is None or not has_fix(result.reports, source, unsafe=fixes.unsafe):
            continue
        fixed = fix_text(result.job, source.text, unsafe=fixes.unsafe)
        if fixed.text == source.text:
            continue
        number += fixed.applied
        if fixes.show_diff:
            print_diff(str(result.job.path), source.text, fixed.text)
            code = max(code, Exit.STALE)
            continue
        path = result.job.path
        mark = BYTE_ORDER_MARK if path.read_bytes().startswith(BYTE_ORDER_MARK) else b""
        outcome = write_source(path, mark + fixed.text.encode())
        code = max(code, outcome)
        if outcome is Exit.OK:
            written.append(result.job)
    would = "would be " if fixes.show_diff else ""
    say = complain if fixes.show_diff else reporter.say
    say(f"{number or 'no'} fix{'' if number == 1 else 'es'} {would}applied")
    return written, code


def fix_input(job: Job, text: str, fixes: Fixes, reporter: Reporter) -> Exit:
    """Print the fixed text of standard input, or its diff."""
    fixed: FixedText = fix_text(job, text, unsafe=fixes.unsafe)
    if fixes.show_diff:
        print_diff(job.name, text, fixed.text)
        return Exit.STALE if fixed.text != text else Exit.OK
    compilation = job.compilation(text=fixed.text)
    bugs = run_all([compilation], lambda item: item.check())
    code, _ = reporter.report([compilation], bugs)
    put(fixed.text.removesuffix("\n"))
    return code

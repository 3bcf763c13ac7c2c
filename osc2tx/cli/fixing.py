"""`osc2tx check --fix`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from osc2tx.building.fixing import FixedText, fix_text, has_fix
from osc2tx.building.jobs import Job, run_all
from osc2tx.cli.file_changes import print_diff, write_source
from osc2tx.cli.reporting import Exit, Reporter
from osc2tx_shared.text import complain, put

if TYPE_CHECKING:
    from osc2tx.building.results import FileResult

BYTE_ORDER_MARK = b"\xef\xbb\xbf"


def fix_files(
    results: Sequence[FileResult], reporter: Reporter, *, unsafe: bool, show_diff: bool
) -> tuple[list[Job], Exit]:
    """Fix files, or print how; return the jobs of those that were written, and the exit code.

    Args:
        results: The files.
        reporter: Prints how many fixes there are.
        unsafe: Whether to apply also fixes that may not be meant.
        show_diff: Whether to print the changes instead of writing them.
    """
    written: list[Job] = []
    code, number = Exit.OK, 0
    for result in results:
        source = result.source
        if source is None or not has_fix(result.reports, source, unsafe=unsafe):
            continue
        fixed = fix_text(result.job, source.text, unsafe=unsafe)
        if fixed.text == source.text:
            continue
        number += fixed.applied
        if show_diff:
            print_diff(str(result.job.path), source.text, fixed.text)
            code = max(code, Exit.STALE)
            continue
        path = result.job.path
        mark = BYTE_ORDER_MARK if path.read_bytes().startswith(BYTE_ORDER_MARK) else b""
        outcome = write_source(path, mark + fixed.text.encode())
        code = max(code, outcome)
        if outcome is Exit.OK:
            written.append(result.job)
    would = "would be " if show_diff else ""
    say = complain if show_diff else reporter.say
    say(f"{number or 'no'} fix{'' if number == 1 else 'es'} {would}applied")
    return written, code


def fix_input(job: Job, text: str, reporter: Reporter, *, unsafe: bool, show_diff: bool) -> Exit:
    """Print the fixed text of standard input, or its diff; arguments as of `fix_files`."""
    fixed: FixedText = fix_text(job, text, unsafe=unsafe)
    if show_diff:
        print_diff(job.name, text, fixed.text)
        return Exit.STALE if fixed.text != text else Exit.OK
    compilation = job.compilation(text=fixed.text)
    bugs = run_all([compilation], lambda item: item.check())
    code, _ = reporter.report([compilation], bugs)
    put(fixed.text.removesuffix("\n"))
    return code

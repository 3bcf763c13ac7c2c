"""`osc2tx report`: pages of traces that were written before."""

from __future__ import annotations

from pathlib import Path

import click

from osc2tx.cli.reporting import Exit
from osc2tx_runtime.errors import InputError, ScenarioError
from osc2tx_runtime.running.trace_reports import folder_report, trace_report
from osc2tx_shared.text import complain, say


@click.command()
@click.argument("traces", metavar="TRACE [TRACE] | FOLDER", nargs=-1, required=True, type=Path)
@click.option(
    "-o", "--out", type=Path, metavar="PATH", help="The page; for a FOLDER, the output folder."
)
@click.option(
    "--map-path", type=Path, multiple=True, metavar="PATH", help="Folder with maps, or the map."
)
def report(traces: tuple[Path, ...], out: Path | None, map_path: tuple[Path, ...]) -> Exit:
    """Make the report of a run from its trace, or of two runs over each other.

    Of a FOLDER, every trace (.jsonl) below it gets a page, and index.html lists them all. Without
    --out, pages are beside their traces. A map that is not found is omitted, with a warning.
    """
    if len(traces) > 2:
        raise click.UsageError("a page shows one run or two; for more, give their folder")
    try:
        if len(traces) == 1 and traces[0].is_dir():
            page, warnings = folder_report(traces[0], out or traces[0], map_path)
        else:
            page, warnings = trace_report(traces, out, map_path)
    except (InputError, ScenarioError) as error:
        complain(f"osc2tx: error: {error}")
        return Exit.UNREADABLE
    for warning in warnings:
        complain(f"osc2tx: warning: {warning}")
    say(str(page))
    return Exit.OK

"""`osc2tx campaign replay` and `export`: one row again, and tables of all."""

from __future__ import annotations

from pathlib import Path

import click

from osc2tx.campaigns import CampaignError
from osc2tx.campaigns.export import export_rows
from osc2tx.campaigns.replay import replay_row
from osc2tx.campaigns.store import Store
from osc2tx.cli.reporting import Exit
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.running.main import verdict
from osc2tx_text import complain, say

STORE = click.Path(dir_okay=False, path_type=Path)
FILE = click.Path(dir_okay=False, path_type=Path)


@click.command()
@click.argument("store", metavar="STORE", type=STORE)
@click.argument("row", metavar="ROW", type=click.IntRange(min=0))
@click.option("--trace", metavar="FILE", type=FILE, help="Write the trace (JSON Lines).")
@click.option("--report", metavar="FILE", type=FILE, help="Write the report (HTML).")
@click.option(
    "--map-path",
    type=click.Path(exists=True, path_type=Path),
    multiple=True,
    metavar="PATH",
    help="Folder with maps, or the map itself, if it is no longer where it was.",
)
def replay(
    store: Path, row: int, trace: Path | None, report: Path | None, map_path: tuple[Path, ...]
) -> Exit:
    """Run one row of a campaign again, from what the store knows, and write its files.

    The run is the same to the last byte of its trace. If it is not, as in another version of
    osc2tx or on another map, that is an error.
    """
    try:
        with Store(store) as opened:
            name, result = replay_row(opened, row, trace, report, map_path)
    except CampaignError as error:
        raise click.UsageError(str(error)) from None
    except ScenarioError as error:
        complain(f"{error.source or store}: error: {error.message}")
        return Exit(error.exit_code)
    for line in verdict(f"{name}, row {row}", result):
        say(line)
    return Exit.OK if result.status == "success" else Exit.FAILED


@click.command()
@click.argument("store", metavar="STORE", type=STORE)
@click.argument("file", metavar="FILE", type=FILE)
def export(store: Path, file: Path) -> Exit:
    """Write all rows as a table: FILE.csv, or JSON Lines for FILE.jsonl.

    Columns: number, seed, status, reason, seconds of simulated time, `parameter NAME` and
    `kpi NAME`, all in SI units, and the digest of the trace if there is one. Numbers have all their
    digits.
    """
    try:
        with Store(store) as opened:
            rows = export_rows(opened, file)
    except CampaignError as error:
        raise click.UsageError(str(error)) from None
    say(f"{file}: {rows} rows")
    return Exit.OK

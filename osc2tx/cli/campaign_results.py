"""`osc2tx campaign report`, `replay` and `export`: its outcome, one row again, tables."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import click

from osc2tx.campaigns import CampaignError
from osc2tx.campaigns.coverage import has_models, overall
from osc2tx.campaigns.export import export_rows, write_text
from osc2tx.campaigns.junit import render_junit
from osc2tx.campaigns.project_page import project_page
from osc2tx.campaigns.replay import replay_row
from osc2tx.campaigns.report import render_report
from osc2tx.campaigns.store import Store
from osc2tx.campaigns.summary import FORMAT, Results, results_of, summary_of
from osc2tx.cli.reporting import Exit, count_of, quiet_option
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.running.main import verdict
from osc2tx_shared.text import complain, say


class StoreCommand(click.Command):
    """A command on the store of a campaign; reports why it cannot be used."""

    def invoke(self, ctx: click.Context) -> Exit:
        """Carry out the command."""
        try:
            return Exit(super().invoke(ctx))
        except CampaignError as error:
            raise click.UsageError(str(error), ctx) from None
        except ScenarioError as error:
            named = ctx.params.get("store") or ctx.params["stores"][0]
            complain(f"{error.source or named}: error: {error.message}")
            return Exit(error.exit_code)


STORE = click.Path(dir_okay=False, path_type=Path)
FILE = click.Path(dir_okay=False, path_type=Path)


@click.command(cls=StoreCommand)
@click.argument("store", metavar="STORE", type=STORE)
@click.argument("row", metavar="ROW", type=click.IntRange(min=0))
@click.option("--trace", metavar="FILE", type=FILE, help="Write the trace (JSON Lines).")
@click.option("--report", metavar="FILE", type=FILE, help="Write the report (HTML).")
@click.option(
    "--map-path",
    type=click.Path(exists=True, path_type=Path),
    multiple=True,
    metavar="PATH",
    help="Folder with maps, or the map itself, if it was moved.",
)
@quiet_option
def replay(
    store: Path,
    row: int,
    trace: Path | None,
    report: Path | None,
    map_path: tuple[Path, ...],
    quiet: bool,
) -> Exit:
    """Run one row of a campaign again, from the data in the store, and write its files.

    The run is the same to the last byte of its trace. If it is not, as in another version of
    osc2tx or on another map, that is an error. The Python module of the store is run: replay only
    stores of people whose code you would run.
    """
    with Store(store) as opened:
        _state_origin(opened)
        name, result = replay_row(opened, row, trace, report, map_path)
    succeeded = result.status == "success"
    for line in () if quiet and succeeded else verdict(f"{name}, row {row}", result):
        say(line)
    return Exit.OK if succeeded else Exit.FAILED


@click.command(cls=StoreCommand)
@click.argument("stores", metavar="STORE...", type=STORE, nargs=-1, required=True)
@click.option(
    "-o",
    "--output",
    "page",
    metavar="FILE",
    type=FILE,
    help="The page.  [default: STORE.html; of several: campaigns.html]",
)
@click.option("--against", metavar="STORE", type=STORE, help="An earlier campaign to compare with.")
@click.option("--summary", metavar="FILE", type=FILE, help="Write the summary as JSON.")
@click.option("--junit", metavar="FILE", type=FILE, help="Write the rows as JUnit XML.")
@click.option(
    "--fail-under",
    metavar="PERCENT",
    type=click.FloatRange(0.0, 100.0),
    help="Exit with 1 if the mean grade of coverage is less.",
)
@quiet_option
def report(
    stores: tuple[Path, ...],
    page: Path | None,
    against: Path | None,
    summary: Path | None,
    junit: Path | None,
    fail_under: float | None,
    quiet: bool,
) -> Exit:
    """Write the outcome of a campaign as one HTML page that loads nothing.

    Coverage holes come first, apart from the values that the constraints exclude; failures
    are grouped, each group with its shortest row and the command that repeats it. Coverage needs
    the Python module of the store, which is run. Several campaigns also get a page that lists them.
    """
    if against is not None and len(stores) > 1:
        raise click.UsageError("--against compares one campaign with an earlier one")
    campaigns = [_read(store) for store in stores]
    before = None if against is None else _read(against)
    pages = [store.with_suffix(".html") for store in stores]
    if len(stores) == 1:
        pages = [page or pages[0]]
    for results, place in zip(campaigns, pages, strict=True):
        write_text("report", place, render_report(results, before))
    if len(stores) > 1:
        _write_overview(page or Path("campaigns.html"), campaigns, pages)
    if summary is not None:
        write_text("summary", summary, json.dumps(_summary(campaigns), indent=1) + "\n")
    if junit is not None:
        write_text("junit", junit, render_junit(campaigns))
    for results, place in zip(campaigns, pages, strict=True):
        for line in () if quiet else _verdict(results, place):
            say(line)
    grade = overall(item for results in campaigns for item in results.items.values())
    if fail_under is not None and (grade is None or grade < fail_under):
        found = "nothing is covered" if grade is None else f"{grade:.1f} %"
        names = ", ".join(map(str, stores))
        complain(f"{names}: coverage {found}, required were {fail_under:g} %")
        return Exit.STALE
    return Exit.OK


def _summary(campaigns: Sequence[Results]) -> dict[str, Any]:
    """Return the figures of a campaign, or of several in a list."""
    summaries = [summary_of(results) for results in campaigns]
    return summaries[0] if len(summaries) == 1 else {"format": FORMAT, "campaigns": summaries}


def _write_overview(place: Path, campaigns: Sequence[Results], pages: Sequence[Path]) -> None:
    linked = [Path(os.path.relpath(each, place.parent)).as_posix() for each in pages]
    listed = tuple(zip(campaigns, linked, strict=True))
    write_text("page", place, project_page(campaigns=listed))


def _state_origin(store: Store) -> None:
    """State that a module of the store runs."""
    complain(
        f"{store.path}: runs {store.plan['module']} as stored: code of the author of the store"
    )


def _read(place: Path) -> Results:
    with Store(place) as opened:
        if has_models(opened):
            _state_origin(opened)
        return results_of(opened)


def _verdict(results: Results, place: Path) -> Iterator[str]:
    holes = sum(len(item.holes()) for item in results.items.values())
    grade = overall(results.items.values())
    covered = "" if grade is None else f", coverage {grade:.1f} %, {count_of(holes, 'hole')}"
    failed = sum(len(group.rows) for group in results.failures)
    yield (
        f"{place}: {count_of(len(results.runs), 'row')}, {failed} failed in"
        f" {count_of(len(results.failures), 'group')}{covered}"
    )


@click.command(cls=StoreCommand)
@click.argument("store", metavar="STORE", type=STORE)
@click.argument("file", metavar="FILE", type=FILE)
@quiet_option
def export(store: Path, file: Path, quiet: bool) -> Exit:
    """Write all rows as a table: FILE.csv, or JSON Lines for FILE.jsonl.

    Columns: number, seed, status, reason, seconds of simulated time, `parameter NAME` and
    `kpi NAME`, all in SI units, the number of conditions that did not hold, and the digest of the
    trace if there is one. Numbers have all their digits.
    """
    with Store(store) as opened:
        rows = export_rows(opened, file)
    if not quiet:
        say(f"{file}: {rows} rows")
    return Exit.OK

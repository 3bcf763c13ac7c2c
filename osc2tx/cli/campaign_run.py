"""`osc2tx campaign run`: runs rows and stores their outcomes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import click
from click.core import ParameterSource

from osc2tx.building.jobs import compile_all, run_all
from osc2tx.building.workers import processors
from osc2tx.campaigns import CampaignError
from osc2tx.campaigns.aims import Aim
from osc2tx.campaigns.cluster import engine_by_name
from osc2tx.campaigns.driver import Progress, run_campaign
from osc2tx.campaigns.engine import Engine
from osc2tx.campaigns.samplers import SAMPLERS
from osc2tx.campaigns.sampling import Wanted, wanted_rows
from osc2tx.campaigns.store import Store
from osc2tx.cli.options import compile_options
from osc2tx.cli.reporting import Exit, Reporter, count_of, report_options
from osc2tx.cli.run import (
    RunCommand,
    Texts,
    choose_scenario,
    merge_texts,
    option_texts,
    settings_from,
    with_maps_of,
)
from osc2tx.cli.written_modules import written_files
from osc2tx.compilation.inputs import InputError, find_inputs
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.config import CAMPAIGN_SETTINGS, ConfigError, ConfigFiles, GivenOptions
from osc2tx.module_loading import module_files
from osc2tx.support.paths import file_stem
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.campaigns import Condition, Modules, Plan
from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.kpis import MEASURES
from osc2tx_shared.classes import replace
from osc2tx_shared.text import complain, is_watched, visible


class CampaignCommand(RunCommand):
    """A command with the options of runs, but those that name files of one."""

    without = frozenset({"trace", "report"})

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Complete the command line by the settings of the file."""
        origin = ""
        for path in (Path(arg) for arg in args if arg.endswith((".osc", ".py"))):
            with suppress(ConfigError):  # reported when the settings are read
                config = ConfigFiles().for_source(path)
                stated, origin = config.campaign_settings(path), str(config.path)
                ctx.default_map = {
                    FIELDS.get(name, name.replace("-", "_")): _stated(name, texts)
                    for name, texts in stated.items()
                }
                break
        try:
            return super().parse_args(ctx, args)
        except click.BadParameter as error:
            name = "" if error.param is None else error.param.name or ""
            if ctx.get_parameter_source(name) is not ParameterSource.DEFAULT_MAP:
                raise
            raise ConfigError(f"{origin}: {error.format_message()}") from None


BROKEN = frozenset({"error", "crashed"})  # statuses of rows without a result of the scenario
FIELDS = {"kpi": "kpis"}  # where an option is called otherwise in `run`


def _stated(name: str, texts: tuple[str, ...]) -> str | tuple[str, ...]:
    (setting,) = (each for each in CAMPAIGN_SETTINGS if each.key == name)
    return texts if setting.is_list else texts[0]


@click.command(cls=CampaignCommand)
@click.argument("file", metavar="FILE", type=click.Path())
@click.option("--scenario", metavar="NAME", help="Scenario of the file to run.")
@click.option(
    "--samples",
    metavar="N",
    type=click.IntRange(min=1),
    help="Number of rows.  [default: that of the last call]",
)
@click.option(
    "--sampler",
    metavar="|".join(SAMPLERS),
    help="Method that chooses the values of rows.  [default: random]",
)
@click.option(
    "--search",
    metavar="KPI",
    help="Search for the worst value of a KPI: choose rows by the results of others; `min:KPI` or"
    " `max:KPI` defines the worst value.",
)
@click.option(
    "--search-batch",
    metavar="N",
    type=click.IntRange(min=1),
    default=16,
    help="Number of rows that a search chooses together.  [default: 16]",
)
@click.option(
    "--levels",
    metavar="N",
    type=click.IntRange(min=2),
    default=5,
    help="Values of a range for grid and pairwise.  [default: 5]",
)
@click.option(
    "--store",
    "place",
    metavar="FILE",
    type=click.Path(dir_okay=False, path_type=Path),
    help="File of the results.  [default: SCENARIO.campaign]",
)
@click.option(
    "--engine",
    metavar="local|dask://HOST:PORT",
    default="local",
    help="Where rows run: in local processes, or on a Dask cluster.  [default: local]",
)
@click.option(
    "--workers",
    metavar="N",
    type=click.IntRange(min=1),
    help="Number of processes.  [default: one per processor]",
)
@click.option(
    "--batch",
    metavar="N",
    type=click.IntRange(min=1),
    help="Number of rows per batch of a process.  [default: 16, 1 in a search]",
)
@click.option(
    "--timeout",
    metavar="SECONDS",
    type=click.FloatRange(min=0.0, min_open=True),
    help="Wall-clock limit: a row that takes longer is ended, and counts as crashed.",
)
@click.option(
    "--kpi",
    "kpis",
    metavar="NAME",
    multiple=True,
    help="Measures to take; `none` for none.  [default: all of osc2tx]",
)
@click.option(
    "--fail-if",
    metavar="KPI<NUMBER",
    multiple=True,
    help="A row also fails if this condition is true, in SI units: min_ttc<1.5",
)
@click.option("--digests", is_flag=True, help="Compute each trace, and store its digest.")
@compile_options
@report_options
def run(
    file: str,
    scenario: str | None,
    samples: int | None,
    sampler: str | None,
    search: str | None,
    search_batch: int,
    levels: int,
    place: Path | None,
    engine: str,
    workers: int | None,
    batch: int | None,
    timeout: float | None,
    kpis: tuple[str, ...],
    fail_if: tuple[str, ...],
    digests: bool,
    given: GivenOptions,
    reporter: Reporter,
    **written: str | bool | tuple[str, ...] | None,
) -> Exit:
    """Run a scenario many times, until its store has the requested number of rows.

    Rows that are in the store are not run again: after Ctrl-C, or any other end, the same command
    resumes the campaign. Samplers: `random` draws as `osc2tx run` does; `sobol` and `halton` fill
    the space evenly without an end, `lhs` for a number of rows; `grid` has all combinations of a
    few values, `pairwise` all pairs; `table:FILE` the rows of a CSV file. With `--search` there is
    no sampler: rows are chosen where others came near to the worst value.
    """
    path = Path(file)
    if path.is_dir():
        raise InputError(f"{path}: is a folder; name one scenario file")
    find_inputs([path])
    texts = {name: option_texts(value) for name, value in written.items()}
    try:
        texts = merge_texts(ConfigFiles().for_source(path), path, texts)
        settings = settings_from(texts, path)
        conditions = tuple(map(Condition.parse, fail_if))
    except SettingsError as error:
        raise click.UsageError(error.message) from None
    found = _files_of(path, scenario, with_maps_of(given, settings), reporter)
    if isinstance(found, Exit):
        return found
    files, module, name = found
    measures = tuple(MEASURES) if not kpis else tuple(each for each in kpis if each != "none")
    plan = Plan(files, module, name, settings, measures, conditions, digests)
    try:
        wanted = wanted_rows(plan, sampler, samples, levels, search, search_batch)
        at_once = batch or wanted.at_once
        runs_rows = engine_by_name(engine, at_once, processors(), workers, timeout)
        return _run(
            plan, texts, wanted, place or Path(f"{file_stem(name)}.campaign"), runs_rows, reporter
        )
    except CampaignError as error:
        raise click.UsageError(str(error)) from None
    except ScenarioError as error:
        complain(f"{error.source or path}: error: {error.message}")
        return Exit(error.exit_code)


def _run(
    plan: Plan, texts: Texts, wanted: Wanted, place: Path, engine: Engine, reporter: Reporter
) -> Exit:
    with Store(place, is_new=True) as store:
        wanted = replace(wanted, samples=wanted.samples or store.wanted)
        try:
            with progress_bar(plan.scenario) as show:
                ended = run_campaign(plan, texts, wanted, store, engine, show)
        except KeyboardInterrupt:
            done = sum(store.counts().values())
            complain(
                f"{plan.scenario}: interrupted with {count_of(done, 'row')} in {place}; repeat"
                " the command to resume"
            )
            return Exit.INTERRUPTED
        for line in summary(plan.scenario, store, ended, wanted.aim):
            reporter.say(line)
        return Exit.FAILED if ended.failed else Exit.OK


def summary(name: str, store: Store, ended: Progress, aim: Aim | None) -> Iterator[str]:
    """Yield the lines that describe the content of a store."""
    counts = ", ".join(f"{number} {status}" for status, number in store.counts().items())
    yield f"{name}: {count_of(ended.done, 'row')} in {store.path}, {ended.new} new: {counts}"
    if BROKEN & store.counts().keys():
        first = next(run for run in store.runs() if run["status"] in BROKEN)
        yield f"  row {first['number']}: {first['status']}: {first['reason']}"
    if ended.left_out:
        share = ended.done / (ended.done + ended.left_out)
        yield (
            f"  {count_of(ended.left_out, 'point')} of the sampler violate a constraint and were"
            f" omitted: {share:.3%} were accepted"
        )
    if aim:
        best = aim.best(store.measures())
        found = f"{best[1]:.6g} in row {best[0]} is the {aim.in_words} of all" if best else ""
        yield f"  {aim.kpi}: {found or 'no row has a value, so there was nothing to go by'}"


def _files_of(
    path: Path, scenario: str | None, given: GivenOptions, reporter: Reporter
) -> tuple[dict[str, str], str, str] | Exit:
    """Return the files of a scenario's module, the name of the module and of the scenario."""
    if path.suffix == ".py":
        reporter.report_failed_start()
        files, module = written_files(path)
    else:
        (compilation,) = compile_all([path], given)
        code, _ = reporter.report([compilation], run_all([compilation], lambda item: item.module))
        if code is not Exit.OK:
            return code
        if compilation.module is None:
            raise click.UsageError(f"{path} declares no scenario")
        files, module = module_files(compilation.module, sibling_modules(compilation))
    loaded = Modules(files)
    try:
        return files, module, choose_scenario(loaded.load(module), scenario, path).name
    except ScenarioError as error:
        raise InputError(f"{path}: {error.message}") from error
    finally:
        loaded.close()


OnProgress = Callable[[Progress], None]


@contextmanager
def progress_bar(name: str) -> Iterator[OnProgress]:
    """Yield the progress bar: rate, failures, remaining time; only on a terminal."""
    if not is_watched():
        yield lambda progress: None
        return
    from rich import progress as bars
    from rich.console import Console

    columns = (
        bars.TextColumn("{task.description}", markup=False),
        bars.BarColumn(),
        bars.TextColumn("{task.completed:.0f} of {task.total}, {task.fields[failed]} failed"),
        bars.TextColumn("{task.speed} rows/s"),
        bars.TimeRemainingColumn(),
    )
    with bars.Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(visible(name), total=None, failed=0)

        def show(progress: Progress) -> None:
            bar.update(task, completed=progress.done, total=progress.wanted, failed=progress.failed)

        yield show

"""Campaigns in tests: all rows at once by `run_campaign`, or a test for each row by a mark."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from osc2tx_shared.classes import dataclass
from osc2tx_shared.own_folders import CAMPAIGN, own_folder

if TYPE_CHECKING:
    from osc2tx.campaigns.coverage import Item
    from osc2tx_runtime.campaigns import Plan, RowResult


@dataclass(frozen=True, slots=True)
class CampaignRow:
    """The outcome of one row.

    Attributes:
        number: Number of the row.
        status: `success`, `failure`, `timeout`, `error` or `crashed`.
        reason: Why it is not `success`.
        time: Simulated seconds.
        parameters: Values of the scenario's parameters, SI units.
        measures: By name, SI units; None where there is no value.
        repeat: The command that runs it again.
    """

    number: int
    status: str
    reason: str
    time: float
    parameters: Mapping[str, Any]
    measures: Mapping[str, float | None]
    repeat: str

    def __repr__(self) -> str:
        """Return one line, for messages of assertions."""
        reason = f": {self.reason}" if self.reason else ""
        return f"<row {self.number}: {self.status} after {self.time:.2f} s{reason}; {self.repeat}>"

    def kpi(self, name: str) -> float | None:
        """Return a measure: `min_ttc`, or `min_ttc(ego,other)` for a pair.

        Raises:
            KeyError: It was not measured.
        """
        return self.measures[name]


@dataclass(frozen=True, slots=True)
class Campaign:
    """The outcome of a campaign, with queries for tests.

    Attributes:
        rows: By number.
        left_out: How many points of the sampler break a constraint.
        coverage: Coverage items by name; see `Item.grade` and `Item.holes()`.
        digest: SHA-256 of all results that do not depend on the machine.
    """

    rows: tuple[CampaignRow, ...]
    left_out: int
    coverage: Mapping[str, Item]
    digest: str

    def __repr__(self) -> str:
        """Return one line, for messages of assertions."""
        return f"<Campaign: {len(self.rows)} rows, {len(self.failed)} failed>"

    @property
    def failed(self) -> list[CampaignRow]:
        """The rows that did not succeed."""
        return [row for row in self.rows if row.status != "success"]

    @property
    def grade(self) -> float | None:
        """Mean grade of coverage in percent; None if nothing is graded."""
        from osc2tx.campaigns.coverage import overall

        return overall(self.coverage.values())

    def kpi(self, name: str) -> list[float]:
        """Return a measure of all rows that have a value of it."""
        return [value for row in self.rows if (value := row.measures.get(name)) is not None]


def run_campaign(
    path: str | Path,
    *,
    samples: int | None = None,
    sampler: str | None = None,
    scenario: str | None = None,
    search: str | None = None,
    search_batch: int = 16,
    levels: int = 5,
    engine: str = "local",
    workers: int | None = None,
    kpi: Sequence[str] | None = None,
    fail_if: Sequence[str] = (),
    store: str | Path | None = None,
    **options: Any,
) -> Campaign:
    """Run a scenario many times, as `osc2tx campaign run` does.

    Args:
        path: The file; settings of `osc2tx.toml` apply as for `osc2tx run`.
        samples: Number of rows; `grid`, `pairwise` and `table:FILE` end by themselves.
        sampler: The sampler; `random` by default without a search.
        search: The KPI whose worst value is searched.
        search_batch: Number of rows that a search selects together.
        scenario: The scenario of the file.
        levels: Values of a range for grid and pairwise.
        engine: Where rows are run: `local`, or `dask://HOST:PORT`.
        workers: Number of processes that run rows, by default one. A cluster has its own.
        kpi: Measures to take, by default all of osc2tx.
        fail_if: A further condition of failure, `min_ttc<1.5`.
        store: File of the results, and possibly earlier ones; by default nothing is stored.
        **options: Options of `osc2tx run`: `seed=7`, `max_time=40`, `set=["gap=12"]`.

    Raises:
        AssertionError: The source has errors; the message lists them.
        CampaignError: Rows cannot be chosen or run, or the store is of another campaign.
        ScenarioError: The scenario cannot have any values.
    """
    from osc2tx.campaigns.cluster import engine_by_name
    from osc2tx.campaigns.driver import run_campaign as run
    from osc2tx.campaigns.sampling import wanted_rows
    from osc2tx.campaigns.store import Store
    from osc2tx.campaigns.summary import results_of

    path = Path(path)
    plan, texts = plan_of(path, scenario, kpi, fail_if, options)
    wanted = wanted_rows(plan, sampler, samples, levels, search, search_batch)
    runs_rows = engine_by_name(engine, wanted.at_once, 1, workers)
    with own_folder(CAMPAIGN) as folder:
        place = Path(store or Path(folder, "rows.campaign"))
        with Store(place, is_new=True) as opened:
            run(plan, texts, wanted, opened, runs_rows)
            found = results_of(opened)
            rows = tuple(
                CampaignRow(
                    number=each["number"],
                    status=each["status"],
                    reason=each["reason"],
                    time=each["time"],
                    parameters=each["parameters"],
                    measures=each["measures"],
                    repeat=repeat_command(path, plan, each["seed"], each["parameters"], options),
                )
                for each in found.runs
            )
            return Campaign(rows, found.left_out, found.items, opened.digest())


def plan_of(
    path: Path,
    scenario: str | None,
    kpi: Sequence[str] | None,
    fail_if: Sequence[str],
    options: Mapping[str, Any],
) -> tuple[Plan, Mapping[str, Sequence[str]]]:
    """Compile a scenario; return the common data of its rows, and the options as written."""
    from osc2tx.building.jobs import compile_all
    from osc2tx.cli.run import merge_texts, settings_from
    from osc2tx.cli.written_modules import written_files
    from osc2tx.compilation.inputs import find_inputs
    from osc2tx.compilation.needed_modules import sibling_modules
    from osc2tx.config import ConfigFiles, GivenOptions
    from osc2tx.diagnostics.render import render_all
    from osc2tx.module_loading import module_files
    from osc2tx_runtime.campaigns import Condition, Modules, Plan
    from osc2tx_runtime.kpis import MEASURES
    from osc2tx_runtime.running.main import choose_scenario

    find_inputs([path])
    if path.suffix == ".py":
        files, module = written_files(path)
    else:
        (compilation,) = compile_all([path], GivenOptions())
        made = compilation.module
        assert made is not None, render_all(compilation.diagnostics) or f"{path} has no scenario"
        files, module = module_files(made, sibling_modules(compilation))
    loaded = Modules(files)
    try:
        name = choose_scenario(tuple(loaded.load(module).values()), scenario).name
    finally:
        loaded.close()
    given = {name.replace("_", "-"): _texts(value) for name, value in options.items()}
    texts = merge_texts(ConfigFiles().for_source(path), path, given)
    settings = settings_from(texts, path)
    measures = tuple(MEASURES) if kpi is None else tuple(kpi)
    conditions = tuple(map(Condition.parse, fail_if))
    return Plan(files, module, name, settings, measures, conditions), texts


def _texts(value: Any) -> tuple[str, ...]:
    if isinstance(value, bool):
        return ("true",) if value else ()
    if isinstance(value, list | tuple):
        return tuple(map(str, value))
    return (str(value),)


def repeat_command(
    path: Path,
    plan: Plan,
    seed: int,
    parameters: Mapping[str, Any],
    options: Mapping[str, Any],
) -> str:
    """Return the command that runs a row again."""
    values = (
        f"{name}={str(value).lower() if isinstance(value, bool) else value}"
        for name, value in parameters.items()
    )
    given = " ".join(f"--set {shlex.quote(each)}" for each in values)
    start = f"osc2tx run {shlex.quote(str(path))} --scenario {shlex.quote(plan.scenario)}"
    others = " ".join(
        f"--{name.replace('_', '-')}" + ("" if value is True else f" {shlex.quote(text)}")
        for name, value in options.items()
        if name not in ("seed", "set")
        for text in _texts(value)
    )
    return " ".join(filter(None, (start, f"--seed {seed}", others, given)))


def row_of(path: Path, plan: Plan, result: RowResult, options: Mapping[str, Any]) -> CampaignRow:
    """Return the outcome of a row, for a test."""
    return CampaignRow(
        number=result.row.number,
        status=result.status,
        reason=result.reason,
        time=result.time,
        parameters=result.values,
        measures=result.measures,
        repeat=repeat_command(path, plan, result.row.seed, result.values, options),
    )

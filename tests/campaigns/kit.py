"""Small campaigns: scenarios that take a moment, and an engine without processes."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from contextlib import closing
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from osc2tx.backends.py_trees.emitter import emit
from osc2tx.campaigns.driver import Progress, run_campaign
from osc2tx.campaigns.engine import Engine, take
from osc2tx.campaigns.sampling import Wanted
from osc2tx.campaigns.store import Store
from osc2tx_runtime import RunSettings
from osc2tx_runtime.campaigns import Executor, Plan, Row, RowResult
from tests.end_to_end.harness import asam

DRIVES = """
    ego: vehicle
    do serial:
        ego.drive(duration: 0.2s) with:
            speed(10kph)
"""

TRIANGLE = f"""import osc.standard

scenario triangle:
    a: speed with:
        keep(it in [0mps..10mps])
    b: speed with:
        keep(it in [0mps..10mps])
    keep(a < b)
    cover(a, unit: mps, range: [0..10], every: 2)
{DRIVES}"""

MIXED = f"""import osc.standard

enum light: [red, amber, green]

scenario mixed:
    v: speed with:
        keep(it in [10mps..20mps])
    n: int with:
        keep(it in [1..4])
    colour: light
    wet: bool
{DRIVES}"""


@cache
def plan_of(text: str, *measures: str) -> Plan:
    """Compile a text; its last scenario is that of the campaign."""
    with TemporaryDirectory() as folder:
        ir = asam(text, Path(folder))
    module = emit(ir)
    files = {"case.py": module.python, "case.map.json": module.source_map}
    if module.coverage_model is not None:
        files["case.coverage.json"] = module.coverage_model
    return Plan(files, "case.py", ir.scenarios[-1].name, RunSettings(), measures)


class Here:
    """Runs rows in this process, so many at a time, the last ones of these first."""

    def __init__(self, batch: int = 1) -> None:
        self._batch = batch

    def run(self, plan: Plan, rows: Iterator[Row | None]) -> Generator[list[RowResult], None, None]:
        with closing(Executor(plan)) as executor:
            while True:
                taken = take(rows, self._batch)
                if not taken:
                    return
                yield [executor.run(row) for row in reversed(taken)]


def run(
    plan: Plan, place: Path, sampler: str, samples: int | None, engine: Engine, seed: int = 0
) -> Progress:
    """Run a campaign, or go on with it."""
    return run_wanted(plan, place, Wanted(sampler, seed, samples), engine)


def run_wanted(plan: Plan, place: Path, wanted: Wanted, engine: Engine) -> Progress:
    with Store(place, is_new=True) as store:
        return run_campaign(plan, {}, wanted, store, engine)


def parameters(place: Path) -> dict[int, dict[str, object]]:
    """Return the values of the rows of a store."""
    with Store(place) as store:
        return {each["number"]: each["parameters"] for each in store.runs()}


def digest(place: Path) -> str:
    with Store(place) as store:
        return store.digest()


@cache
def calm() -> str:
    """Return the digest of forty rows that nothing happened to."""
    with TemporaryDirectory() as folder:
        place = Path(folder, "store")
        run(plan_of(TRIANGLE, "min_gap"), place, "random", 40, Here())
        return digest(place)

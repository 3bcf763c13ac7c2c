"""Rows on a cluster of Dask, two workers of which are started here: as if they were run here."""

from __future__ import annotations

import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import click
import pytest
from click.testing import CliRunner

from osc2tx.campaigns import CampaignError
from osc2tx.campaigns.cluster import DaskEngine
from osc2tx.campaigns.engine import LocalEngine
from osc2tx.cli import cli
from osc2tx.cli.reporting import Session
from osc2tx_runtime import RunSettings
from osc2tx_runtime.campaigns import Plan
from osc2tx_runtime.campaigns.remote import parcel_of, run_rows
from osc2tx_runtime.campaigns.worker import Refused
from osc2tx_shared.map_files import SHIPPED
from tests.campaigns.deaths import die_twenty_times
from tests.campaigns.kit import TRIANGLE, Here, calm, digest, plan_of, run
from tests.campaigns.test_search import search
from tests.campaigns.test_workers import lethal, rows

distributed: Any = pytest.importorskip("distributed", reason="make test-cluster installs it")
pytest_plugins = ["pytester"]
pytestmark = pytest.mark.slow


@contextmanager
def cluster(deaths: int = 3) -> Iterator[Any]:
    """Start a cluster that gives a task up after so many of its workers died."""
    import dask

    with (
        dask.config.set({"distributed.scheduler.allowed-failures": deaths}),
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50
        ) as started,
    ):
        yield started


@pytest.fixture(scope="module")
def two_workers() -> Iterator[Any]:
    with cluster() as started:
        yield started


def engine(started: Any, batch: int) -> DaskEngine:
    return DaskEngine(started.scheduler_address.removeprefix("tcp://"), batch)


def test_the_engine_does_not_show(two_workers: Any, tmp_path: Path) -> None:
    plan = replace(plan_of(TRIANGLE, "min_gap", "max_deceleration", "min_pet"), digests=True)
    run(plan, tmp_path / "local", "sobol", 40, LocalEngine(2, 3))
    run(plan, tmp_path / "by 16", "sobol", 40, engine(two_workers, 16))
    run(plan, tmp_path / "by 3", "sobol", 15, engine(two_workers, 3))
    run(plan, tmp_path / "by 3", "sobol", 40, engine(two_workers, 3))
    assert digest(tmp_path / "local") == digest(tmp_path / "by 16") == digest(tmp_path / "by 3")


def test_a_campaign_of_a_test_and_of_a_mark(two_workers: Any, pytester: pytest.Pytester) -> None:
    pytester.makefile(".osc", triangle=TRIANGLE)
    where = two_workers.scheduler_address.replace("tcp://", "dask://")
    pytester.makepyfile(f"""
        import pytest

        from osc2tx.testing import run_campaign

        here = run_campaign("triangle.osc", samples=6, sampler="halton").rows
        there = run_campaign("triangle.osc", samples=6, sampler="halton", engine="{where}").rows

        @pytest.mark.campaign("triangle.osc", samples=6, sampler="halton", engine="{where}")
        def test_it(row):
            assert here == there
            assert row in here
        """)
    pytester.runpytest_subprocess().assert_outcomes(passed=6)


def test_a_search_on_a_cluster(two_workers: Any, tmp_path: Path) -> None:
    search(tmp_path / "here", 24, Here())
    search(tmp_path / "there", 24, engine(two_workers, 1))
    assert digest(tmp_path / "here") == digest(tmp_path / "there")


def test_workers_need_the_runtime_alone(two_workers: Any, tmp_path: Path) -> None:
    run(plan_of(TRIANGLE), tmp_path / "store", "sobol", 4, engine(two_workers, 1))
    with distributed.Client(two_workers.scheduler_address, set_as_default=False) as client:
        imported = client.run(
            lambda: {each for each in sys.modules if each.partition(".")[0].startswith("osc2tx")}
        )
    assert len(imported) == 2
    assert any("osc2tx_runtime.campaigns.remote" in names for names in imported.values())
    assert not [name for names in imported.values() for name in names if name.startswith("osc2tx.")]


def test_a_map_of_the_users_travels(two_workers: Any, tmp_path: Path) -> None:
    """Workers see none of the driver's files: the map is gone before the rows are run."""
    folder = tmp_path / "maps"
    folder.mkdir()
    shutil.copy(SHIPPED / "highway.xodr", folder / "ours.xodr")
    place = folder / "ours.xodr"
    plan = replace(plan_of(TRIANGLE), settings=RunSettings(map_path=(place,)), digests=True)
    run(plan, tmp_path / "here", "sobol", 6, Here())
    parcel = parcel_of(plan)
    place.unlink()
    found = run_rows(parcel, rows(3))
    assert not isinstance(found, Refused)
    assert [each.status for each in found] == ["success"] * 3
    shutil.copy(SHIPPED / "highway.xodr", place)
    run(plan, tmp_path / "there", "sobol", 6, engine(two_workers, 2))
    assert digest(tmp_path / "here") == digest(tmp_path / "there")


def test_two_campaigns_after_each_other(two_workers: Any) -> None:
    """A worker forgets the first module, whose name the second one has too."""
    others = TRIANGLE.replace("    b: speed", "    c: speed").replace("a < b", "a < c")
    for text, names in ((TRIANGLE, {"a", "b"}), (others, {"a", "c"})):
        batches = list(engine(two_workers, 2).run(plan_of(text), iter(rows(4))))
        assert {frozenset(each.values) for found in batches for each in found} == {frozenset(names)}


def test_workers_that_are_killed_do_not_show(tmp_path: Path) -> None:
    """Twenty times, each when two more rows have come, one of two workers is killed."""
    with team() as staff:

        class Killed(DaskEngine):
            def run(self, plan, rows):  # type: ignore[no-untyped-def]
                moments, done = list(range(1, 40, 2)), 0
                for found in super().run(plan, rows):
                    done += len(found)
                    while moments and moments[0] <= done:
                        moments.pop(0)
                        staff.kill_one()
                    yield found

        address = staff.address.removeprefix("tcp://")
        run(plan_of(TRIANGLE, "min_gap"), tmp_path / "killed", "random", 40, Killed(address, 2))
        assert staff.hired == 22
    assert digest(tmp_path / "killed") == calm()


class Team:
    """Two workers in processes of their own: Dask does not start one again that dies too early."""

    def __init__(self, scheduler: Any) -> None:
        self._scheduler, self.address = scheduler, scheduler.address
        self._alive: dict[str, subprocess.Popen[bytes]] = {}
        self.hired = 0
        self.hire()
        self.hire()

    def hire(self) -> None:
        name = f"worker{self.hired}"
        alone = ["--no-nanny", "--nthreads", "1", "--no-dashboard", "--name", name]
        command = [sys.executable, "-m", "distributed.cli.dask_worker", self.address, *alone]
        self._alive[name] = subprocess.Popen(command, stderr=subprocess.DEVNULL)
        self.hired += 1

    def kill_one(self) -> None:
        """Kill one that the scheduler knows; another takes its place."""
        known: list[str] = []
        while not known:
            time.sleep(0.02)
            names = [each.name for each in list(self._scheduler.workers.values())]
            known = [name for name in names if name in self._alive]
        self._end(known[0])
        self.hire()

    def _end(self, name: str) -> None:
        process = self._alive.pop(name)
        process.kill()
        process.wait()

    def close(self) -> None:
        for name in list(self._alive):
            self._end(name)


@contextmanager
def team() -> Iterator[Team]:
    with (
        distributed.LocalCluster(
            n_workers=0, dashboard_address=":0", silence_logs=50, processes=False, protocol="tcp"
        ) as started,
        closing(Team(started.scheduler)) as found,
    ):
        yield found


def test_a_driver_that_is_killed_after_each_two_rows(two_workers: Any, tmp_path: Path) -> None:
    where = two_workers.scheduler_address.replace("tcp://", "dask://")
    die_twenty_times(tmp_path, ("--engine", where))
    assert digest(tmp_path / "store") == calm()


def test_a_row_that_kills_its_worker_costs_itself_alone(tmp_path: Path) -> None:
    plan: Plan = lethal("if self.a > 8.8: os._exit(3)")
    run(plan, tmp_path / "local", "random", 12, LocalEngine(2, 4))
    with cluster(deaths=1) as started:
        ended = run(plan, tmp_path / "there", "random", 12, engine(started, 4))
    assert (ended.done, ended.failed > 0) == (12, True)
    assert digest(tmp_path / "local") == digest(tmp_path / "there")


def test_a_module_that_cannot_be_imported_is_told(two_workers: Any) -> None:
    plan = replace(plan_of(TRIANGLE), files={"case.py": "import nothing_of_this_name\n"})
    with pytest.raises(CampaignError, match="nothing_of_this_name"):
        list(engine(two_workers, 1).run(plan, iter(rows(1))))


def test_another_version_of_the_runtime_is_told() -> None:
    found = run_rows(replace(parcel_of(plan_of(TRIANGLE)), runtime="0.0.1"), rows(1))
    assert isinstance(found, Refused)
    assert "the campaign is run with 0.0.1" in found.message


def test_a_cluster_without_workers_is_told() -> None:
    with distributed.LocalCluster(
        n_workers=0, dashboard_address=":0", silence_logs=50, processes=False, protocol="tcp"
    ) as started:
        address = started.scheduler_address.removeprefix("tcp://")
        with pytest.raises(CampaignError, match="no workers for 1 s"):
            list(DaskEngine(address, patience=1.0).run(plan_of(TRIANGLE), iter(rows(1))))


def test_a_scheduler_that_is_not_there_is_told() -> None:
    with closing(socket.socket()) as taken:
        taken.bind(("127.0.0.1", 0))
        address = f"127.0.0.1:{taken.getsockname()[1]}"
        with pytest.raises(CampaignError, match="no scheduler of Dask answers"):
            list(DaskEngine(address, patience=1.0).run(plan_of(TRIANGLE), iter(rows(1))))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--engine", "ray://here:1"], "use local or dask://HOST:PORT"),
        (["--engine", "dask://here"], "use local or dask://HOST:PORT"),
        (["--engine", "dask://here:1", "--workers", "2"], "--workers is for --engine local"),
        (["--engine", "dask://here:1", "--timeout", "2"], "--timeout is for --engine local"),
    ],
)
def test_what_the_command_refuses(options: list[str], message: str, tmp_path: Path) -> None:
    source = tmp_path / "case.osc"
    source.write_text(TRIANGLE, encoding="utf-8")
    words = ["campaign", "run", str(source), "--samples", "2", *options]
    result = CliRunner().invoke(cli, words, standalone_mode=False, obj=Session())
    assert isinstance(result.exception, click.UsageError)
    assert message in result.exception.format_message()

"""Rows on a cluster of Dask, two workers of which are started here: as if they were run here."""

from __future__ import annotations

import os
import random
import shutil
import signal
import socket
import sys
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
from osc2tx_runtime.domain.routes.map_search import SHIPPED
from tests.campaigns.kit import TRIANGLE, Here, digest, plan_of, run
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


def test_killed_workers_do_not_show(tmp_path: Path) -> None:
    generator = random.Random(8)
    plan = plan_of(TRIANGLE, "min_gap")
    run(plan, tmp_path / "calm", "random", 200, Here())
    with cluster() as started:

        class Killed(DaskEngine):
            def run(self, plan, rows):  # type: ignore[no-untyped-def]
                moments = {40, 90, 140}
                done = 0
                for found in super().run(plan, rows):
                    before, done = done, done + len(found)
                    if any(before <= moment < done for moment in moments):
                        os.kill(generator.choice(pids(started)), signal.SIGKILL)
                    yield found

        address = started.scheduler_address.removeprefix("tcp://")
        run(plan, tmp_path / "killed", "random", 200, Killed(address, 10))
    assert digest(tmp_path / "killed") == digest(tmp_path / "calm")


def pids(started: Any) -> list[int]:
    """Return the processes of the workers that run: one that only starts is not started again."""
    nannies = started.workers.values()
    return [each.pid for each in nannies if each.worker_address in started.scheduler.workers]


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
        (["--engine", "ray://here:1"], "there is local and dask://HOST:PORT"),
        (["--engine", "dask://here"], "there is local and dask://HOST:PORT"),
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

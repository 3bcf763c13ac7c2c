"""Processes that run rows: how many there are, and that some die, shows nowhere but in the row."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from osc2tx.campaigns import CampaignError
from osc2tx.campaigns.engine import LocalEngine
from osc2tx.campaigns.sampling import row_seed
from osc2tx.campaigns.store import Store
from osc2tx_runtime.campaigns import Plan, Row
from tests.campaigns.deaths import drive, driver_that_dies, numbers, words_of
from tests.campaigns.kit import TRIANGLE, Here, digest, plan_of, run
from tests.end_to_end.harness import SCENARIOS

pytestmark = pytest.mark.slow


def lethal(body: str, *measures: str) -> Plan:
    """A scenario that does something to its process when `a` is drawn."""
    plan = plan_of(TRIANGLE, *measures)
    text = f"""import os
import time

from case import Triangle


class Lethal(Triangle):
    name = "lethal"

    def behavior(self):
        {body}
        return super().behavior()
"""
    return replace(
        plan, files={**plan.files, "lethal.py": text}, module="lethal.py", scenario="lethal"
    )


def rows(number: int) -> list[Row]:
    return [Row(each, row_seed(0, each)) for each in range(number)]


def test_workers_and_batches_do_not_show(tmp_path: Path) -> None:
    plan = plan_of(TRIANGLE, "min_gap", "max_deceleration", "min_pet")
    run(plan, tmp_path / "here", "sobol", 40, Here())
    run(plan, tmp_path / "one", "sobol", 40, LocalEngine(1, 16))
    run(plan, tmp_path / "two", "sobol", 40, LocalEngine(2, 3))
    assert digest(tmp_path / "here") == digest(tmp_path / "one") == digest(tmp_path / "two")


def test_a_row_that_kills_its_process_costs_itself_alone() -> None:
    plan = lethal("if self.a > 6.0: os._exit(3)")
    fine = {n: each for n, each in enumerate(drawn(20)) if each <= 6.0}
    found = [each for batch in LocalEngine(2, 5).run(plan, iter(rows(20))) for each in batch]
    assert sorted(each.row.number for each in found) == list(range(20))
    assert {each.row.number for each in found if each.status == "success"} == set(fine)
    crashed = [each for each in found if each.status == "crashed"]
    assert crashed and all(each.attempts == 2 for each in crashed)


def drawn(number: int) -> list[float]:
    from osc2tx_runtime.campaigns import Executor

    executor = Executor(plan_of(TRIANGLE))
    try:
        return [executor.values_of(row)[0]["a"] for row in rows(number)]
    finally:
        executor.close()


def test_a_row_that_hangs_is_given_up() -> None:
    plan = lethal("if self.a > 6.0: time.sleep(1e6)")
    engine = LocalEngine(1, 4, timeout=5.0)
    found = [each for batch in engine.run(plan, iter(rows(8))) for each in batch]
    assert len(found) == 8
    late = {each.row.number for each in found if "longer than 5 s" in each.reason}
    assert late == {number for number, a in enumerate(drawn(8)) if a > 6.0} != set()


def test_a_module_that_cannot_be_imported_is_told() -> None:
    plan = replace(plan_of(TRIANGLE), files={"case.py": "import nothing_of_this_name\n"})
    with pytest.raises(CampaignError, match="nothing_of_this_name"):
        list(LocalEngine(1).run(plan, iter(rows(1))))


@pytest.mark.parametrize("moment", (1, 8, 21, 38))
def test_a_killed_worker_does_not_show(moment: int, calm: str, tmp_path: Path) -> None:
    """One of two workers is killed when so many rows have come."""

    class Killed(LocalEngine):
        def run(self, plan, rows):  # type: ignore[no-untyped-def]
            done = 0
            for found in super().run(plan, rows):
                before, done = done, done + len(found)
                if before < moment <= done:
                    os.kill(children()[moment % 2], signal.SIGKILL)
                yield found

    run(plan_of(TRIANGLE, "min_gap"), tmp_path / "killed", "random", 40, Killed(2, 4))
    assert digest(tmp_path / "killed") == calm


@pytest.fixture(scope="module")
def calm(tmp_path_factory: pytest.TempPathFactory) -> str:
    place = tmp_path_factory.mktemp("calm") / "store"
    run(plan_of(TRIANGLE, "min_gap"), place, "random", 40, Here())
    return digest(place)


def children() -> list[int]:
    """Return the workers of this process."""
    return sorted(each.pid for each in multiprocessing.active_children() if each.pid is not None)


def test_rows_whose_first_process_dies_do_not_show(calm: str, tmp_path: Path) -> None:
    """Twenty rows end their process in the middle, the first time."""
    victims = drawn(40)[1::2]
    first = f"os.path.join({str(tmp_path)!r}, str(self.a))"
    plan = lethal(
        f"if self.a in {victims} and not os.path.exists({first}): open({first}, 'x'); os._exit(3)",
        "min_gap",
    )
    run(plan, tmp_path / "killed", "random", 40, LocalEngine(2, 4))
    assert digest(tmp_path / "killed") == calm


@pytest.mark.parametrize("blow", [signal.SIGKILL, signal.SIGINT])
def test_a_driver_that_is_killed_goes_on(tmp_path: Path, blow: signal.Signals) -> None:
    """Killed after so many rows, again and again; nothing stored is lost or run again."""
    place = tmp_path / "store"
    words = words_of(SCENARIOS / "cut_in.osc", place, 60)
    stored: set[int] = set()
    for rows in (1, 7, 20):
        driver_that_dies(rows, blow, words)
        assert stored < numbers(place)
        assert len(numbers(place)) == len(stored) + rows
        stored = numbers(place)
    ended = drive(words)
    assert f"60 rows in {place}, {60 - len(stored)} new: 60 success" in ended.stdout
    assert ended.stderr == ""  # no progress beside a terminal
    whole = tmp_path / "whole"
    drive(words_of(SCENARIOS / "cut_in.osc", whole, 60))
    assert digest(place) == digest(whole)


def test_a_driver_that_is_killed_after_each_two_rows(calm: str, tmp_path: Path) -> None:
    """Twenty deaths, of a driver that has been started anew each time."""
    source, place = tmp_path / "triangle.osc", tmp_path / "store"
    source.write_text(TRIANGLE, encoding="utf-8")
    drive(["build", str(source), "-o", str(tmp_path)])  # so that it is not compiled each time
    words = words_of(source.with_suffix(".py"), place, 40)
    for death in range(1, 21):
        driver_that_dies(2, signal.SIGKILL, words)
        assert len(numbers(place)) == 2 * death
    assert ", 0 new: 40 success" in drive(words).stdout
    assert digest(place) == calm


def test_rows_of_a_scenario_of_ours_are_replayed_to_the_byte(tmp_path: Path) -> None:
    """And they are the runs of `osc2tx run` with the seed of the row."""
    place = tmp_path / "store"
    drive([*words_of(SCENARIOS / "cut_in.osc", place, 4), "--digests"])
    with Store(place) as store:
        runs = list(store.runs())
    for run_ in runs[:2]:
        number = str(run_["number"])
        traces = tmp_path / f"{number}.jsonl", tmp_path / f"{number}-again.jsonl"
        base = [sys.executable, "-m", "osc2tx"]
        again = ["campaign", "replay", str(place), number, "--trace", str(traces[0])]
        alone = ["run", str(SCENARIOS / "cut_in.osc"), "--seed", str(run_["seed"])]
        for command in (again, [*alone, "--trace", str(traces[1])]):
            subprocess.run([*base, *command], check=True, capture_output=True)
        assert traces[0].read_bytes() == traces[1].read_bytes()

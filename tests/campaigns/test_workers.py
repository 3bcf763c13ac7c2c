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
from tests.campaigns.deaths import (
    TWO,
    die_twenty_times,
    drive,
    driver_that_dies,
    numbers,
    words_of,
)
from tests.campaigns.kit import TRIANGLE, Here, calm, digest, plan_of, run
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


def test_a_row_that_stops_its_process_is_given_up() -> None:
    """Without a time-out: a stopped process tells nothing, one at a long row does."""
    plan = lethal("os.kill(os.getpid(), signal.SIGSTOP) if self.a > 8.0 else time.sleep(0.3)")
    plan = replace(
        plan, files={**plan.files, "lethal.py": "import signal\n" + plan.files["lethal.py"]}
    )
    found = [
        each for batch in LocalEngine(2, 3, stalled=6.0).run(plan, iter(rows(8))) for each in batch
    ]
    stopped = [each for each in found if each.status == "crashed"]
    assert len(found) == 8 and 0 < len(stopped) < 8
    assert {each.reason for each in stopped} == {
        "the process of this row ended or stalled, each time"
    }


def test_a_module_that_cannot_be_imported_is_told() -> None:
    plan = replace(plan_of(TRIANGLE), files={"case.py": "import nothing_of_this_name\n"})
    with pytest.raises(CampaignError, match="nothing_of_this_name"):
        list(LocalEngine(1).run(plan, iter(rows(1))))


@pytest.mark.parametrize("moment", (1, 8, 21, 38))
def test_a_killed_worker_does_not_show(moment: int, tmp_path: Path) -> None:
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
    assert digest(tmp_path / "killed") == calm()


def children() -> list[int]:
    """Return the workers of this process."""
    return sorted(each.pid for each in multiprocessing.active_children() if each.pid is not None)


def test_rows_whose_first_process_dies_do_not_show(tmp_path: Path) -> None:
    run(dying(tmp_path), tmp_path / "killed", "random", 40, LocalEngine(2, 4))
    assert digest(tmp_path / "killed") == calm()


def dying(folder: Path) -> Plan:
    """The plan of `calm`, twenty rows of which end their process in the middle, the first time.

    Args:
        folder: Where they note that they have.
    """
    victims = drawn(40)[1::2]
    first = f"os.path.join({str(folder)!r}, str(self.a))"
    ends = f"open({first}, 'x'); os._exit(3)"
    return lethal(f"if self.a in {victims} and not os.path.exists({first}): {ends}", "min_gap")


@pytest.mark.parametrize("blow", [signal.SIGKILL, signal.SIGINT])
def test_a_driver_that_is_killed_goes_on(tmp_path: Path, blow: signal.Signals) -> None:
    """Killed after so many rows, again and again; nothing stored is lost or run again."""
    place = tmp_path / "store"
    words = words_of(SCENARIOS / "cut_in.osc", place, 60, TWO)
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
    drive(words_of(SCENARIOS / "cut_in.osc", whole, 60, TWO))
    assert digest(place) == digest(whole)


def test_a_driver_that_is_killed_after_each_two_rows(tmp_path: Path) -> None:
    die_twenty_times(tmp_path, TWO)
    assert digest(tmp_path / "store") == calm()


def test_rows_of_a_scenario_of_ours_are_replayed_to_the_byte(tmp_path: Path) -> None:
    """And they are the runs of `osc2tx run` with the seed of the row."""
    place = tmp_path / "store"
    drive([*words_of(SCENARIOS / "cut_in.osc", place, 4, TWO), "--digests"])
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

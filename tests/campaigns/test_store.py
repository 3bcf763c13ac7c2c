"""What a store keeps: the same whoever ran the rows, in which order and in how many calls."""

from __future__ import annotations

import csv
import json
import sqlite3
from hashlib import sha256
from pathlib import Path

import pytest

from osc2tx.campaigns import CampaignError
from osc2tx.campaigns.export import export_rows
from osc2tx.campaigns.replay import replay_row
from osc2tx.campaigns.store import Store
from tests.campaigns.kit import MIXED, TRIANGLE, Here, digest, parameters, plan_of, run


@pytest.mark.parametrize("sampler", ["random", "sobol"])
def test_batches_and_interruptions_do_not_show(tmp_path: Path, sampler: str) -> None:
    plan = plan_of(TRIANGLE, "min_gap", "max_deceleration")
    run(plan, tmp_path / "one", sampler, 30, Here(1))
    run(plan, tmp_path / "many", sampler, 30, Here(7))
    for samples in (5, 6, 30):
        run(plan, tmp_path / "often", sampler, samples, Here(3))
    assert digest(tmp_path / "one") == digest(tmp_path / "many") == digest(tmp_path / "often")
    assert digest(tmp_path / "one") != digest_of_another_seed(tmp_path, sampler)


def digest_of_another_seed(folder: Path, sampler: str) -> str:
    run(plan_of(TRIANGLE, "min_gap"), folder / "other", sampler, 30, Here(), seed=1)
    return digest(folder / "other")


def test_an_interrupted_campaign_has_what_was_stored_and_goes_on(tmp_path: Path) -> None:
    class Interrupted(Here):
        def run(self, plan, rows):  # type: ignore[no-untyped-def]
            for number, found in enumerate(super().run(plan, rows)):
                if number == 4:
                    raise KeyboardInterrupt
                yield found

    plan = plan_of(MIXED)
    with pytest.raises(KeyboardInterrupt):
        run(plan, tmp_path / "store", "random", 10, Interrupted(2))
    assert len(parameters(tmp_path / "store")) == 8
    ended = run(plan, tmp_path / "store", "random", 10, Here(2))
    assert (ended.done, ended.new) == (10, 2)
    run(plan, tmp_path / "whole", "random", 10, Here())
    assert digest(tmp_path / "store") == digest(tmp_path / "whole")


def test_points_that_break_a_constraint_are_counted(tmp_path: Path) -> None:
    ended = run(plan_of(TRIANGLE), tmp_path / "store", "sobol", 64, Here())
    numbers = sorted(parameters(tmp_path / "store"))
    assert ended.left_out == numbers[-1] + 1 - 64
    assert 0.4 < 64 / (64 + ended.left_out) < 0.6  # half of the square


def test_another_campaign_is_refused_with_the_difference(tmp_path: Path) -> None:
    run(plan_of(MIXED), tmp_path / "store", "random", 2, Here())
    with pytest.raises(CampaignError, match=r'sampler was "random", is "sobol"'):
        run(plan_of(MIXED), tmp_path / "store", "sobol", 2, Here())
    with pytest.raises(CampaignError, match="seed was 0, is 5"):
        run(plan_of(MIXED), tmp_path / "store", "random", 2, Here(), seed=5)
    with pytest.raises(CampaignError, match="modules was"):
        run(plan_of(MIXED.replace("20mps", "21mps")), tmp_path / "store", "random", 2, Here())
    with pytest.raises(CampaignError, match=r"rows was 10, is 20"):
        run(plan_of(MIXED), tmp_path / "lhs", "lhs", 10, Here())
        run(plan_of(MIXED), tmp_path / "lhs", "lhs", 20, Here())


def test_other_files_are_refused(tmp_path: Path) -> None:
    (tmp_path / "text").write_text("no store at all, and long enough to be looked at\n" * 50)
    base = sqlite3.connect(tmp_path / "base")
    base.execute("create table t (x)")
    base.commit()
    base.close()
    for name in ("text", "base"):
        with pytest.raises(CampaignError, match="not a store of a campaign"):
            Store(tmp_path / name, is_new=True)
    with pytest.raises(CampaignError, match="the store does not exist"):
        Store(tmp_path / "nowhere")


def test_a_row_that_arrives_twice_is_stored_once(tmp_path: Path) -> None:
    class Twice(Here):
        def run(self, plan, rows):  # type: ignore[no-untyped-def]
            for found in super().run(plan, rows):
                yield found
                yield found

    run(plan_of(TRIANGLE), tmp_path / "twice", "random", 5, Twice())
    run(plan_of(TRIANGLE), tmp_path / "once", "random", 5, Here())
    assert digest(tmp_path / "twice") == digest(tmp_path / "once")


def test_coverage_items_are_kept_as_the_trace_has_them(tmp_path: Path) -> None:
    run(plan_of(TRIANGLE), tmp_path / "store", "sobol", 8, Here())
    with Store(tmp_path / "store") as store:
        samples = list(store.samples())
    assert [number for number, _, _ in samples] == sorted(parameters(tmp_path / "store"))
    for number, kind, line in samples:
        assert kind == "cover" and line["name"] == "a"
        value = parameters(tmp_path / "store")[number]["a"]
        assert line["value"] == pytest.approx(value, rel=1e-8)
        assert line["bucket"][0] <= line["value"] <= line["bucket"][1]


def test_replays_have_the_same_bytes(tmp_path: Path) -> None:
    from dataclasses import replace

    plan = replace(plan_of(TRIANGLE), digests=True)
    run(plan, tmp_path / "store", "sobol", 6, Here())
    with Store(tmp_path / "store") as store:
        for each in store.runs():
            trace = tmp_path / f"{each['number']}.jsonl"
            name, result = replay_row(store, each["number"], trace, None)
            assert (name, result.status) == ("triangle", "success")
            assert sha256(trace.read_bytes()).hexdigest() == each["digest"]
            header = json.loads(trace.read_text().splitlines()[0])
            assert header["parameters"]["a"] == pytest.approx(each["parameters"]["a"], rel=1e-8)


def test_a_replay_that_gives_another_run_is_an_error(tmp_path: Path) -> None:
    run(plan_of(TRIANGLE), tmp_path / "store", "random", 2, Here())
    with sqlite3.connect(tmp_path / "store") as base:
        base.execute("update run set steps = 3 where number = 1")
    base.close()
    with Store(tmp_path / "store") as store:
        with pytest.raises(CampaignError, match="steps 3 was stored"):
            replay_row(store, 1, None, None)
        with pytest.raises(CampaignError, match="row 7 was not run"):
            replay_row(store, 7, None, None)


def test_tables_have_all_digits(tmp_path: Path) -> None:
    run(plan_of(MIXED, "min_gap"), tmp_path / "store", "halton", 4, Here())
    with Store(tmp_path / "store") as store:
        assert export_rows(store, tmp_path / "rows.csv") == 4
        assert export_rows(store, tmp_path / "rows.jsonl") == 4
        with pytest.raises(CampaignError, match=r"name a file \.csv or \.jsonl"):
            export_rows(store, tmp_path / "rows.txt")
    known = parameters(tmp_path / "store")
    with (tmp_path / "rows.csv").open() as file:
        for row in csv.DictReader(file):
            assert float(row["parameter v"]) == known[int(row["number"])]["v"]
    for line in (tmp_path / "rows.jsonl").read_text().splitlines():
        row = json.loads(line)
        wanted = known[row["number"]]
        assert {n: row[f"parameter {n}"] for n in wanted} == wanted

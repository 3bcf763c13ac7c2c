"""Rows that are chosen by what came of others."""

from __future__ import annotations

import signal
import sys
from pathlib import Path
from statistics import mean

import click
import pytest
from click.testing import CliRunner

from osc2tx.campaigns import CampaignError
from osc2tx.campaigns.aims import Aim
from osc2tx.campaigns.engine import LocalEngine
from osc2tx.campaigns.sampling import Wanted
from osc2tx.campaigns.store import Store
from osc2tx.cli import cli
from osc2tx.cli.reporting import Session
from osc2tx_runtime.kpis import MEASURES
from tests.campaigns.deaths import TWO, drive, driver_that_dies, words_of
from tests.campaigns.kit import DRIVES, Here, digest, parameters, plan_of, run, run_wanted

FOLLOWS = """import osc.standard

enum light: [red, amber, green]

scenario follows:
    a: length with:
        keep(it in [0m..10m])
    b: length with:
        keep(it in [0m..10m])
    n: int with:
        keep(it in [0..10])
    colour: light
    keep(a + b >= 2m)
    keep(colour == red => n > 5)
    ego: vehicle
    other: vehicle
    do parallel(duration: 0.2s):
        ego.drive() with:
            speed(10kph)
        other.drive() with:
            speed(10kph)
            position(10m + a + b + n * 1m, ahead_of: ego, at: start)
"""

LEAST = Aim("min_gap", "min", 8)


def search(place: Path, samples: int, engine: object, aim: Aim = LEAST, seed: int = 0) -> None:
    wanted = Wanted("search", seed, samples, aim=aim)
    run_wanted(plan_of(FOLLOWS, "min_gap", "max_jerk"), place, wanted, engine)  # type: ignore[arg-type]


def gaps(place: Path) -> list[float]:
    with Store(place) as store:
        return [each["min_gap"] or 0.0 for each in store.measures().values()]


@pytest.mark.parametrize(("manner", "better"), [("min", min), ("max", max)])
def test_a_search_comes_nearer_than_chance(manner: str, better: object, tmp_path: Path) -> None:
    search(tmp_path / "search", 64, Here(), Aim("min_gap", manner, 8))
    run(plan_of(FOLLOWS, "min_gap"), tmp_path / "random", "random", 64, Here())
    found, chance = gaps(tmp_path / "search"), gaps(tmp_path / "random")
    best = better([*found, *chance])  # type: ignore[operator]
    assert best in found
    assert best not in chance
    means = mean(found[:16]), mean(found[-16:])
    assert means[0] != better(means)  # type: ignore[operator]


def test_points_that_break_a_constraint_are_left_out_and_avoided(tmp_path: Path) -> None:
    search(tmp_path / "store", 64, Here())
    rows = parameters(tmp_path / "store")
    assert len(rows) == 64
    assert all(row["a"] + row["b"] >= 2 for row in rows.values())  # type: ignore[operator]
    assert all(row["colour"] != "red" or row["n"] > 5 for row in rows.values())  # type: ignore[operator]
    with Store(tmp_path / "store") as store:
        assert store.left_out() == set(range(max(rows))) - set(rows)
        assert 0 < len(store.left_out()) < 64


@pytest.mark.slow
def test_who_runs_the_rows_and_when_does_not_show(tmp_path: Path) -> None:
    search(tmp_path / "whole", 40, Here())
    search(tmp_path / "by five", 40, Here(5))  # in another order
    for samples in (3, 8, 21, 40):
        search(tmp_path / "in parts", samples, Here(3))
    assert digest(tmp_path / "whole") == digest(tmp_path / "by five")
    assert digest(tmp_path / "whole") == digest(tmp_path / "in parts")


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2])
def test_workers_do_not_show(workers: int, tmp_path: Path) -> None:
    search(tmp_path / "here", 40, Here())
    search(tmp_path / "there", 40, LocalEngine(workers, 1))
    assert digest(tmp_path / "here") == digest(tmp_path / "there")


@pytest.mark.slow
def test_a_search_whose_driver_is_killed_goes_on(tmp_path: Path) -> None:
    """In the middle of a batch, some rows of which are there and some are not."""
    source = tmp_path / "follows.osc"
    source.write_text(FOLLOWS, encoding="utf-8")
    more = ["--search", "min_gap", "--search-batch", "8"]
    for rows in (5, 6, 10):
        words = words_of(source, tmp_path / "killed", 32, TWO)
        driver_that_dies(rows, signal.SIGKILL, [*words, *more])
    drive([*words, *more])
    drive([*words_of(source, tmp_path / "whole", 32, TWO), *more])
    assert digest(tmp_path / "killed") == digest(tmp_path / "whole")


def test_the_size_of_a_batch_is_part_of_the_campaign(tmp_path: Path) -> None:
    search(tmp_path / "store", 4, Here())
    with pytest.raises(CampaignError, match="sampler batch was 8, is 4"):
        search(tmp_path / "store", 8, Here(), Aim("min_gap", "min", 4))


def test_rows_without_a_value_count_as_far() -> None:
    least, greatest = Aim("min_ttc", "min"), Aim("max_jerk", "max")
    rows = {4: {"min_ttc": None}, 2: {"min_ttc": 3.0}, 7: {"min_ttc": 1.5}, 9: {}}
    assert sorted(rows, key=lambda number: least.value(rows[number])) == [7, 2, 4, 9]
    assert least.best(rows) == (7, 1.5)
    assert greatest.value({}) < greatest.value({"max_jerk": 0.0})
    assert greatest.best({1: {}}) is None


def test_each_measure_says_which_values_are_the_worst() -> None:
    found = {name: Aim.parse(name, tuple(MEASURES), 1).manner for name in MEASURES}
    small = {"min_ttc", "min_gap", "min_time_gap", "min_pet"}
    assert {name for name, manner in found.items() if manner == "min"} == small
    assert Aim.parse("min_ttc(ego,other)", ("min_ttc",), 4) == Aim("min_ttc(ego,other)", "min", 4)
    assert Aim.parse("max:min_ttc", ("min_ttc",), 4) == Aim("min_ttc", "max", 4)


def command(tmp_path: Path, *options: str, text: str = FOLLOWS) -> click.testing.Result:
    source = tmp_path / "follows.osc"
    source.write_text(text, encoding="utf-8")
    words = ["campaign", "run", str(source), "--store", str(tmp_path / "s"), "--workers", "1"]
    more = [*words, "--samples", "9", "--search-batch", "4", *options]
    return CliRunner().invoke(cli, more, standalone_mode=False, obj=Session())


@pytest.mark.slow
def test_the_command_says_the_worst_row(tmp_path: Path) -> None:
    result = command(tmp_path, "--search", "min_gap(ego,other)")
    with Store(tmp_path / "s") as store:
        rows = store.measures()
    worst = min(rows, key=lambda number: rows[number]["min_gap"])
    value = f"{rows[worst]['min_gap']:.6g}"
    assert f"min_gap(ego,other): {value} in row {worst} is the least of all" in result.output


@pytest.mark.slow
def test_a_search_that_finds_no_value_says_so(tmp_path: Path) -> None:
    """Both are as fast as each other, so they never meet."""
    result = command(tmp_path, "--search", "min_ttc")
    assert "min_ttc: no row has a value" in result.output


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--search", "min_gap", "--sampler", "sobol"], "a search selects the rows"),
        (["--search", "collision_speed"], "--search min:collision_speed, or max:collision_speed"),
        (["--search", "min_ttc", "--kpi", "min_gap"], "no --kpi"),
        (["--search", "max:min_gap(ego,nobody)", "--kpi", "min_gap"], "they have min_gap, min_gap"),
    ],
)
def test_what_the_command_refuses(options: list[str], message: str, tmp_path: Path) -> None:
    result = command(tmp_path, *options)
    assert isinstance(result.exception, click.UsageError)
    assert message in result.exception.format_message()


def test_nothing_to_draw_is_refused(tmp_path: Path) -> None:
    text = f"import osc.standard\n\nscenario plain:{DRIVES}"
    result = command(tmp_path, "--search", "min_gap", text=text)
    assert isinstance(result.exception, click.UsageError)
    assert "--search: the scenario draws no values" in result.exception.format_message()


def test_the_extra_is_named_where_it_is_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "optuna", None)
    with pytest.raises(CampaignError, match=r"pip install 'osc2tx\[search\]'"):
        search(tmp_path / "store", 4, Here())

"""Which values the rows of a campaign have."""

from __future__ import annotations

import re
from collections import Counter
from contextlib import closing
from itertools import combinations, islice, product
from pathlib import Path

import pytest

from osc2tx.campaigns import CampaignError
from osc2tx.campaigns.designs import levels_of
from osc2tx.campaigns.driver import make_sampler
from osc2tx.campaigns.planner import Planner, columns_of
from osc2tx.campaigns.sampling import Findings, Wanted, row_seed
from osc2tx_runtime import RunSettings, run_scenario
from osc2tx_runtime.campaigns import Executor, Modules, Point
from osc2tx_runtime.campaigns.points import Column
from tests.campaigns.kit import DRIVES, MIXED, TRIANGLE, Here, parameters, plan_of, run


def values(text: str, sampler: str, samples: int | None, seed: int = 0) -> dict[int, dict]:
    """Return what the rows of a sampler have, without running them."""
    with closing(Executor(plan_of(text))) as executor:
        made = make_sampler(executor, Wanted(sampler, seed, samples), Findings())
        planner = Planner(executor, made, samples, (), set())
        return {row.number: executor.values_of(row)[0] for row in planner.rows()}


@pytest.mark.slow
@pytest.mark.parametrize("sampler", ["random", "sobol", "halton"])
def test_a_row_does_not_depend_on_how_many_there_are(sampler: str) -> None:
    few, many = values(TRIANGLE, sampler, 20), values(TRIANGLE, sampler, 60)
    assert few == dict(islice(many.items(), 20))


def test_the_rows_of_a_hypercube_depend_on_how_many_there_are() -> None:
    few, many = values(MIXED, "lhs", 10), values(MIXED, "lhs", 20)
    assert few != dict(islice(many.items(), 10))


@pytest.mark.parametrize("sampler", ["random", "lhs", "sobol", "halton", "grid", "pairwise"])
def test_constraints_are_kept(sampler: str) -> None:
    found = values(TRIANGLE, sampler, 40 if sampler not in ("grid", "pairwise") else None)
    assert len(found) == (10 if sampler in ("grid", "pairwise") else 40)
    assert all(0.0 <= each["a"] < each["b"] <= 10.0 for each in found.values())


@pytest.mark.slow
@pytest.mark.parametrize("sampler", ["random", "sobol", "halton"])
def test_points_fill_the_allowed_set_evenly(sampler: str) -> None:
    """Of the triangle a < b the larger side has the distribution x^2, the smaller 1 - (1 - x)^2."""
    from scipy.stats import kstest  # takes seconds to load

    found = values(TRIANGLE, sampler, 600, seed=3).values()
    assert kstest([each["b"] / 10.0 for each in found], lambda x: x * x).pvalue > 0.01
    assert kstest([each["a"] / 10.0 for each in found], lambda x: 1 - (1 - x) ** 2).pvalue > 0.01


@pytest.mark.slow
def test_sequences_spread_better_than_chance() -> None:
    from scipy.stats import qmc  # takes seconds to load

    def unevenness(sampler: str) -> float:
        found = values(MIXED, sampler, 256).values()
        return float(qmc.discrepancy([[(each["v"] - 10.0) / 10.0] for each in found]))

    chance = unevenness("random")
    assert all(unevenness(sampler) < 0.1 * chance for sampler in ("sobol", "halton", "lhs"))


def test_a_hypercube_has_one_value_in_each_slice() -> None:
    found = values(MIXED, "lhs", 50).values()
    assert sorted(int((each["v"] - 10.0) * 5.0) for each in found) == list(range(50))


def test_a_grid_has_all_combinations() -> None:
    found = values(MIXED, "grid", None).values()
    speeds = [10.0, 12.5, 15.0, 17.5, 20.0]
    wanted = product(speeds, range(1, 5), ("red", "amber", "green"), (False, True))
    assert Counter(tuple(each.values()) for each in found) == Counter(wanted)


def test_pairs_meet_and_rows_are_few() -> None:
    found = [tuple(each.values()) for each in values(MIXED, "pairwise", None).values()]
    levels = [set(column) for column in zip(*found, strict=True)]
    assert [len(each) for each in levels] == [5, 4, 3, 2]
    for one, other in combinations(range(4), 2):
        assert {(row[one], row[other]) for row in found} == set(product(levels[one], levels[other]))
    assert 20 <= len(found) <= 30  # at least the product of the two longest, far from all 120


def test_pairs_that_can_be_do_meet_in_spite_of_constraints() -> None:
    text = MIXED.replace("    wet: bool", "    wet: bool\n    keep(n > 2 or not wet)")
    found = values(text, "pairwise", None).values()
    pairs = {(each["n"], each["wet"]) for each in found}
    assert pairs == {(n, wet) for n, wet in product(range(1, 5), (False, True)) if n > 2 or not wet}
    colours = {(each["colour"], each["wet"]) for each in found}
    assert colours == set(product(("red", "amber", "green"), (False, True)))


def test_a_table_says_the_values(tmp_path: Path) -> None:
    table = tmp_path / "rows.csv"
    table.write_text("v,n,colour,wet\n12.3,2,amber,true\n99,1,red,false\n")
    place = tmp_path / "store"
    ended = run(plan_of(MIXED), place, f"table:{table}", None, Here())
    assert (ended.done, ended.failed) == (2, 1)  # 99 m/s is outside of its range: seen, not hidden
    assert parameters(place)[0] == {"v": 12.3, "n": 2, "colour": "amber", "wet": True}


def test_values_of_a_table_have_units(tmp_path: Path) -> None:
    """45 km/h are 12.5 m/s; a number alone is in SI units."""
    table = tmp_path / "rows.csv"
    table.write_text("v,n,colour,wet\n45kph,2,amber,true\n12.5,2,amber,true\n")
    place = tmp_path / "store"
    run(plan_of(MIXED), place, f"table:{table}", None, Here())
    assert [each["v"] for each in parameters(place).values()] == [12.5, 12.5]


@pytest.mark.parametrize(
    ("sampler", "samples", "message"),
    [
        ("lhs", None, "state the number of rows"),
        ("random", None, "state the number of rows"),
        ("soboll", 5, "there is random, lhs, sobol"),
        ("table:nowhere.csv", None, "cannot be read"),
    ],
)
def test_what_samplers_refuse(sampler: str, samples: int | None, message: str) -> None:
    with pytest.raises(CampaignError, match=message):
        values(MIXED, sampler, samples)


ORDERED = f"""import osc.standard

scenario ordered:
    a: float with:
        keep(it in [0.0..1.0])
    b: float with:
        keep(it in [0.0..1.0])
    c: float with:
        keep(it in [0.0..1.0])
    keep(a < b)
    keep(b < c)
{DRIVES}"""
NARROW = ORDERED.replace("keep(a < b)", "keep(a - b < 0.0001)").replace(
    "keep(b < c)", "keep(b - a < 0.0001)"
)


@pytest.mark.parametrize("sampler", ["lhs", "sobol", "halton"])
def test_points_that_keep_a_thin_set_are_found(sampler: str) -> None:
    """One in six is in order."""
    found = values(ORDERED, sampler, 50)
    assert len(found) == 50
    assert all(each["a"] < each["b"] < each["c"] for each in found.values())
    assert 0.1 < 50 / (max(found) + 1) < 0.25


@pytest.mark.parametrize("sampler", ["lhs", "sobol", "halton"])
def test_a_set_that_is_too_thin_is_refused_with_the_reason(sampler: str) -> None:
    """One point in 5000 satisfies the constraints, and a seed finds one."""
    with pytest.raises(CampaignError, match="none of 1000 points") as error:
        values(NARROW, sampler, 5)
    assert re.search(r"case\.osc:\d+: `\w - \w < 0\.0001` does not hold \(a=", str(error.value))
    (found,) = values(NARROW, "random", 1).values()
    assert abs(found["a"] - found["b"]) < 0.0001


def test_what_keeps_constraints_only_now_and_then_is_given_up(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("osc2tx.campaigns.planner.MOST_LEFT_OUT", 20)
    said = r"[1-9] of \d+ points \(\d+\.\d{3}%\) satisfy the constraints, none of the last 20: "
    with pytest.raises(CampaignError, match=said):
        values(ORDERED, "halton", 500)


def test_nothing_to_draw_is_refused() -> None:
    with pytest.raises(CampaignError, match="draws no values"):
        values(f"import osc.standard\n\nscenario plain:{DRIVES}", "sobol", 5)


def test_parameters_of_invoked_scenarios_are_columns_by_path() -> None:
    text = f"""import osc.standard

scenario part:
    gap: length with:
        keep(it in [5m..9m])
{DRIVES}
scenario whole:
    v: speed with:
        keep(it in [1mps..2mps])
    do serial:
        first: part()
        second: part()
"""
    with closing(Executor(plan_of(text))) as executor:
        names = [column.name for column in columns_of(executor)]
        assert names == ["v", "first.gap", "second.gap"]
        found = values(text, "sobol", 16)
    assert len({each["second.gap"] for each in found.values()}) == 16
    assert all(5.0 <= each["first.gap"] <= 9.0 for each in found.values())


def test_a_bound_that_depends_on_another_value_is_followed() -> None:
    text = TRIANGLE.replace("keep(a < b)", "c: speed with:\n        keep(it in [b..20mps])")
    found = values(text, "sobol", 64).values()
    assert all(each["b"] <= each["c"] <= 20.0 for each in found)


def test_setting_the_values_of_a_row_gives_the_same_run() -> None:
    plan = plan_of(MIXED)
    modules = Modules(plan.files)
    scenario = modules.load(plan.module)["mixed"]
    with closing(Executor(plan)) as executor:
        for row in islice(
            make_sampler(executor, Wanted("halton", samples=5), Findings()).rows(), 5
        ):
            drawn, _ = executor.values_of(row)
            told = {n: str(v).lower() if isinstance(v, bool) else v for n, v in drawn.items()}
            by_values = run_scenario(scenario, RunSettings(seed=row.seed, set=told), digest=True)
            assert executor.run_whole(row, None, None)[0].digest == by_values.digest
    modules.close()


def test_ends_of_domains_belong_to_them() -> None:
    ends = (Point({"x": share}) for share in (0.0, 1.0))
    low, high = (each("x") for each in ends)
    assert (low.uniform(2.0, 3.0), high.uniform(2.0, 3.0)) == (2.0, 3.0)
    assert (low.randint(1, 4), high.randint(1, 4)) == (1, 4)
    assert (low.choice("abc"), high.choice("abc")) == ("a", "c")


def test_levels() -> None:
    assert levels_of(Column("v", "real"), 3) == [0.0, 0.5, 1.0]
    assert [int(4 * share) for share in levels_of(Column("n", "whole", 4), 5)] == [0, 1, 2, 3]
    assert len(levels_of(Column("n", "whole", 100), 5)) == 5


def test_seeds_of_campaigns_differ() -> None:
    seeds = {row_seed(seed, number) for seed in range(20) for number in range(500)}
    assert len(seeds) == 10_000

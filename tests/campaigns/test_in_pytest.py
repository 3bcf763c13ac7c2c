"""Campaigns in tests of users: as a whole, and a test for each row."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from osc2tx.campaigns import CampaignError
from osc2tx.testing import run_campaign
from tests.campaigns.kit import TRIANGLE

pytest_plugins = ["pytester"]

MARKED = """
import pytest

@pytest.mark.campaign("triangle.osc", samples=6, sampler="{sampler}", seed=3, max_time=20)
def test_a_is_small(row):
    print("NUMBER", row.number, repr(row.parameters["a"]))
    assert row.status == "success"
    assert row.parameters["a"] < {bound}
"""


@pytest.fixture
def scenario(tmp_path: Path) -> Path:
    path = tmp_path / "triangle.osc"
    path.write_text(TRIANGLE, encoding="utf-8")
    return path


@pytest.mark.slow
def test_a_campaign_as_a_whole(scenario: Path) -> None:
    campaign = run_campaign(scenario, samples=12, sampler="halton", kpi=["max_deceleration"])
    assert len(campaign.rows) == 12
    assert not campaign.failed
    assert all(row.parameters["a"] < row.parameters["b"] for row in campaign.rows)
    assert campaign.kpi("max_deceleration") == [
        row.kpi("max_deceleration") for row in campaign.rows
    ]
    (item,) = campaign.coverage.values()
    seen = {int(row.parameters["a"] // 2) for row in campaign.rows}
    assert item.grade == campaign.grade == 100 * len(seen) / 5
    again = run_campaign(
        scenario, samples=12, sampler="halton", kpi=["max_deceleration"], workers=2
    )
    assert again.digest == campaign.digest


def test_rows_that_fail(scenario: Path, tmp_path: Path) -> None:
    store = tmp_path / "kept.campaign"
    condition = "max_lateral_acceleration>=0"
    campaign = run_campaign(
        scenario, samples=2, kpi=["max_lateral_acceleration"], fail_if=[condition], store=store
    )
    assert [row.status for row in campaign.failed] == ["failure"] * 2
    with pytest.raises(CampaignError, match=r"another campaign: .*kpi"):
        run_campaign(scenario, samples=2, store=store)


@pytest.mark.slow
def test_the_command_of_a_row_runs_it_again(scenario: Path) -> None:
    (row,) = run_campaign(scenario, samples=1, seed=7, max_time=0.1).rows
    assert row.status == "timeout"
    command = row.repeat.replace("osc2tx ", f"{sys.executable} -m osc2tx ", 1)
    ended = subprocess.run(command, shell=True, capture_output=True, text=True, check=False)
    assert ended.returncode == 5
    why, _, place = row.reason.rpartition(" (")  # `run` says the place first
    assert why in ended.stdout
    assert place.removesuffix(")") in ended.stdout


@pytest.mark.slow
@pytest.mark.parametrize("sampler", ["random", "sobol"])
def test_a_test_for_each_row(pytester: pytest.Pytester, sampler: str) -> None:
    pytester.makefile(".osc", triangle=TRIANGLE)
    pytester.makepyfile(MARKED.format(sampler=sampler, bound=100))
    alone = pytester.runpytest_subprocess("-s")
    alone.assert_outcomes(passed=6)
    numbers = sorted(line[line.index("NUMBER") :] for line in alone.outlines if "NUMBER" in line)
    whole = run_campaign("triangle.osc", samples=6, sampler=sampler, seed=3)
    wanted = sorted(f"NUMBER {row.number} {row.parameters['a']!r}" for row in whole.rows)
    assert numbers == wanted


@pytest.mark.slow
def test_rows_are_spread_by_xdist(pytester: pytest.Pytester) -> None:
    pytester.makefile(".osc", triangle=TRIANGLE)
    pytester.makepyfile(MARKED.format(sampler="halton", bound=100))
    pytester.runpytest_subprocess("-n", "2").assert_outcomes(passed=6)


def test_a_row_that_fails_says_how_to_repeat_it(pytester: pytest.Pytester) -> None:
    pytester.makefile(".osc", triangle=TRIANGLE)
    pytester.makepyfile(MARKED.format(sampler="random", bound=0))
    found = pytester.runpytest("-k", "row4")
    found.assert_outcomes(failed=1, deselected=5)
    found.stdout.re_match_lines(
        [r"osc2tx run triangle\.osc --scenario triangle --seed \d+ --max-time 20 --set a=\S+ .*"]
    )


def test_what_ends_by_itself_needs_no_number(pytester: pytest.Pytester) -> None:
    """Of 3 x 3 combinations three keep `a < b`."""
    pytester.makefile(".osc", triangle=TRIANGLE)
    pytester.makepyfile("""
        import pytest

        @pytest.mark.campaign("triangle.osc", sampler="grid", levels=3)
        def test_it(row):
            assert row.parameters["a"] < row.parameters["b"]

        @pytest.mark.campaign("triangle.osc", samples=2)
        def test_without():
            pass
        """)
    found = pytester.runpytest("-k", "test_it")
    assert "let it take `row`" in found.stdout.str()


@pytest.mark.slow
def test_settings_of_a_campaign(pytester: pytest.Pytester) -> None:
    """What the command line says takes their place."""
    pytester.makefile(".osc", triangle=TRIANGLE)
    pytester.makefile(
        ".toml",
        osc2tx='[scenarios.triangle.campaign]\nsamples = 3\nsampler = "halton"\n',
    )
    command = [sys.executable, "-m", "osc2tx", "campaign", "run", "triangle.osc", "--workers", "1"]
    stated = pytester.run(*command)
    stated.stdout.fnmatch_lines(["triangle: 3 rows in triangle.campaign, 3 new: 3 success"])
    more = pytester.run(*command, "--samples", "4")
    more.stdout.fnmatch_lines(["triangle: 4 rows in triangle.campaign, 1 new: 4 success"])
    other = pytester.run(*command, "--sampler", "random")
    assert "sampler was" in other.stderr.str()


@pytest.mark.slow
@pytest.mark.parametrize("how", ['workers=2, sampler="sobol"', 'search="min_gap", search_batch=2'])
def test_rows_that_are_run_together(pytester: pytest.Pytester, how: str) -> None:
    pytester.makefile(".osc", triangle=TRIANGLE)
    pytester.makepyfile(f"""
        import os

        import pytest

        from osc2tx.testing import run_campaign

        whole = run_campaign("triangle.osc", samples=5, {how}).rows

        @pytest.mark.campaign("triangle.osc", samples=5, {how})
        def test_it(row, request):
            assert row == whole[request.node.callspec.indices["row"]]
        """)
    pytester.runpytest_subprocess().assert_outcomes(passed=5)


@pytest.mark.slow
def test_a_campaign_that_nothing_ends_is_refused(scenario: Path) -> None:
    with pytest.raises(CampaignError, match="state the number of rows"):
        run_campaign(scenario)

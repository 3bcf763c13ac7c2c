"""Generated files are up to date, and the scenarios fulfil their purpose."""

from pathlib import Path

import pytest

from osc2tx.testing import assert_build_fresh, run_scenario

PROJECT = Path(__file__).parent.parent


def test_generated_files_are_up_to_date():
    assert_build_fresh(PROJECT / "scenarios", PROJECT / "generated")


@pytest.mark.parametrize("seed", range(5))
def test_slow_down_ends_without_contact(seed):
    run = run_scenario(PROJECT / "scenarios" / "slow_down.osc", seed=seed)
    assert run.status == "success", run.reason
    assert not run.collisions
    assert run.states("ego")[-1]["v"] == pytest.approx(40 / 3.6)

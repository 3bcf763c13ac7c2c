"""What is graded exact does what the embedded world does, at steps of 10 ms."""

from pathlib import Path

import pytest

from tests.xosc.parity import Given, check, is_exact, scenarios

SCENARIOS = Path(__file__).parents[2] / "scenarios"
OWN = ["cut_in", "pedestrian_crossing", "cut_in_and_evade"]


@pytest.mark.parametrize("name", OWN)
def test_own_scenarios(name: str) -> None:
    given = Given(SCENARIOS / f"{name}.osc")
    (document,) = scenarios(given)
    assert is_exact(document), document.report.obstacles
    check(given, document)

"""Drawn values depend on the seed and on their own names; a header says them exactly."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from tests.end_to_end.harness import SCENARIOS, asam, generate, run

Load = Callable[[GeneratedModule], type[Scenario]]

TEXT = """import osc.standard

enum light: [red, amber, green]

scenario drawn:
    {more}
    v: speed with:
        keep(it in [10kph..50kph])
    colour: light
    n: int with:
        keep(it in [1..6])
    wet: bool
    gap: length with:
        keep(it in [10m..60m])
    ego, other: vehicle
    do serial:
        parallel:
            ego.drive(duration: 1s) with:
                speed(v)
            other.drive(duration: 1s) with:
                speed([10kph..20kph])
                position([10m..20m], ahead_of: ego, at: start)
"""


def parameters(load: Load, folder: Path, more: str, seed: int) -> dict[str, object]:
    folder.mkdir()
    scenario = load(emit(asam(TEXT.format(more=more), folder)))
    found: dict[str, object] = run(scenario, RunSettings(seed=seed)).lines[0]["parameters"]
    return found


def test_an_inserted_parameter_changes_no_other(load: Load, tmp_path: Path) -> None:
    more = "w: speed with:\n        keep(it in [1kph..2kph])"
    for seed in range(5):
        was = parameters(load, tmp_path / f"{seed} without", "", seed)
        is_now = parameters(load, tmp_path / f"{seed} with", more, seed)
        assert is_now.pop("w")
        assert was == is_now
    assert list(was) == [
        *("v", "colour", "n", "wet", "gap", "other.drive.speed", "other.drive.position.distance"),
    ]


def test_parameters_do_not_share_their_first_number(load: Load, tmp_path: Path) -> None:
    """Shares of the range, not values."""
    found = parameters(load, tmp_path / "case", "", 7)
    v, gap = found["v"], found["gap"]
    assert isinstance(v, float) and isinstance(gap, float)
    assert (v * 3.6 - 10) / 40 != pytest.approx((gap - 10) / 50, abs=1e-3)


@pytest.mark.parametrize("seed", range(10))
def test_the_values_of_a_header_give_the_same_trace(load: Load, tmp_path: Path, seed: int) -> None:
    for module in (emit(asam(TEXT.format(more=""), tmp_path)), generate(SCENARIOS / "cut_in.osc")):
        scenario = load(module)
        drawn = run(scenario, RunSettings(seed=seed)).text
        header = json.loads(drawn.partition("\n")[0])
        told = {
            name: str(value).lower() if isinstance(value, bool) else value
            for name, value in header["parameters"].items()
        }
        assert run(scenario, RunSettings(seed=header["seed"], set=told)).text == drawn

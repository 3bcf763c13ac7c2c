"""What is drawn from a range that the map limits is drawn from what the map has there."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

TEXT = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    n: int with:
        keep(it in [{values}])
    do serial:
        ego.drive(duration: 0.5s) with:
            lane({lane}, at: start)
            position(100m, at: start)
            speed(20mps)
        {before}
        ego.change_lane(num_of_lanes: n, side: {side})
"""


@pytest.fixture
def play(load: Load, tmp_path: Path) -> Callable[..., Trace]:
    def play(values: str, lane: int, side: str, seed: int, before: str = "") -> Trace:
        text = TEXT.format(values=values, lane=lane, side=side, before=before)
        return run(load(emit(asam(text, tmp_path))), RunSettings(seed=seed))

    return play


def drawn(trace: Trace) -> int:
    (header,) = trace.of_kind("header")
    number: int = header["parameters"]["n"]
    return number


@pytest.mark.parametrize(
    ("lane", "side", "possible"),
    [(4, "left", {1, 2, 3}), (4, "inside", {1, 2, 3}), (3, "right", {1, 2}), (2, "outside", {1})],
)
def test_lanes_beside_the_start(
    play: Callable[..., Trace], lane: int, side: str, possible: set[int]
) -> None:
    """The road has four lanes in this direction and three of oncoming traffic."""
    found = [play("1..6", lane, side, seed) for seed in range(12)]
    assert {(trace.status, trace.reason) for trace in found} == {("success", "")}
    assert {drawn(trace) for trace in found} == possible


def test_the_run_shows_what_no_draw_can_be(play: Callable[..., Trace]) -> None:
    trace = play("7..8", 1, "left", 0)
    assert (trace.status, drawn(trace) in (7, 8)) == ("failure", True)
    assert "driving lanes to the left" in trace.reason


def test_who_may_be_in_another_lane_by_then_may_draw_all(play: Callable[..., Trace]) -> None:
    before = "ego.change_lane(num_of_lanes: 1, side: left)"
    assert {drawn(play("2..3", 1, "right", seed, before)) for seed in range(12)} == {2, 3}

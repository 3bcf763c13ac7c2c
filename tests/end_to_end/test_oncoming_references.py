"""`change_lane` beside a reference in oncoming traffic: its sides are those that it sees."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from tests.end_to_end.harness import asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

TEXT = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego, met: vehicle
    far: position_3d with:
        keep(it.x == 400m)
        keep(it.y == 5.25m)
        keep(it.z == 0m)
    do parallel:
        met.drive(duration: 7s) with:
            position(at_point: far, project_on_route: false, at: start)
            speed(10mps)
        serial:
            ego.drive(duration: 0.5s) with:
                lane(2, at: start)
                position(100m, at: start)
                speed(15mps)
            {change}
"""
CHANGES = {
    "ego.change_lane(side: same, reference: met)": 5.25,
    "ego.change_lane(side: left, reference: met)": 1.75,
    "ego.change_lane(num_of_lanes: 2, side: left, reference: met)": -1.75,
    "ego.change_lane(num_of_lanes: 3, side: inside, reference: met)": -5.25,
    "ego.change_lane(side: outside, reference: met)": 8.75,
    "ego.drive(duration: 6s) with:\n                lane(same_as: met)": 5.25,
    "ego.drive(duration: 6s) with:\n                lane(1, side_of: met, side: left)": 1.75,
}


def test_the_lane_it_is_in_is_none_to_change_to(load: Load, tmp_path: Path) -> None:
    change = "ego.change_lane(num_of_lanes: 2, side: left, reference: met)"
    text = TEXT.format(change=change).replace("lane(2, at: start)", "lane(4, at: start)")
    trace = run(load(emit(asam(text, tmp_path))), RunSettings())
    assert trace.status == "failure"
    assert "already in lane -1, the target of the lane change" in trace.reason


@pytest.mark.parametrize(("change", "y"), CHANGES.items())
def test_sides_of_who_comes_the_other_way(
    load: Load, tmp_path: Path, change: str, y: float
) -> None:
    trace = run(load(emit(asam(TEXT.format(change=change), tmp_path))), RunSettings())
    assert (trace.status, trace.reason) == ("success", "")
    last = [state for state in trace.of_kind("state") if state["actor"] == "ego"][-1]
    assert last["y"] == pytest.approx(y, abs=1e-5)
    assert last["h"] == pytest.approx(0.0, abs=1e-5)

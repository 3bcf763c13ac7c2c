"""A route leaves open in which lane one drives; what is said relative to others decides (§8.9.11).

The scenario is made after the overtaking of Annex A.1 of the standard: a car that is ahead in the
lane beside lets another one come from behind, and goes into its lane.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import Scenario
from osc2tx_runtime.errors import PlacementError
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]
States = dict[str, list[dict[str, Any]]]

OVERTAKING = """import osc.standard

scenario overtaken:
    road: map with:
        keep(it.map_file == "highway.xodr")
    behind: vehicle
    test_car: vehicle
    way: route with:
        keep(it.min_lanes == 2)
    do parallel:
        test_car.drive(duration: 4s) with:
            along(route: way)
            lane(side_of: behind, side: {side}, at: start)
            lane(same_as: behind, at: end)
            lateral(distance: 50cm, measure_by: left_to_left, at: start)
            position(distance: 12m, ahead_of: behind, at: start)
            {start_speed}
            position(distance: 2m, behind: behind, at: end)
        behind.drive() with:
            along(route: way)
            {lane}
            speed(speed: 72kph)
            lateral(distance: 60cm, measure_by: right_to_right, at: start)
"""
PARTS = {"side": "right", "lane": "", "start_speed": ""}


@pytest.fixture
def play(load: Load, tmp_path: Path) -> Callable[..., States]:
    def play(**parts: str) -> States:
        text = OVERTAKING.format(**{**PARTS, **parts})
        trace: Trace = run(load(emit(asam(text, tmp_path))))
        assert (trace.status, trace.time) == ("success", 4.0), trace.reason
        found: States = {}
        for state in trace.of_kind("state"):
            found.setdefault(state["actor"], []).append(state)
        return found

    return play


@pytest.mark.parametrize("side", ["right", "left"])
def test_the_lanes_are_those_that_others_leave_room_for(
    play: Callable[..., States], side: str
) -> None:
    states = play(side=side)
    (first, *_, last), (other, *_, other_last) = states["test_car"], states["behind"]
    # Lanes -4 to -2 from the outermost on, each 3.5 m wide.
    assert first["lane"] - other["lane"] == (-1 if side == "right" else 1)
    assert first["s"] - other["s"] == pytest.approx(12.0)
    assert last["lane"] == other_last["lane"] == other["lane"]
    assert last["t"] == 4.0
    assert other_last["s"] - last["s"] == pytest.approx(2.0, abs=0.05)


def test_who_keeps_a_place_to_another_one_starts_as_fast(play: Callable[..., States]) -> None:
    assert {states[0]["v"] for states in play().values()} == {20.0}
    said = play(start_speed="speed(19mps, at: start)")
    assert said["test_car"][0]["v"] == 19.0


def test_a_lane_that_leaves_no_room_is_refused(play: Callable[..., States]) -> None:
    with pytest.raises(PlacementError, match="no lane to the right of behind"):
        play(lane="lane(1)")

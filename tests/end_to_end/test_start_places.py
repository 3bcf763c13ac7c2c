"""Start places that numbers and other actors leave: there, or a refusal; nowhere else."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.errors import PlacementError
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    a: vehicle
    b: vehicle
    c: vehicle
"""
FAR = """
    do parallel(duration: 1s):
        a.drive() with:
            lane(2, at: start)
            position({first}m, at: start)
            speed(10mps)
        b.drive() with:
            {lane}
            position({second}m, at: start)
            speed(10mps)
        c.drive() with:
            lane(4, at: start)
            position(500m, at: start)
            speed(10mps)
"""
BEHIND = """
    do parallel(duration: 1s):
        a.drive() with:
            speed(10mps)
        b.drive() with:
            lane(same_as: a, at: start)
            position([60m..100m], behind: a, at: start)
            speed(10mps)
        c.drive() with:
            lane(same_as: b, at: start)
            position({third}m, behind: b, at: start)
            speed(10mps)
"""


BEHIND_WEATHER = """
    env: environment
    do serial:
        env.overcast()
        a.assign_position(odr_point: road.create_odr_point("1", "-2", 120m, 0m))
        parallel(duration: 1s):
            a.drive()
            b.replay_path(absolute: road.create_path_odr_points(
                points: [
                    road.create_odr_point("1", "-2", 240m, 0m),
                    road.create_odr_point("1", "-2", 400m, 0m)
                ],
                interpolation: straight_line,
                on_road_network: false
            ))

scenario environment.overcast:
    do serial:
        clouds(cloudiness: 8)
        air(temperature: 4celsius)
"""


@pytest.fixture
def play(load: Load, tmp_path: Path) -> Callable[..., Trace]:
    """Run a `do` block in the scenario above."""

    def play(body: str, seed: int = 0) -> Trace:
        return run(load(emit(asam(HEAD + body, tmp_path))), RunSettings(seed=seed))

    return play


def starts(trace: Trace) -> dict[str, dict[str, float]]:
    return {s["actor"]: s for s in trace.of_kind("state") if s["t"] == 0.0}


def test_who_would_overlap_starts_nowhere_else(play: Callable[..., Trace]) -> None:
    with pytest.raises(
        PlacementError, match=r"b overlaps a by 3\.60 m 201 m from the start of road 1"
    ):
        play(FAR.format(first=200, second=201, lane="lane(2, at: start)"))


def test_another_lane_of_the_carriageway_will_do_if_none_is_said(
    play: Callable[..., Trace],
) -> None:
    found = starts(play(FAR.format(first=200, second=201, lane="keep_lane()")))
    assert found["b"]["s"] == 201.0 and found["b"]["lane"] < 0
    found = starts(play(FAR.format(first=200, second=201, lane="lane(3, at: start)")))
    assert (found["b"]["s"], found["b"]["lane"]) == (201.0, -2)


@pytest.mark.parametrize("far", [2500, 5000])
def test_beyond_the_end_of_the_road(play: Callable[..., Trace], far: int) -> None:
    with pytest.raises(PlacementError, match=f"b: .*{far} m from its start"):
        play(FAR.format(first=200, second=far, lane="lane(2, at: start)"))


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("third", [30, 300])
def test_who_is_open_makes_room(play: Callable[..., Trace], seed: int, third: int) -> None:
    """The first one starts where those behind it fit, also through others."""
    found = starts(play(BEHIND.format(third=third), seed))
    assert 60.0 <= found["a"]["s"] - found["b"]["s"] <= 100.0
    assert found["b"]["s"] - found["c"]["s"] == pytest.approx(third)
    assert len({each["lane"] for each in found.values()}) == 1
    assert found["c"]["s"] > 0.0


def test_what_follows_a_scenario_that_takes_no_time_places_actors(
    play: Callable[..., Trace],
) -> None:
    found = starts(play(BEHIND_WEATHER))
    assert (found["a"]["s"], found["b"]["s"]) == (120.0, 240.0)


@pytest.mark.slow
def test_no_room_anywhere(play: Callable[..., Trace]) -> None:
    with pytest.raises(PlacementError, match="c: the lane does not reach 3000"):
        play(BEHIND.format(third=3000))

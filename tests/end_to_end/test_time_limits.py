"""Actions that reach a goal by themselves have the time that the durations around them leave."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import Scenario
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

SCENARIO = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    lead: vehicle
    do serial:
        parallel(duration: 1s):
            ego.drive() with:
                lane(3)
                speed(20mps)
                position(200m, at: start)
            lead.drive() with:
                lane(2)
                speed(20mps)
                position(80m, ahead_of: ego, at: start)
        parallel(duration: {duration}):
            lead.drive() with:
                speed(20mps)
            {members}
"""


@pytest.fixture
def play(load: Load, tmp_path: Path) -> Callable[..., Trace]:
    """Run members beside one that goes on, after a second at 20 m/s."""

    def play(*members: str, duration: str = "4s") -> Trace:
        text = SCENARIO.format(duration=duration, members="\n            ".join(members))
        return run(load(emit(asam(text, tmp_path))))

    return play


def ended(trace: Trace, action: str) -> float:
    return next(
        float(line["t"])
        for line in trace.of_kind("action")
        if line["name"] == action and line["status"] == "end"
    )


def last(trace: Trace) -> dict[str, float]:
    return [each for each in trace.of_kind("state") if each["actor"] == "ego"][-1]


@pytest.mark.parametrize("profile", ["", ", constant", ", smooth"])
@pytest.mark.parametrize("duration", ["4s", "[3s..4s]"])
def test_a_change_of_speed_is_as_fast_as_it_has_to_be(
    play: Callable[..., Trace], profile: str, duration: str
) -> None:
    """Alone it takes 5 s or more for 10 m/s."""
    trace = play(f"ego.change_speed(30mps{profile})", duration=duration)
    assert trace.status == "success"
    assert ended(trace, "ego change_speed") == 5.0
    assert last(trace)["v"] == pytest.approx(30.0)


def test_what_has_time_takes_its_own(play: Callable[..., Trace]) -> None:
    trace = play("ego.change_speed(30mps, constant)", duration="9s")
    assert ended(trace, "ego change_speed") == 6.0  # 2 m/s^2


@pytest.mark.parametrize(("lanes", "duration"), [(1, "2s"), (2, "4s")])
def test_a_change_of_lane(play: Callable[..., Trace], lanes: int, duration: str) -> None:
    """Alone it takes 3 s for one lane, and 4.24 s for two."""
    trace = play(
        f"ego.change_lane(num_of_lanes: {lanes}, side: right)",
        "ego.keep_speed()",
        duration=duration,
    )
    assert trace.status == "success"
    assert last(trace)["lane"] == -2 - lanes
    assert last(trace)["offset"] == pytest.approx(0.0, abs=1e-6)


def test_a_change_of_a_gap(play: Callable[..., Trace]) -> None:
    trace = play(
        "ego.change_space_gap(target: 60m, direction: behind, reference: lead)", duration="8s"
    )
    assert trace.status == "success"
    end = ended(trace, "ego change_space_gap")
    at_end = {
        each["actor"]: each["s"]
        for each in trace.of_kind("state")
        if each["t"] == pytest.approx(end)
    }
    assert end <= 9.0
    assert at_end["lead"] - at_end["ego"] - 4.6 == pytest.approx(60.0, abs=0.1)


def test_several_at_once_and_the_last_of_a_serial(play: Callable[..., Trace]) -> None:
    trace = play(
        "ego.change_lane(num_of_lanes: 1, side: right)",
        "serial:",
        "    wait elapsed(1s)",
        "    ego.change_speed(28mps)",
    )
    assert trace.status == "success"
    assert ended(trace, "ego change_lane") == 4.0  # it has its 3 s
    assert ended(trace, "ego change_speed") == 5.0


def test_changes_one_after_the_other_share_their_time(play: Callable[..., Trace]) -> None:
    """Alone they take 5 s and 3 s; nothing else may fill or exceed the 4 s or 12 s."""
    for whole in (4.0, 12.0):
        trace = play(
            f"serial(duration: {whole:g}s):",
            "    ego.change_speed(30mps)",
            "    ego.change_lane(num_of_lanes: 1, side: right)",
            duration=f"{whole:g}s",
        )
        assert trace.status == "success"
        assert ended(trace, "ego change_speed") == 1.0 + 0.5 * whole
        assert ended(trace, "ego change_lane") == 1.0 + whole


def test_a_stated_rate_stays(play: Callable[..., Trace]) -> None:
    trace = play("ego.change_speed(30mps, constant, 2mpss)")
    assert trace.status == "failure"
    assert "not finished within 4 s" in trace.reason


STOP = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do serial:
        ego.drive(duration: 1s) with:
            lane(3)
            speed(20mps)
            position(200m, at: start)
        ego.drive() with:
            {end}
"""


@pytest.mark.parametrize(
    ("speed", "place"), [("0mps", "400m"), ("10mps", "500m"), ("25mps", "700m")]
)
def test_a_speed_at_a_place(load: Load, tmp_path: Path, speed: str, place: str) -> None:
    """Without a duration it takes the time that the mean of both speeds needs for the way."""
    end = f"speed({speed}, at: end)\n            position({place}, at: end)"
    trace = run(load(emit(asam(STOP.format(end=end), tmp_path))))
    assert trace.status == "success"
    target, way = float(speed[:-3]), float(place[:-1]) - 220.0
    assert last(trace)["v"] == pytest.approx(target, abs=1e-6)
    assert last(trace)["s"] == pytest.approx(220.0 + way, abs=0.05 * target + 1e-6)
    assert last(trace)["t"] == pytest.approx(1.0 + way / (0.5 * (20.0 + target)), abs=0.051)

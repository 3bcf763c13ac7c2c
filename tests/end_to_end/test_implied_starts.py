"""How actors start of which nothing states it: so that their first action can go on, or end."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    npc: vehicle
"""
EGO = """
        ego.drive() with:
            lane(3)
            speed(20mps)
            position(200m, at: start)
"""
AT_ONCE = f"""
    do parallel(duration: 5s):{EGO}
        npc.drive() with:
            lane(2)
"""
LATER = f"""
    do parallel(duration: 8s):{EGO}
        serial:
            wait elapsed(3s)
            npc.drive(duration: 5s) with:
                lane(2)
"""


@pytest.fixture
def play(load: Load, tmp_path: Path) -> Callable[[str], Trace]:
    """Run a `do` block in the scenario above."""

    def play(body: str) -> Trace:
        return run(load(emit(asam(HEAD + body, tmp_path))))

    return play


def state(trace: Trace, time: float) -> dict[str, float]:
    return next(
        each for each in trace.of_kind("state") if each["actor"] == "npc" and each["t"] == time
    )


CASES = [
    pytest.param("speed(25mps, at: end)", "position(150m, at: start)", 25.0, 25.0, id="speed"),
    pytest.param(
        "speed(3mps, faster_than: ego, at: end)",
        "position(30m, behind: ego, at: start)",
        *(23.0, 23.0),
        id="faster than another",
    ),
    pytest.param(
        "speed(25mps, at: end)",
        "position(150m, at: start)\n{acceleration}",
        *(25.0 - 5.0 * 2.0, 25.0),
        id="steady acceleration",
    ),
    pytest.param(
        "position(240m, at: end)", "position(150m, at: start)", 18.0, 18.0, id="two places"
    ),
    pytest.param("distance(90m)", "position(150m, at: start)", 18.0, 18.0, id="distance"),
]


@pytest.mark.parametrize("whole", [AT_ONCE, LATER])
@pytest.mark.parametrize(("end", "start", "first", "last"), CASES)
def test_speed_of_the_end(
    play: Callable[[str], Trace], whole: str, end: str, start: str, first: float, last: float
) -> None:
    """A limited time, and what holds when it is over, leave one steady motion."""
    indent = " " * (16 if whole is LATER else 12)
    begin = 3.0 if whole is LATER else 0.0
    acceleration = "acceleration(2mpss)"
    lines = [*start.format(acceleration=acceleration).split("\n"), end]
    trace = play(whole + "".join(f"{indent}{line}\n" for line in lines))
    assert trace.status == "success"
    assert state(trace, begin)["v"] == pytest.approx(first)
    assert state(trace, begin + 5.0)["v"] == pytest.approx(last, abs=1e-6)


@pytest.mark.parametrize("whole", [AT_ONCE, LATER])
def test_place_beside_another_at_the_end(play: Callable[[str], Trace], whole: str) -> None:
    """Who only has to end 30 m ahead of another drives there all the time."""
    indent = " " * (16 if whole is LATER else 12)
    trace = play(f"{whole}{indent}position(30m, ahead_of: ego, at: end)\n")
    assert trace.status == "success"
    begin = 3.0 if whole is LATER else 0.0
    for time in (begin, begin + 5.0):
        assert state(trace, time)["s"] == pytest.approx(200.0 + 20.0 * time + 30.0)
        assert state(trace, time)["v"] == pytest.approx(20.0)


@pytest.mark.parametrize(("word", "sign"), [("ahead_of", 1.0), ("behind", -1.0)])
def test_the_way_back_from_the_end_at_two_steady_speeds(
    play: Callable[[str], Trace], word: str, sign: float
) -> None:
    """4 m/s faster for 5 s: it starts 20 m farther back."""
    trace = play(
        f"{AT_ONCE}            speed(24mps)\n            position(16m, {word}: ego, at: end)\n"
    )
    assert trace.status == "success"
    assert state(trace, 0.0)["s"] == pytest.approx(200.0 + sign * 16.0 - 20.0)
    assert state(trace, 5.0)["s"] == pytest.approx(300.0 + sign * 16.0)


def test_the_way_back_at_the_speed_of_the_start(play: Callable[[str], Trace]) -> None:
    """What the other one does is known for longer than it takes."""
    trace = play(
        AT_ONCE.replace("parallel(duration: 5s)", "parallel")
        .replace("ego.drive()", "ego.drive(duration: 5s)")
        .replace("npc.drive()", "npc.drive(duration: 3s)")
        + "            speed(18mps, at: start)\n            position(30m, ahead_of: ego, at: end)\n"
    )
    assert trace.status == "success"
    assert state(trace, 0.0)["s"] == pytest.approx(200.0 + 30.0 + 3.0 * 2.0)
    assert state(trace, 3.0)["s"] == pytest.approx(260.0 + 30.0)


def test_a_speed_and_a_headway_at_the_end(play: Callable[[str], Trace]) -> None:
    """The example of §8.9.2: three seconds behind counts by the speed of the one behind."""
    trace = play(
        f"{AT_ONCE}            speed(24mps, at: end)\n"
        "            position(time: 3s, behind: ego, at: end)\n"
    )
    assert trace.status == "success"
    assert state(trace, 5.0)["v"] == pytest.approx(24.0)
    assert state(trace, 5.0)["s"] == pytest.approx(300.0 - 3.0 * 24.0, abs=1e-3)


def test_a_place_of_the_settings_counts(load: Load, tmp_path: Path) -> None:
    body = f"{AT_ONCE}            position(30m, ahead_of: ego, at: end)\n"
    scenario = load(emit(asam(HEAD + body, tmp_path)))
    trace = run(scenario, RunSettings(spawn={"npc": ("1", -3, 240.0)}))
    assert state(trace, 0.0)["s"] == 240.0


def test_what_is_stated_counts(play: Callable[[str], Trace]) -> None:
    trace = play(
        f"{AT_ONCE}            position(150m, at: start)\n            speed(10mps, at: start)\n"
        "            speed(25mps, at: end)\n"
    )
    assert [state(trace, time)["v"] for time in (0.0, 5.0)] == pytest.approx([10.0, 25.0])


def test_without_a_limit_it_starts_at_rest(play: Callable[[str], Trace]) -> None:
    trace = play(
        "    do npc.drive() with:\n            lane(2)\n            speed(10mps, at: end)\n"
    )
    assert state(trace, 0.0)["v"] == 0.0


INNER = """import osc.standard.all

namespace null use std, stdtypes

scenario slow_down:
    npc: vehicle
    do npc.drive(duration: 4s) with:
        lane(2)
        speed(16mps, at: end)

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    npc: vehicle
    do serial:
        npc.drive(duration: 2s) with:
            lane(2)
            speed(24mps)
        slow_down(npc: npc)
"""


def test_it_is_no_condition_where_the_actor_is_there_already(load: Load, tmp_path: Path) -> None:
    """A scenario that another one invokes in mid-run takes the speed that the actor has."""
    trace = run(load(emit(asam(INNER, tmp_path))))
    assert trace.status == "success"
    assert state(trace, 2.0)["v"] == 24.0
    assert state(trace, 6.0)["v"] == pytest.approx(16.0)


def test_the_module_says_that_nothing_states_it(tmp_path: Path) -> None:
    text = emit(
        asam(
            f"{HEAD}{AT_ONCE}            position(150m, at: start)\n            distance(90m)\n",
            tmp_path,
        )
    ).python
    assert "self.place(self.npc, lane(2), position(150 * m))" in text
    assert "self.place(self.npc, speed(90 * m / (5 * s)), implied=True)" in text

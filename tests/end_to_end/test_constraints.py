"""Constraints have an effect: values are chosen so that they hold, or the run is refused."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario, ScenarioError
from osc2tx_runtime.errors import SettingsError
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario kept:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego, npc: vehicle
"""
KPH = 1 / 3.6


@pytest.fixture
def drive(load: Load, tmp_path: Path) -> Callable[..., Trace]:
    """Run a scenario of some members, in which ego drives at `v` for a second."""

    def run_one(members: str, **settings: object) -> Trace:
        body = "".join(f"    {line}\n" for line in members.strip().splitlines())
        action = "    do ego.drive(duration: 1s) with:\n        speed(v)\n"
        scenario = load(emit(asam(HEAD + body + action, tmp_path)))
        return run(scenario, RunSettings(**settings))  # type: ignore[arg-type]

    return run_one


def speed(trace: Trace) -> float:
    return float(trace.state("ego", 0.5)["v"])


def test_one_bound_beside_a_default(drive: Callable[..., Trace]) -> None:
    members = "v: speed = 50kph\nkeep(v >= 36kph)"
    assert speed(drive(members)) == pytest.approx(50 * KPH)
    assert speed(drive(members, set={"v": 12.0})) == pytest.approx(12.0)
    with pytest.raises(SettingsError, match=r"--set v=32\.4 kph: .* at least 36 kph"):
        drive(members, set={"v": 9.0})


def test_what_is_open_must_be_given(drive: Callable[..., Trace]) -> None:
    with pytest.raises(SettingsError, match=r"leaves v open; .* at most 36 kph") as e:
        drive("v: speed\nkeep(v <= 36kph)")
    assert e.value.source == "case.osc:9"
    assert speed(drive("v: speed\nkeep(v <= 36kph)", set={"v": 7.5})) == pytest.approx(7.5)


def test_two_bounds_make_a_range(drive: Callable[..., Trace]) -> None:
    members = "v: speed\nkeep(v > 36kph)\nkeep(v < 72kph)"
    speeds = [speed(drive(members, seed=seed)) for seed in range(5)]
    assert len(set(speeds)) == 5
    assert all(10.0 < value < 20.0 for value in speeds)


def test_relations_hold_in_every_draw(drive: Callable[..., Trace]) -> None:
    members = """
v: speed with:
    keep(it in [10kph..60kph])
w: speed with:
    keep(it in [10kph..60kph])
keep(v + 5kph < w)
"""
    for seed in range(20):
        values = drive(members, seed=seed).lines[0]["parameters"]
        assert values["v"] + 5 * KPH < values["w"]
    assert drive(members, seed=3).text == drive(members, seed=3).text


def test_a_relation_that_cannot_hold_names_itself(drive: Callable[..., Trace]) -> None:
    members = "v: speed = 30kph\nw: speed = 50kph\nkeep(v < w)"
    with pytest.raises(ScenarioError, match=r"`v < w` does not hold \(v=72 kph, w=50 kph\)") as e:
        drive(members, set={"v": 20.0})
    assert e.value.source == "case.osc:11"


def test_an_equation_is_solved(drive: Callable[..., Trace]) -> None:
    members = """
w: speed with:
    keep(it in [10kph..30kph])
v: speed
keep(2 * w == 80kph - v)
"""
    trace = drive(members, seed=1)
    w = trace.lines[0]["parameters"]["w"]
    assert speed(trace) == pytest.approx(80 * KPH - 2 * w)


def test_whole_numbers_are_drawn_whole(drive: Callable[..., Trace]) -> None:
    members = """
n: int with:
    keep(it in [1..3])
v: speed = n * 10kph
"""
    drawn = {drive(members, seed=seed).lines[0]["parameters"]["n"] for seed in range(30)}
    assert drawn == {1, 2, 3}
    assert speed(drive(members, set={"n": 2})) == pytest.approx(20 * KPH)


def test_values_of_a_set(drive: Callable[..., Trace]) -> None:
    members = "v: speed with:\n    keep(it in [10kph, 20kph])"
    drawn = {round(speed(drive(members, seed=seed)) * 3.6, 3) for seed in range(10)}
    assert drawn == {10.0, 20.0}
    refused = r"--set v=18 kph: the scenario allows \{10 kph, 20 kph\}"
    with pytest.raises(SettingsError, match=refused):
        drive(members, set={"v": 5.0})


def test_implication(drive: Callable[..., Trace]) -> None:
    members = """
is_slow: bool
v: speed with:
    keep(it in [10kph..60kph])
keep(is_slow => v <= 20kph)
"""
    found = set()
    for seed in range(20):
        values = drive(members, seed=seed).lines[0]["parameters"]
        found.add(values["is_slow"])
        assert not values["is_slow"] or values["v"] <= 20 * KPH
    assert found == {False, True}


CASES = """
night: bool = false
v: speed
keep(night => v == 36kph)
keep(not night => v == 54kph)
"""


def test_cases_that_leave_nothing_open(drive: Callable[..., Trace]) -> None:
    assert speed(drive(CASES)) == pytest.approx(54 * KPH)
    assert speed(drive(CASES, set={"night": True})) == pytest.approx(36 * KPH)


def test_cases_beside_another_constraint(drive: Callable[..., Trace]) -> None:
    """What contradicts a case takes its selector from the draw."""
    members = """
side: side_left_right
v: speed
keep(side == left => v == 36kph)
keep(side != left => v == 54kph)
keep(v < 40kph)
"""
    for seed in range(8):
        assert speed(drive(members, seed=seed)) == pytest.approx(36 * KPH)


def test_cases_that_leave_something_open(drive: Callable[..., Trace]) -> None:
    members = "night: bool = false\nv: speed\nkeep(night => v == 36kph)"
    with pytest.raises(SettingsError, match="leaves v open"):
        drive(members)
    two_for_one = members + "\nkeep(night => v == 36kph)\nkeep(not night => v == 54kph)"
    with pytest.raises(SettingsError, match="leaves v open"):
        drive(two_for_one)


def test_values_listed_by_or(drive: Callable[..., Trace]) -> None:
    members = "v: speed\nkeep(v == 36kph or v == 54kph or 72kph == v)"
    found = {round(speed(drive(members, seed=seed)) / KPH) for seed in range(20)}
    assert found == {36, 54, 72}
    bounded = {
        round(speed(drive(members + "\nkeep(v < 60kph)", seed=seed)) / KPH) for seed in range(20)
    }
    assert bounded == {36, 54}


def test_members_of_actors(drive: Callable[..., Trace]) -> None:
    members = """
v: speed = 30kph
keep(ego.vehicle_category == bus)
keep(npc.bounding_box.length in [6m..7m])
"""
    actors = drive(members).lines[0]["actors"]
    assert actors["ego"]["length"] == pytest.approx(10.5, abs=3)
    assert 6.0 <= actors["npc"]["length"] <= 7.0
    settings = {"npc.bounding_box.length": 6.5}
    assert drive(members, set=settings).lines[0]["actors"]["npc"]["length"] == 6.5


def test_globals_keep_their_constraints(load: Load, tmp_path: Path) -> None:
    text = HEAD.replace("scenario", "global top: speed = 50kph\nglobal v: speed\n\nscenario", 1)
    text += "    keep(v <= top)\n    do ego.drive(duration: 1s) with:\n        speed(v)\n"
    scenario = load(emit(asam(text, tmp_path)))
    assert speed(run(scenario, RunSettings(set={"v": 10.0}))) == pytest.approx(10.0)
    with pytest.raises(ScenarioError, match=r"`v <= top` does not hold"):
        run(scenario, RunSettings(set={"v": 15.0}))


def test_constraints_of_an_invocation(load: Load, tmp_path: Path) -> None:
    text = HEAD + """    least: time = 2s
    do serial:
        ego.drive() with:
            speed(30kph)
            keep(it.duration >= least)
        ego.change_speed() with:
            keep(it.target in [40kph..50kph])
            keep(it.rate_profile == constant)
        ego.drive(duration: [1s..2s])
"""
    scenario = load(emit(asam(text, tmp_path)))
    trace = run(scenario, RunSettings(set={"ego.change_speed.target": 13.0}))
    assert trace.action("case.osc:11", "end") == 2.0
    assert trace.states("ego")[-1]["v"] == pytest.approx(13.0)
    speeds = {run(scenario, RunSettings(seed=s)).states("ego")[-1]["v"] for s in range(4)}
    assert len(speeds) == 4 and all(40 * KPH <= v <= 50 * KPH for v in speeds)


def test_an_invoked_scenario_gets_what_its_invoker_keeps(load: Load, tmp_path: Path) -> None:
    text = """import osc.standard.all

namespace null use std, stdtypes

scenario vehicle.cruise:
    v: speed
    keep(v <= 50kph)
    do drive(duration: 1s) with:
        speed(v)

scenario kept:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do first: ego.cruise() with:
        keep(it.v in [40kph..60kph])
"""
    scenario = load(emit(asam(text, tmp_path)))
    speeds = [run(scenario, RunSettings(seed=s)).state("ego", 0.5)["v"] for s in range(6)]
    assert len(set(speeds)) == 6
    assert all(40 * KPH <= v <= 50 * KPH + 1e-6 for v in speeds)


def test_an_element_that_is_not_there(drive: Callable[..., Trace]) -> None:
    members = "v: speed = 36kph\nlanes: list of int\nkeep(lanes[1] > 2)\nkeep(lanes[0] == 31)"
    with pytest.raises(ScenarioError, match=r"lanes\[1\]. cannot be computed: .* index"):
        drive(members)

"""Lists and ranges as values: computed, checked, handed to other scenarios."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario, ScenarioError
from osc2tx_runtime.errors import SettingsError
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes
"""
MEMBERS = """
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego, npc: vehicle
"""


def v_of(trace: Trace) -> float:
    return float(trace.states("ego")[-1]["v"])


@pytest.mark.parametrize(
    ("value", "kph"),
    [
        ("speeds[2]", 30),
        ("speeds.filter(it > 15kph)[0]", 20),
        ("speeds.map(it * 2.0)[0]", 20),
        ("speeds.size() * 5kph", 15),
        ("speeds.count(it < 25kph) * 10kph", 20),
        ("speeds.first_index(it == 30kph) * 10kph", 20),
        ("speeds.has(it > 50kph) ? 50kph : 5kph", 5),
        ("(20kph in speeds) ? 12kph : 5kph", 12),
        ("[[1kph, 2kph], 3kph][1]", 2),
        ("[1kph, speeds][2]", 20),
    ],
)
def test_operators(load: Load, tmp_path: Path, value: str, kph: float) -> None:
    text = f"""{HEAD}
scenario lists:{MEMBERS}
    speeds: list of speed = [10kph, 20kph, 30kph]
    v: speed = {value}
    do ego.drive(duration: 1s) with:
        speed(v)
"""
    assert v_of(run(load(emit(asam(text, tmp_path))))) == pytest.approx(kph / 3.6)


def test_lists_of_actors(load: Load, tmp_path: Path) -> None:
    text = f"""{HEAD}
scenario lists:{MEMBERS}
    fleet: list of vehicle = [ego, npc]
    do parallel:
        fleet[1].drive() with:
            speed(40kph)
        fleet[0].change_speed(target: 36kph)
        wait fleet.count(it.speed > 35kph) == 2
"""
    trace = run(load(emit(asam(text, tmp_path))))
    assert trace.status == "success"
    assert 35 / 3.6 < trace.states("npc")[-1]["v"] <= 40 / 3.6
    assert v_of(trace) == pytest.approx(10.0)
    starts = [line for line in trace.of_kind("action") if line["status"] == "start"]
    assert {(line["actor"], line["source"]) for line in starts} == {
        ("npc", "case.osc:12"),
        ("ego", "case.osc:14"),
    }


def test_an_index_out_of_range_is_an_error_of_the_scenario(load: Load, tmp_path: Path) -> None:
    text = f"""{HEAD}
scenario lists:{MEMBERS}
    speeds: list of speed = [10kph]
    n: uint = 1
    do serial:
        wait speeds[n] > 5kph
"""
    with pytest.raises(ScenarioError, match="no value: a list of 1 has no member with the index 1"):
        run(load(emit(asam(text, tmp_path))))


def test_constraints_of_a_list_are_checked(load: Load, tmp_path: Path) -> None:
    text = f"""{HEAD}
scenario lists:{MEMBERS}
    n: int = 1
    speeds: list of speed = [10kph, 20kph]
    keep(speeds[n] > 15kph and speeds.size() == 2)
    do ego.drive(duration: 1s) with:
        speed(speeds[n])
"""
    scenario = load(emit(asam(text, tmp_path)))
    assert v_of(run(scenario)) == pytest.approx(20 / 3.6)
    with pytest.raises(ScenarioError, match=r"`member_at\(speeds, n\) > 15 \* kph .*` does not"):
        run(scenario, RunSettings(set={"n": 0}))


def test_lists_and_ranges_for_an_invoked_scenario(load: Load, tmp_path: Path) -> None:
    text = f"""{HEAD}
scenario vehicle.step:
    speeds: list of speed = [10kph]
    allowed: range of speed = [5kph..15kph]
    v: speed = speeds[0] in allowed ? speeds[0] : allowed.upper()
    do change_speed(target: v)

scenario lists:{MEMBERS}
    do serial:
        one: ego.step(speeds: [30kph, 20kph], allowed: [20kph..40kph])
        two: ego.step(speeds: [50kph])
        three: ego.step()
"""
    path = tmp_path / "case.osc"
    path.write_text(text, encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions("2.2"))
    assert compilation.ir is not None, compilation.diagnostics
    trace = run(load(emit(compilation.ir)))
    ends = [line["t"] for line in trace.of_kind("action") if line["status"] == "end"]
    speeds = [trace.state("ego", t)["v"] * 3.6 for t in ends]
    assert speeds == pytest.approx([30.0, 15.0, 10.0], abs=0.01)


def test_the_caller_gives_what_has_no_value_of_its_own(load: Load, tmp_path: Path) -> None:
    text = f"""{HEAD}
struct manner:
    factor: float = 1.0

scenario vehicle.step:
    speeds: list of speed
    goal: position_3d
    way: manner
    do change_speed(target: (speeds[1] + goal.x / 1s) * way.factor)

scenario lists:{MEMBERS}
    there: position_3d with:
        keep(it.x == 1m)
        keep(it.y == 0m)
        keep(it.z == 0m)
    slow: manner with:
        keep(it.factor == 0.5)
    do serial:
        ego.step(speeds: [30kph, 20kph], goal: there, way: slow)
        %s
"""
    scenario = load(emit(asam(text.replace("        %s\n", ""), tmp_path)))
    assert run(scenario).states("ego")[-1]["v"] == pytest.approx(0.5 * (20 / 3.6 + 1))
    with pytest.raises(SettingsError, match=r"`step.*speeds` has no value.*the invocation"):
        run(load(emit(asam(text.replace("%s", "ego.step()"), tmp_path))))

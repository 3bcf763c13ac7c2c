"""Arguments of scenarios that depend on the state of the world when they start (§7.3.6.1.2)."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import Scenario
from osc2tx_runtime.errors import ScenarioError
from tests.end_to_end.harness import asam, run
from tests.unit.cli.shell import Shell

Load = Callable[[GeneratedModule], type[Scenario]]

FOLLOW = """import osc.standard.all

namespace null use std, stdtypes

scenario vehicle.follow_vehicle:
    other: vehicle
    distance: length
    do actor.change_space_gap(target: distance, direction: behind, reference: other)

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    car1, car2: vehicle
    var gap: length = sample(ego.object_distance(car1, longitudinal), every(2s), 5m)
    do serial:
        parallel(duration: 5s):
            car1.drive() with:
                lane(3)
                speed(15mps)
                position(200m, at: start)
            ego.drive() with:
                lane(3)
                speed(14mps)
                position(30m, behind: car1, at: start)
            car2.drive() with:
                lane(3)
                speed(14mps)
                position(60m, behind: ego, at: start)
        parallel:
            ego.drive(duration: 20s) with:
                speed(14mps)
            car2.follow_vehicle(other: ego, distance: gap)
"""

FASTER = """import osc.standard.all

namespace null use std, stdtypes

scenario vehicle.reach:
    goal: speed
    event there
    keep(goal < 30mps)
    do serial:
        actor.drive(duration: 4s) with:
            speed(goal, at: end)
        emit there

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    var reached: speed = sample(g.goal, @g.end, 0mps)
    record(reached, unit: mps)
    do serial:
        ego.drive(duration: 2s) with:
            lane(3)
            speed(10mps)
            position(100m, at: start)
        g: ego.reach(goal: ego.speed + {more}mps)
        ego.reach(goal: ego.speed + 5mps)
"""


def test_a_variable_is_read_when_the_scenario_starts(load: Load, tmp_path: Path) -> None:
    """The example of the standard: the gap is the distance sampled at 4 s, which is 34 m."""
    trace = run(load(emit(asam(FOLLOW, tmp_path))))
    assert trace.status == "success"
    end = next(
        line["t"]
        for line in trace.of_kind("action")
        if line["name"] == "car2 change_space_gap" and line["status"] == "end"
    )
    at = {each["actor"]: each["x"] for each in trace.of_kind("state") if each["t"] == end}
    assert at["ego"] - at["car2"] - 4.6 == pytest.approx(34.0, abs=0.1)


def test_each_invocation_reads_its_own(load: Load, tmp_path: Path) -> None:
    trace = run(load(emit(asam(FASTER.format(more=5), tmp_path))))
    assert trace.status == "success"
    speeds = {each["t"]: each["v"] for each in trace.of_kind("state")}
    assert [speeds[t] for t in (2.0, 6.0, 10.0)] == pytest.approx([10.0, 15.0, 20.0])
    assert [line["value"] for line in trace.of_kind("variable")] == [15.0]


def test_constraints_of_the_scenario_hold_for_it(load: Load, tmp_path: Path) -> None:
    with pytest.raises(ScenarioError, match=r"g\.goal=35 mps: .* at most 30 mps"):
        run(load(emit(asam(FASTER.format(more=25), tmp_path))))


def test_events_inside_are_refused_at_their_line(shell: Shell) -> None:
    text = FASTER.format(more=5) + "        wait @g.there\n"
    shell.write("top.osc", text)
    ended = shell("check", "top.osc")
    assert ended.code == 3
    line = len(text.splitlines())
    assert f"top.osc:{line}:15: error[OSC503]: the events of `g` are there only once" in ended.err


def test_xml_names_the_value_that_is_not_known(shell: Shell) -> None:
    shell.write("top.osc", FOLLOW)
    ended = shell("build", "top.osc", "-o", "made", "--target", "xosc")
    assert "the value of `gap` is only known during the run" in ended.err

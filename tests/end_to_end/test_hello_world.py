"""The case study, unchanged, on CARLA's Town06: every phase, in the order of the paper."""

import hashlib
import math
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.config import ConfigFiles
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.report.trace_reader import read_run
from osc2tx_runtime.running.options import read_options
from tests.end_to_end.harness import (
    SCENARIOS,
    Trace,
    compile_scenario,
    generate,
    permuted_module,
    run,
)
from tests.runtime.world.motion_scan import impossible, scan_lines

FILE = SCENARIOS / "hello_world.osc"
PUBLISHED = "c3c43042e05e3dfef49f85a3b76454ce82f0195fd921f25104c6f9e3d54df318"
Load = Callable[[GeneratedModule], type[Scenario]]


@pytest.fixture(scope="module")
def settings(test_data: Path) -> RunSettings:
    """The settings of scenarios/osc2tx.toml, and the folder of the town."""
    texts = ConfigFiles().for_source(FILE).run_settings(FILE)
    stated = read_options(texts)
    return replace(stated, map_path=(test_data / "maps" / "carla-2020",))


@pytest.fixture(scope="module")
def trace(load: Load, settings: RunSettings) -> Trace:
    return run(load(generate(FILE)), settings)


def line(number: int) -> str:
    return f"hello_world.osc:{number}"


def gap(trace: Trace, t: float) -> float:
    """Distance of the reference points; on the straight this is the distance along the route."""
    hero, npc = trace.state("hero", t), trace.state("npc", t)
    return float(((hero["x"] - npc["x"]) ** 2 + (hero["y"] - npc["y"]) ** 2) ** 0.5)


def test_the_file_is_the_published_one() -> None:
    """The case study runs as its authors published it."""
    assert hashlib.sha256(FILE.read_bytes()).hexdigest() == PUBLISHED


def test_what_cannot_be_driven_is_named(trace: Trace) -> None:
    """The speeds are the scenario's; who would skid or tip over at them is in the warnings."""
    assert impossible(trace.lines) == {"across"}
    beyond = {who for who, worst in scan_lines(trace.lines).items() if worst.across > 9.0}
    named = {each.partition(":")[0] for each in trace.warnings if " exceeds the " in each}
    assert named >= beyond


def test_phases_in_the_order_of_the_paper(trace: Trace) -> None:
    assert trace.status == "success"
    moments = [
        trace.event("go_signal"),
        trace.action(line(105), "end"),  # the truck is ahead by two lags
        trace.action(line(111), "end"),  # and has cut in
        trace.action(line(60), "end"),  # the fall trigger of the hero
        trace.action(line(75), "end"),  # lights back to auto
        trace.event("CRASH_AVOIDED"),
        trace.action(line(127), "start"),  # the truck brakes
        trace.event("OBSTACLE_DETECTED"),
        trace.action(line(85), "end"),  # the hero is at 25 kph
        trace.action(line(87), "end"),  # alongside
        trace.action(line(93), "end"),  # stopped
    ]
    assert moments == sorted(moments)
    assert moments[0] == pytest.approx(1.0)


def test_the_truck_starts_behind_in_the_right_lane(trace: Trace) -> None:
    hero, npc = trace.state("hero", 0.0), trace.state("npc", 0.0)
    assert hero["v"] == npc["v"] == 0.0
    assert npc["lane"] == hero["lane"] - 1  # OpenDRIVE counts to the right with falling ids
    assert hero["s"] - npc["s"] == pytest.approx(5.0, abs=0.01)


def test_the_truck_passes_and_cuts_in_left(trace: Trace) -> None:
    start, end = trace.action(line(111), "start"), trace.action(line(111), "end")
    assert gap(trace, start) == pytest.approx((10.0**2 + 3.5**2) ** 0.5, abs=0.5)
    before, after = trace.state("npc", start), trace.state("npc", end)
    assert after["lane"] == before["lane"] + 1 == trace.state("hero", end)["lane"]
    assert before["v"] == pytest.approx(35 / 3.6 + 12.42 * 0.44704)


def test_the_hero_evades_when_the_gap_falls_to_the_safety_gap(trace: Trace) -> None:
    t = trace.action(line(60), "end")
    step = 0.05 * (trace.state("hero", t)["v"] - trace.state("npc", t)["v"])
    assert 12.0 - 2 * step <= gap(trace, t) <= 12.0
    assert trace.action(line(68), "start") == trace.action(line(73), "start") == t
    evaded = trace.action(line(68), "end")
    assert trace.state("hero", evaded)["lane"] == trace.state("hero", t)["lane"] - 1
    assert trace.event("CRASH_AVOIDED") == evaded


def test_high_beams_for_half_a_second(trace: Trace) -> None:
    lights = [(entry["t"], entry["mode"]) for entry in trace.of_kind("lights")]
    flash = trace.action(line(73), "start")
    assert lights == [(0.0, "auto"), (flash, "high_beam"), (pytest.approx(flash + 0.5), "auto")]


def test_the_truck_brakes_within_45_m_of_the_obstacle_and_reports(trace: Trace) -> None:
    t = trace.action(line(127), "start")
    npc, obstacle = trace.state("npc", t), trace.state("obstacle", t)
    away = ((npc["x"] - obstacle["x"]) ** 2 + (npc["y"] - obstacle["y"]) ** 2) ** 0.5
    assert 45.0 - npc["v"] * 0.05 <= away < 45.0
    stopped = trace.action(line(127), "end")
    assert trace.state("npc", stopped)["v"] == 0.0
    assert trace.event("OBSTACLE_DETECTED") == stopped


def test_both_stand_before_the_obstacle_in_neighbouring_lanes(trace: Trace) -> None:
    hero, npc = trace.states("hero")[-1], trace.states("npc")[-1]
    obstacle = trace.states("obstacle")[-1]
    assert hero["v"] == npc["v"] == 0.0
    assert (hero["road"], npc["road"]) == ("48", "48")
    assert (hero["lane"], npc["lane"]) == (-5, -4)
    assert npc["s"] < obstacle["s"] and hero["s"] < obstacle["s"]
    assert trace.of_kind("collision") == []


def test_five_seconds_for_the_hero_and_a_hundred_for_the_truck(trace: Trace) -> None:
    last = trace.states("hero")[-1]["t"]
    assert last == pytest.approx(trace.event("OBSTACLE_DETECTED") + 100.0)
    assert last > trace.action(line(93), "end") + 5.0


def test_two_runs_and_permuted_branches_give_the_same_bytes(
    trace: Trace, load: Load, settings: RunSettings
) -> None:
    module = compile_scenario(FILE)
    assert run(load(emit(module)), settings).text == trace.text
    assert run(load(permuted_module(module)), settings).ordered == trace.ordered
    assert read_run(trace.text.splitlines()).skipped == 0  # the report knows every line


@pytest.mark.parametrize("start", [10.0, 25.0, 40.0])
def test_the_story_holds_from_other_starts(load: Load, settings: RunSettings, start: float) -> None:
    trace = run(
        load(generate(FILE)),
        replace(settings, spawn={"hero": ("16", -3, start)}),
    )
    assert trace.status == "success"
    assert trace.of_kind("collision") == []
    hero, npc = trace.states("hero")[-1], trace.states("npc")[-1]
    assert (hero["lane"], npc["lane"]) == (-5, -4)  # the truck may stop one road earlier
    swerve = trace.action(line(68), "start")
    assert 11.5 < gap(trace, swerve) <= 12.0


def test_the_default_placement_has_the_truck_too_fast_in_a_turn(
    load: Load, settings: RunSettings
) -> None:
    """It says so with place, speed and lateral acceleration, as the states have them."""
    default = replace(settings, spawn={}, destination={}, max_time=30.0)
    trace = run(load(generate(FILE)), default)
    warning = next(each for each in trace.warnings if each.startswith("npc"))
    said = re.fullmatch(
        r"npc: lateral acceleration (\S+) m/s\^2 exceeds the rollover limit of 3\.9 m/s\^2,"
        r" at (\S+) m/s and a radius of \S+ m"
        r" \(road (\d+), lane -4, s (\S+) m; from .*\)",
        warning,
    )
    assert said is not None, warning
    across, speed, place = float(said[1]), float(said[2]), float(said[4])
    assert (said[3], round(speed)) == ("46", 15)
    there = [e for e in trace.states("npc") if e["road"] == said[3]]
    at = min(range(len(there)), key=lambda k: abs(there[k]["s"] - place))
    turned = math.remainder(there[at]["h"] - there[at - 1]["h"], math.tau) / 0.05
    assert there[at]["v"] == pytest.approx(speed, abs=0.05)
    assert abs(turned) * there[at]["v"] == pytest.approx(across, rel=0.02)

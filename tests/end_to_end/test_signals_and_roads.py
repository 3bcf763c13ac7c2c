"""Traffic lights and road conditions: what the scenarios claim shows in the trace."""

import json
import math
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario, ScenarioError
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]
G = 9.80665  # m/s^2

LIGHTS = """
import osc.standard.all

namespace null use std, stdtypes

scenario lights:
    road: map with:
        keep(it.map_file == "urban_crossing.xodr")
    light: traffic_light with:
        keep(it.map_id == "101")
    main_street: traffic_light_group with:
        keep(it.map_id == "1")
    side_street: traffic_light_group with:
        keep(it.map_id == "2")
    lights: traffic_light_controller
    ego: vehicle

    do parallel:
        ego.drive() with:
            lane(2, at: start)
            position(20m, at: start)
            speed(50kph)
            avoid_collisions(true)
        serial:
            lights.set_group_semantic_state(main_street, state: stop)
            lights.set_group_semantic_state(side_street, state: go)
            wait elapsed(15s)
            lights.set_group_semantic_state(side_street, state: stop)
            lights.set_bulb_state(light, bulb_color: yellow, bulb_kind: circle, bulb_state: is_on)
            wait elapsed(1s)
            lights.set_group_semantic_state(main_street, state: go)
            wait light.state_to_semantic_state(light.bulbs) == go
            wait elapsed(8s)
"""

ROADS = """
import osc.standard.all

namespace null use std, stdtypes

scenario roads:
    road: map with:
        keep(it.map_file == "highway.xodr")
    env: environment
    ego: vehicle

    do serial:
        env.snow(intensity: 2mmph)
        ego.drive(duration: 2s) with:
            lane(2, at: start)
            position(50m, at: start)
            speed(72kph)
        ego.change_speed(target: 0kph, rate_profile: asap)
        env.snow(intensity: 0mmph)
        ego.change_speed(target: 36kph, rate_profile: asap)
        env.rain(intensity: 10mmph)
        wait elapsed(1s)
        one_of:
            ego.change_speed(target: 0kph, rate_profile: constant, rate_peak: 7mpss)
            wait elapsed(1s)
"""


@pytest.fixture
def trace_of(load: Load, tmp_path: Path) -> Callable[[str], Trace]:
    return lambda text: run(load(emit(asam(text, tmp_path))))


def test_car_stops_before_the_line_and_goes_at_green(trace_of: Callable[[str], Trace]) -> None:
    """The light stands at s = 149 m; front 1 m before it; half of 8 m/s^2 is comfortable."""
    trace = trace_of(LIGHTS)
    front = 4.6 - 0.92
    at_rest = [state for state in trace.states("ego") if state["v"] == 0.0]
    assert {(s["road"], s["lane"]) for s in at_rest} == {("1", -1)}
    assert at_rest[0]["s"] == pytest.approx(149.0 - 1.0 - front, abs=0.005)
    # Nothing happens before v^2 / (2 b) = 24.1 m; then the deceleration is constant and at most b.
    speed, comfort = 50 / 3.6, 4.0
    braking = [s for s in trace.states("ego") if s["t"] < at_rest[0]["t"] and s["a"] < 0.0]
    begin = at_rest[0]["s"] - (braking[0]["s"] - speed * 0.05)
    assert begin == pytest.approx(speed**2 / (2 * comfort), abs=speed * 0.05)
    rates = {round(s["a"], 3) for s in braking[:-1]}
    assert len(rates) == 1 and -comfort <= rates.pop() <= -0.97 * comfort
    # It goes when the light says so, with half of 4 m/s^2.
    moving = [s for s in trace.states("ego") if s["t"] > at_rest[0]["t"] and s["v"] > 0.0]
    assert moving[0]["t"] == pytest.approx(16.0 + 0.05)
    assert moving[10]["a"] == pytest.approx(2.0)
    assert moving[-1]["road"] != "1"


def test_states_of_the_lights(trace_of: Callable[[str], Trace]) -> None:
    states = [
        (line["t"], line["signal"], line["state"], line["bulbs"])
        for line in trace_of(LIGHTS).of_kind("signal")
    ]
    red, off = ["is_on", "is_off", "is_off"], ["is_off", "is_off", "is_on"]
    assert states == [
        (0.0, "101", "stop", red),
        (0.0, "102", "go", off),
        (0.0, "103", "stop", red),
        (0.0, "104", "go", off),
        (15.0, "101", "attention", ["is_on", "is_on", "is_off"]),
        (15.0, "102", "stop", red),
        (15.0, "104", "stop", red),
        (16.0, "101", "go", off),
        (16.0, "103", "go", off),
    ]


def test_braking_on_snow_takes_what_friction_allows(trace_of: Callable[[str], Trace]) -> None:
    """v^2 / (2 mu g), and v a / (2 j) for the limited jerk of 10 m/s^3 at both ends."""
    trace = trace_of(ROADS)
    start = trace.state("ego", trace.action("case.osc:18", "start"))
    end = trace.state("ego", trace.action("case.osc:18", "end"))
    assert start["v"] == pytest.approx(20.0)
    assert end["v"] == pytest.approx(0.0, abs=1e-6)
    limit = 0.2 * G
    expected = 20.0**2 / (2 * limit) + 20.0 * limit / (2 * 10.0)
    assert end["x"] - start["x"] == pytest.approx(expected, abs=0.01)
    slowest = min(s["a"] for s in trace.states("ego") if s["t"] < 12.0)
    assert slowest == pytest.approx(-limit, abs=1e-6)


def test_the_road_is_as_before_after_the_snow(trace_of: Callable[[str], Trace]) -> None:
    """10 m/s at 4 m/s^2 with a jerk of 10 m/s^3: D/a + a/j."""
    trace = trace_of(ROADS)
    begin = trace.action("case.osc:20", "start")
    end = trace.action("case.osc:20", "end")
    assert end - begin == pytest.approx(math.ceil((10 / 4 + 4 / 10) / 0.05) * 0.05)


def test_a_rate_beyond_friction_fails_with_its_reason(trace_of: Callable[[str], Trace]) -> None:
    trace = trace_of(ROADS)
    (failed,) = [line for line in trace.of_kind("action") if line["status"] == "fail"]
    assert failed["source"] == "case.osc:24"
    assert failed["reason"] == (
        f"rate_peak 7 m/s^2 is not between 0 and {0.6 * G:.4g} m/s^2 on a wet road"
    )


CYCLES = """
import osc.standard.all

namespace null use std, stdtypes

scenario cycles:
    road: map with:
        keep(it.map_file == "urban_crossing.xodr")
        keep(it.traffic_light_control == [main_cycle, side_cycle])
    light: traffic_light with:
        keep(it.map_id == "101")
    main_street: traffic_light_group with:
        keep(it.map_id == "1")
    side_street: traffic_light_group with:
        keep(it.map_id == "2")
    main_green: traffic_light_phase with:
        keep(it.group == main_street)
        keep(it.bulbs_state == light.semantic_state_to_state(go))
        keep(it.duration == 3s)
    main_red: traffic_light_phase with:
        keep(it.group == main_street)
        keep(it.bulbs_state == light.semantic_state_to_state(stop))
        keep(it.duration == 2s)
    side_red: traffic_light_phase with:
        keep(it.group == side_street)
        keep(it.bulbs_state == light.semantic_state_to_state(stop))
        keep(it.duration == 3s)
    side_green: traffic_light_phase with:
        keep(it.group == side_street)
        keep(it.bulbs_state == light.semantic_state_to_state(go))
        keep(it.duration == 2s)
    main_cycle: traffic_light_cycle with:
        keep(it.phases == [main_green, main_red])
        keep(it.synchronization_group_id == 1)
    side_cycle: traffic_light_cycle with:
        keep(it.phases == [side_red, side_green])
        keep(it.synchronization_group_id == 1)
    lights: traffic_light_controller

    do serial:
        lights.play_cycles([main_cycle, side_cycle], duration: 7s)
        lights.set_group_state(side_street, state: [is_off, is_on, is_off])
        lights.set_state(light, state: [is_off, is_flashing, is_off])
        lights.set_group_bulb_state(light, bulb_color: red, bulb_kind: circle, bulb_state: is_on)
        wait elapsed(1s)
        lights.set_semantic_state(light, state: stop, sync: true)
"""

NETWORK = """
import osc.standard.all

namespace null use std, stdtypes

scenario network:
    net: map
    net.set_map_file("urban_crossing.xodr")
    arm, opposite: road
    inner, outer: lane
    # The arms lie opposite each other
    net.roads_follow_in_junction(in_road: arm, out_road: opposite, direction: straight)
    net.number_of_lanes(route: arm, num_of_lanes: LANES)
    net.lane_side(lane1: inner, side: left, lane2: outer)
    ego, other: vehicle

    do parallel:
        ego.drive(duration: 1s) with:
            along(inner, at: start)
            position(30m, at: start)
            speed(10mps)
        other.drive(duration: 1s) with:
            along(opposite, at: start)
            position(30m, at: start)
            speed(10mps)
"""


def test_cycles_and_lights_in_step(trace_of: Callable[[str], Trace]) -> None:
    red, yellow, green = (["is_on" if i == lit else "is_off" for i in range(3)] for lit in range(3))
    shown = {
        (line["t"], line["signal"]): line["bulbs"] for line in trace_of(CYCLES).of_kind("signal")
    }
    main, side = ("101", "103"), ("102", "104")
    expected = {
        **{(t, one): green for t in (0.0, 5.0) for one in main},
        **{(t, one): red for t in (0.0, 5.0) for one in side},
        **{(3.0, one): red for one in main},
        **{(3.0, one): green for one in side},
        # The lamps of one instant add up.
        **{(7.0, one): yellow for one in side},
        (7.0, "101"): ["is_on", "is_flashing", "is_off"],
        (7.0, "103"): ["is_on", "is_off", "is_on"],
        # 101 is red as in its second phase, when the side street has green.
        (8.0, "101"): red,
        **{(8.0, one): green for one in side},
    }
    assert shown == expected


def test_roads_of_the_map_are_chosen(trace_of: Callable[[str], Trace]) -> None:
    """Arm 1 comes first, 3 lies opposite; lane -1 has a lane to its right."""
    trace = trace_of(NETWORK.replace("LANES", "4"))
    start, other = trace.state("ego", 0.0), trace.state("other", 0.0)
    assert (start["road"], start["lane"], start["s"]) == ("1", -1, pytest.approx(30.0))
    assert (other["road"], other["s"]) == ("3", pytest.approx(30.0))


def test_roads_that_the_map_does_not_have(trace_of: Callable[[str], Trace]) -> None:
    with pytest.raises(ScenarioError, match="nothing for which number_of_lanes holds") as caught:
        trace_of(NETWORK.replace("LANES", "9"))
    assert caught.value.source == "case.osc:13"


def test_modifiers_of_the_map_without_what_they_need(tmp_path: Path) -> None:
    modifier = "net.crossing_connects(start_lane: inner, end_lane: outer, start_s_coord: 10m)"
    text = NETWORK.replace("LANES", "4").replace(
        "    ego, other", f"    {modifier}\n    ego, other"
    )
    path = tmp_path / "case.osc"
    path.write_text(text, encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions())
    assert compilation.module is None
    (refused,) = [each for each in compilation.diagnostics if each.code == "OSC509"]
    assert refused.message == "modifier `crossing_connects` needs `crossing`"
    assert refused.primary is not None and refused.primary.line == 15


FROM_FILE = """
import osc.standard.all

namespace null use std, stdtypes

scenario from_file:
    road: map with:
        keep(it.map_file == "urban_crossing.xodr")
    road.set_traffic_lights_control_file("lights.json")
    lights: traffic_light_controller

    do serial:
        lights.play_cycles(road.traffic_light_control, duration: 4s)
"""
PHASES = [
    {"state": "go", "duration": 2},
    {"state": ["is_off", "is_on", "is_off"], "duration": 1},
    {"state": "stop", "duration": 5.5},
]


def test_cycles_of_a_file(load: Load, tmp_path: Path) -> None:
    (tmp_path / "lights.json").write_text(
        json.dumps([{"group": "1", "start_offset": 0.5, "phases": PHASES}]), encoding="utf-8"
    )
    scenario = load(emit(asam(FROM_FILE, tmp_path)))
    trace = run(scenario, RunSettings(map_path=(tmp_path,)))
    states = [(line["t"], line["state"]) for line in trace.of_kind("signal")]
    changes = [(0.0, "stop"), (0.5, "go"), (2.5, "stop_attention"), (3.5, "stop")]
    assert states == [change for change in changes for _light in range(2)]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("[{]", "cannot be read"),
        ("{}", "it is not a list of cycles"),
        ('[{"group": "1"}]', "a cycle has no phases"),
        ('[{"group": "1", "phases": [{"state": "go", "time": 1}]}]', "a phase has no duration"),
        (
            '[{"group": "1", "phases": [{"state": "blue", "duration": 1}]}]',
            '"blue" is neither a meaning nor a list of bulb states',
        ),
        ('[{"group": "1", "phases": [], "speed": 1}]', "a cycle knows no speed"),
        (None, "there is no file lights.json"),
    ],
)
def test_files_that_hold_no_cycles(
    text: str | None, reason: str, load: Load, tmp_path: Path
) -> None:
    if text is not None:
        (tmp_path / "lights.json").write_text(text, encoding="utf-8")
    scenario = load(emit(asam(FROM_FILE, tmp_path)))
    with pytest.raises(ScenarioError, match=reason) as caught:
        run(scenario, RunSettings(map_path=(tmp_path,)))
    assert caught.value.source == "case.osc:9" and caught.value.exit_code == 4

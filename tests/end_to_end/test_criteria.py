"""What `--fail-on` makes of a run, and how its conduct changes it."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.running.main import verdict
from osc2tx_runtime.running.options import read_options
from osc2tx_runtime.running.runner import run_scenario
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "{map}.xodr")
    ego: vehicle
    other: vehicle
"""
BUMP = """
    do parallel(duration: 5s):
        ego.drive() with:
            lane(2, at: start)
            position(100m, at: start)
            speed(70kph)
        other.drive() with:
            lane(2, at: start)
            position(130m, at: start)
            speed(20kph)
"""
LIGHT = """
    lights: traffic_light_controller
    ahead: traffic_light with:
        keep(it.map_id == "101")
    do parallel(duration: {seconds}s):
        lights.set_semantic_state(traffic_light: ahead, state: {state})
        other.drive() with:
            lane(2, at: start)
            position(10m, at: start)
            speed(0mps)
        ego.drive() with:
            lane(1, at: start)
            position(10m, at: start)
            speed(12mps)
"""
VERGE = """
    verge: position_3d with:
        keep(it.x == 130m)
        keep(it.y == -15m)
        keep(it.z == 0m)
    do serial:
        ego.drive(duration: 1s) with:
            lane(2, at: start)
            position(100m, at: start)
            speed(10mps)
        ego.assign_position(position: verge)
        ego.drive(duration: 1s)
"""


@pytest.fixture
def play(load: Load, tmp_path: Path) -> Callable[..., Trace]:
    """Run a scenario with the head above."""

    def play(body: str, road: str = "highway", **settings: object) -> Trace:
        scenario = load(emit(asam(HEAD.replace("{map}", road) + body, tmp_path)))
        return run(scenario, RunSettings(**settings))  # type: ignore[arg-type]

    return play


def test_a_collision_fails_the_run_if_it_is_to(play: Callable[..., Trace]) -> None:
    assert (play(BUMP).status, play(BUMP).time) == ("success", 5.0)
    trace = play(BUMP, fail_on=("collision",))
    assert (trace.status, trace.reason) == ("failure", "collision of ego and other at 1.85 s")
    assert json.loads(trace.text.splitlines()[-1])["status"] == "failure"


def test_a_collision_is_said_in_any_case(load: Load, tmp_path: Path) -> None:
    scenario = load(emit(asam(HEAD.replace("{map}", "highway") + BUMP, tmp_path)))
    first, *_ = verdict("top", run_scenario(scenario))
    assert first == "top: success after 5.00 s, with 1 collision"


@pytest.mark.parametrize(
    ("state", "seconds", "broken"), [("stop", 20, True), ("go", 20, False), ("stop", 2, False)]
)
def test_a_red_light(play: Callable[..., Trace], state: str, seconds: int, broken: bool) -> None:
    body = LIGHT.format(state=state, seconds=seconds)
    trace = play(body, "urban_crossing", fail_on=("red_light",))
    assert trace.status == ("failure" if broken else "success")
    assert ("ego past the red light 101" in trace.reason) == broken
    assert play(body, "urban_crossing").status == "success"


def test_off_the_road(play: Callable[..., Trace]) -> None:
    trace = play(VERGE, fail_on=("off_road",))
    assert (trace.status, trace.reason) == ("failure", "ego off the road at 1.05 s")
    assert play(VERGE).status == "success"


def test_conduct_of_the_standard(play: Callable[..., Trace]) -> None:
    """All keep clear of each other and stop at red lights; the header says so."""
    trace = play(BUMP, conduct="standard", fail_on=("collision",))
    assert trace.status == "success"
    assert json.loads(trace.text.splitlines()[0])["conduct"] == "standard"
    assert "conduct" not in json.loads(play(BUMP).text.splitlines()[0])
    body = LIGHT.format(state="stop", seconds=20)
    trace = play(body, "urban_crossing", conduct="standard", fail_on=("red_light",))
    assert trace.status == "success"
    assert [s["v"] for s in trace.of_kind("state") if s["actor"] == "ego"][-1] == 0.0


def test_conduct_unless_the_scenario_says_otherwise(play: Callable[..., Trace]) -> None:
    reckless = BUMP.replace("speed(70kph)", "speed(70kph)\n            avoid_collisions(false)")
    trace = play(reckless, conduct="standard", fail_on=("collision",))
    assert trace.reason == "collision of ego and other at 1.85 s"


def test_conduct_goes_on_between_actions(play: Callable[..., Trace]) -> None:
    body = """
    do parallel(duration: 6s):
        serial:
            ego.drive(duration: 0.5s) with:
                lane(2, at: start)
                position(100m, at: start)
                speed(70kph)
            ego.assign_speed(speed: 60kph)
            wait elapsed(5s)
        other.drive() with:
            lane(2, at: start)
            position(140m, at: start)
            speed(20kph)
"""
    assert play(body, fail_on=("collision",)).status == "failure"
    assert play(body, conduct="standard", fail_on=("collision",)).status == "success"


def test_texts_of_the_options() -> None:
    settings = read_options({"fail-on": ["collision,red_light", "off_road"], "conduct": "standard"})
    assert settings.fail_on == ("collision", "red_light", "off_road")
    assert settings.conduct == "standard"
    for name, text in (("fail-on", "crash"), ("conduct", "nice")):
        with pytest.raises(SettingsError, match=f"--{name} {text}: write"):
            read_options({name: text})

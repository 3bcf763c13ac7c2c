"""Bodies with physics that their velocities bring to each pose: others see how fast they are."""

from __future__ import annotations

import json
import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from osc2tx.backends.py_trees.emitter import emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunResult, RunSettings
from osc2tx_runtime.simulators.carla.client_process import ClientProcess
from osc2tx_runtime.simulators.carla.frames import measurement_from, turning_of

from .conftest import OWN_MAPS
from .runs import GENERATED, in_carla, in_the_world, lines_of, modules, run_all, settings_for
from .stand_in.process import StandInProcess
from .test_written import commands

DT = 0.05
PLACE, LEAD = 6, 7  # numbers of commands
Looks = list[dict[int, list[float]]]


@pytest.mark.slow
@pytest.mark.parametrize("module", modules(), ids=lambda path: path.relative_to(GENERATED).stem)
def test_all_modules_leave_the_same_trace(module: Path, towns: StandInProcess) -> None:
    """As with poses that are written, but for the control modes in the header."""
    physics = in_carla(settings_for(module), towns.port, control={"": "exact-physics"})
    here, there = in_the_world(module), run_all(module, physics)
    assert {name: lines_of(result) for name, result in there.items()} == {
        name: lines_of(result) for name, result in here.items()
    }
    assert towns.ask("stand_in_actors") == {}
    assert towns.ask("stand_in_unknown") == {}


# --- what others see -------------------------------------------------------------------------


@pytest.fixture
def looks(monkeypatch: pytest.MonkeyPatch) -> Looks:
    """States of all actors after each step, as every client of the server sees them."""
    found: Looks = []
    ask = ClientProcess.ask

    def noting(self: ClientProcess, request: str, *values: Any, **options: Any) -> Any:
        answer = ask(self, request, *values, **options)
        if request == "step":
            found.append({number: state for number, state in answer["actors"] if state})
        return answer

    monkeypatch.setattr(ClientProcess, "ask", noting)
    return found


def run(name: str, settings: RunSettings) -> RunResult:
    (module,) = GENERATED.rglob(f"{name}.py")
    (result,) = run_all(module, settings).values()
    assert isinstance(result, RunResult), result
    return result


def states_of(result: RunResult, actor: str) -> list[dict[str, Any]]:
    lines = map(json.loads, result.trace_lines)
    return [each for each in lines if each["kind"] == "state" and each["actor"] == actor]


@pytest.mark.parametrize(("control", "seen"), [("exact", 0.0), ("exact-physics", 1.0)])
def test_others_see_how_fast_they_are(
    stand_in: StandInProcess, looks: Looks, control: str, seen: float
) -> None:
    """The mean of a step, of all steps; a body without physics stands for them."""
    result = run("cut_in", in_carla(RunSettings(), stand_in.port, control={"": control}))
    for actor, name in zip(sorted(looks[-1]), ("ego", "other"), strict=True):
        speeds = [each["v"] for each in states_of(result, name)]
        means = [0.5 * (before + after) for before, after in pairwise(speeds)]
        found = [math.hypot(*look[actor][6:9]) for look in looks[-len(means) :]]
        assert found == pytest.approx([seen * mean for mean in means], abs=0.03)


def test_places_are_reached_without_being_written(stand_in: StandInProcess, looks: Looks) -> None:
    """The damping of a step is made up for in the next one."""
    stand_in.calls()
    settings = in_carla(RunSettings(), stand_in.port, control={"": "exact-physics"})
    result = run("cut_in", settings)
    placed = commands(stand_in.calls(), PLACE)
    assert len(placed) == 2  # at the start
    wished = states_of(result, "other")
    actor = sorted(looks[-1])[1]
    to_reference = wished[0]["x"] - looks[-len(wished)][actor][0]
    for state, look in zip(wished, looks[-len(wished) :], strict=True):
        x, y, *_ = look[actor]
        assert x + to_reference * math.cos(state["h"]) == pytest.approx(state["x"], abs=2e-3)
        assert -y + to_reference * math.sin(state["h"]) == pytest.approx(state["y"], abs=2e-3)


@given(
    start=st.tuples(
        *[st.floats(-5.0, 5.0)] * 3, st.floats(-8, 8), st.floats(-180, 180), st.just(0.0)
    ),
    rates=st.tuples(*[st.floats(-40.0, 40.0)] * 3),
)
def test_turning_is_what_is_measured(
    start: tuple[float, ...], rates: tuple[float, float, float]
) -> None:
    """Roll, pitch and heading rates from the angular velocity are those between the poses."""
    pitch, yaw, roll = rates
    goal = [*start[:3], *(at + rate * DT for at, rate in zip(start[3:], rates, strict=True))]
    middle = [(a + b) / 2.0 for a, b in zip(start, goal, strict=True)]
    turning = turning_of(start, goal, DT)
    found = measurement_from([*middle, 0.0, 0.0, 0.0, *turning, 0.0, 0.0, 0.0])
    assert found.turning is not None
    about_x, about_y, about_z = map(math.degrees, found.turning)
    h = -math.radians(middle[4])
    assert about_z == pytest.approx(-yaw)
    assert about_x * math.cos(h) + about_y * math.sin(h) == pytest.approx(roll)
    assert about_y * math.cos(h) - about_x * math.sin(h) == pytest.approx(-pitch)


# --- what moves them -------------------------------------------------------------------------


def test_a_body_that_is_pushed_is_put_back(
    stand_in: StandInProcess, monkeypatch: pytest.MonkeyPatch, looks: Looks
) -> None:
    """Something moves it by 0.5 m in the 60th step: the trace says so once."""
    ask, steps = ClientProcess.ask, 0

    def pushing(self: ClientProcess, request: str, *values: Any, **options: Any) -> Any:
        nonlocal steps
        answer = ask(self, request, *values, **options)
        if request == "step":
            steps += 1
            if steps == 60:
                actor = sorted(number for number, state in answer["actors"] if state)[0]
                state = dict(answer["actors"])[actor]
                state[1] += 0.5
                ask(self, "apply", [("place", actor, *state[:6])])
        return answer

    monkeypatch.setattr(ClientProcess, "ask", pushing)
    result = run("cut_in", in_carla(RunSettings(), stand_in.port, control={"": "exact-physics"}))
    lines = [json.loads(each) for each in result.trace_lines]
    displaced = [each for each in lines if each["kind"] == "simulator_displaced"]
    assert [(each["actor"], each["distance"]) for each in displaced] == [("ego", 0.5)]
    assert result.status == "success"


def test_walkers_walk(stand_in: StandInProcess) -> None:
    """They are led at their speed, with their feet on the ground, and keep their physics."""
    stand_in.calls()
    settings = in_carla(RunSettings(), stand_in.port, control={"": "exact-physics"})
    result = run("pedestrian_crossing", settings)
    walks = [fields for fields in commands(stand_in.calls(), LEAD) if fields[2] > 0.0]
    speeds = sorted(speed for _, _, speed in walks)
    assert speeds[len(speeds) // 2] == pytest.approx(1.4, abs=1e-3)
    assert {round(pose[0][2], 3) for _, pose, _ in walks} == {0.0}
    assert result.status == "success"


# --- where it is the default -----------------------------------------------------------------

RADAR = [{"id": "front", "type": "sensor.other.radar", "spawn_point": {"x": 2.0, "z": 0.8}}]


def control_of(settings: RunSettings) -> Any:
    return json.loads(run("cut_in", settings).trace_lines[0]).get("control")


def test_who_meets_a_vehicle_under_test_has_physics(stand_in: StandInProcess) -> None:
    settings = RunSettings(expect=True, max_time=0.5)
    found = control_of(in_carla(settings, stand_in.port, control={"ego": "external"}))
    assert found == {"ego": "external", "other": "exact-physics"}
    stated = {"": "exact", "ego": "external"}
    found = control_of(in_carla(settings, stand_in.port, control=stated))
    assert found == {"ego": "external", "other": "exact"}


def test_who_meets_traffic_of_the_simulator_has_physics(stand_in: StandInProcess) -> None:
    settings = RunSettings(expect=True, max_time=0.5)
    found = control_of(in_carla(settings, stand_in.port, control={"other": "autopilot"}))
    assert found == {"ego": "exact-physics", "other": "autopilot"}


def test_who_meets_a_vehicle_of_another_client_has_physics(
    stand_in: StandInProcess, client: Any
) -> None:
    world = client.get_world()
    blueprint = world.get_blueprint_library().find("vehicle.tesla.model3")
    blueprint.set_attribute("role_name", "ego")
    ego = world.spawn_actor(blueprint, world.get_map().get_spawn_points()[30])
    settings = RunSettings(expect=True, max_time=0.5)
    found = control_of(in_carla(settings, stand_in.port, wait_for={"ego": 5.0}))
    ego.destroy()
    assert found == {"ego": "external", "other": "exact-physics"}


def test_a_radar_sees_speeds(stand_in: StandInProcess, tmp_path: Path) -> None:
    file = tmp_path / "stack.json"
    file.write_text(json.dumps(RADAR), encoding="utf-8")
    settings = RunSettings(max_time=0.5)
    found = control_of(in_carla(settings, stand_in.port, sensors={"ego": file}))
    assert found == {"ego": "exact-physics", "other": "exact-physics"}
    assert control_of(in_carla(settings, stand_in.port)) is None


# --- walkers that are hit --------------------------------------------------------------------

HIT = """
import osc.standard.all
namespace null use std, stdtypes
scenario hit:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    walker: person
    do parallel(duration: 6s):
        walker.remain_stationary() with:
            lane(1, at: start)
            position(150m, at: start)
        ego.drive() with:
            lane(1, at: start)
            position(120m, at: start)
            speed(10mps)
"""


@pytest.mark.parametrize("control", ["exact", "exact-physics", "driven"])
def test_a_walker_that_was_hit_is_removed_by_the_simulator(tmp_path: Path, control: str) -> None:
    """The run goes on: the contact is what the scenario is about."""
    module = generated(HIT, tmp_path)
    with StandInProcess([OWN_MAPS], "highway", "--fault", "mortal-walkers") as server:
        modes = {"": control, "ego": "driven"}
        settings = in_carla(RunSettings(), server.port, control=modes)
        (result,) = run_all(module, settings).values()
    assert isinstance(result, RunResult), result
    lines = [json.loads(each) for each in result.trace_lines]
    (removed,) = (each for each in lines if each["kind"] == "simulator_removed")
    hit = next(each["t"] for each in lines if each["kind"] == "collision")
    assert removed["actor"] == "walker" and hit < removed["t"] < 6.0
    assert result.time == pytest.approx(6.0)


def generated(text: str, folder: Path) -> Path:
    """Write the module of a scenario."""
    source = folder / "hit.osc"
    source.write_text(text, encoding="utf-8")
    compilation = Compilation(source, source.name, CompileOptions())
    assert compilation.ir is not None, compilation.diagnostics
    module = emit(compilation.ir)
    path = folder / "hit.py"
    path.write_text(module.python, encoding="utf-8")
    path.with_suffix(".map.json").write_text(module.source_map, encoding="utf-8")
    return path

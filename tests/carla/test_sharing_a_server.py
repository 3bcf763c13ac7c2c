"""Others on the same server: their actors, their steps, their map."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import textwrap
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path
from threading import Event, Thread
from typing import Any

import pytest

from osc2tx.module_loading import scenarios_of_file
from osc2tx_runtime import RunResult, RunSettings, run_scenario
from osc2tx_runtime.errors import ScenarioError, SettingsError, SimulatorError

from .conftest import OWN_MAPS
from .runs import GENERATED, in_carla
from .stand_in.process import ROOT, StandInProcess

pytestmark = pytest.mark.slow

Until = Callable[[Callable[[], bool]], None]

CONNECT = """
    import carla, math, sys, time
    client = carla.Client("127.0.0.1", int(sys.argv[1]))
    client.set_timeout(20.0)
    world = client.get_world()

    def spawn(role, index=0):
        blueprint = world.get_blueprint_library().find("vehicle.tesla.model3")
        blueprint.set_attribute("role_name", role)
        return world.spawn_actor(blueprint, world.get_map().get_spawn_points()[index])

    def find(role):
        while True:
            for actor in world.get_actors():
                if actor.attributes.get("role_name") == role:
                    return actor
            time.sleep(0.02)
"""


@pytest.fixture
def server() -> Iterator[StandInProcess]:
    """A stand-in of its own: what is left on it would be in the way of others."""
    with StandInProcess([OWN_MAPS], "highway") as process:
        yield process


@pytest.fixture
def beside(server: StandInProcess) -> Iterator[Callable[[str], subprocess.Popen[str]]]:
    """Start a script of somebody else, which has a `world` of the server."""
    started: list[subprocess.Popen[str]] = []

    def start(script: str) -> subprocess.Popen[str]:
        text = textwrap.dedent(CONNECT) + textwrap.dedent(script)
        process = subprocess.Popen(
            [sys.executable, "-c", text, str(server.port)],
            cwd=ROOT,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        return process

    yield start
    for process in started:
        process.kill()
        process.communicate()


def run(name: str, settings: RunSettings) -> RunResult:
    """Run the scenario of a generated module."""
    with scenarios_of_file(GENERATED / f"{name}.py", f"shared_{name}") as scenarios:
        return run_scenario(scenarios[name], settings)


def roles(server: StandInProcess) -> list[str]:
    """Return the role names of what is on the server."""
    return sorted(role for each in server.ask("stand_in_actors").values() for role in each)


def test_actors_of_others_are_left_alone(server: StandInProcess, beside: Any) -> None:
    other = beside("spawn('somebody', 40); print('there', flush=True); sys.stdin.read()")
    assert other.stdout.readline() == "there\n"
    assert run("cut_in", in_carla(RunSettings(), server.port)).status == "success"
    assert roles(server) == ["somebody"]


def test_who_stands_in_the_way_is_named(server: StandInProcess, beside: Any) -> None:
    other = beside("""
        place = carla.Transform(carla.Location(201.4, 8.75, 0.3))
        blueprint = world.get_blueprint_library().find("vehicle.audi.tt")
        blueprint.set_attribute("role_name", "broken_down")
        world.spawn_actor(blueprint, place)
        print("there", flush=True); sys.stdin.read()
        """)
    assert other.stdout.readline() == "there\n"
    settings = in_carla(RunSettings(), server.port, control={"": "driven"})
    with pytest.raises(SimulatorError) as found:
        run("cut_in", settings)
    assert "ego: CARLA does not spawn vehicle." in found.value.message
    assert "collision at spawn position" in found.value.message
    assert "vehicle.audi.tt" in found.value.message and "(broken_down)" in found.value.message
    assert roles(server) == ["broken_down"]
    assert not server.ask("stand_in_synchronous")


def test_another_process_finds_the_ego_and_drives_it(server: StandInProcess, beside: Any) -> None:
    """It is spawned by us, and controlled by somebody else while the scenario goes on."""
    beside("""
        ego = find("ego")
        while True:
            ego.apply_control(carla.VehicleControl(throttle=1.0))
            world.wait_for_tick()
        """)
    settings = in_carla(
        RunSettings(expect=True, max_time=6.0), server.port, control={"ego": "external"}
    )
    result = run("cut_in", settings)
    speeds = [
        line for line in result.trace_lines if '"kind":"state"' in line and '"actor":"ego"' in line
    ]
    first, last = json.loads(speeds[0])["v"], json.loads(speeds[-1])["v"]
    assert last > first + 3.0  # nobody but the other process makes it faster
    assert json.loads(result.trace_lines[0])["control"]["ego"] == "external"
    assert roles(server) == []


def test_the_traffic_manager_drives(server: StandInProcess) -> None:
    """That of the client library, in step with the run and seeded."""
    settings = RunSettings(expect=True, max_time=3.0)
    result = run("cut_in", in_carla(settings, server.port, control={"other": "autopilot"}))
    calls = server.calls()
    assert json.loads(result.trace_lines[0])["control"]["other"] == "autopilot"
    assert "add_traffic_manager_running" in [name for name, _ in calls]
    assert roles(server) == [] and not server.ask("stand_in_synchronous")


def test_the_ego_that_somebody_else_spawns(server: StandInProcess, beside: Any) -> None:
    """It is waited for, put where it starts, and left in the end."""
    beside("time.sleep(0.5); spawn('ego', 30); sys.stdin.read()")
    settings = in_carla(RunSettings(expect=True, max_time=2.0), server.port, wait_for={"ego": 30.0})
    result = run("cut_in", settings)
    begin = next(d for d in map(json.loads, result.trace_lines) if d.get("actor") == "ego")
    assert (begin["x"], begin["y"]) == pytest.approx((200.0, -8.75), abs=0.01)
    assert roles(server) == ["ego"]


def test_two_egos_of_others(server: StandInProcess, beside: Any) -> None:
    """Both are named; a sensor of that role name is no ego."""
    script = """
        blueprint = world.get_blueprint_library().find("sensor.other.imu")
        blueprint.set_attribute("role_name", "ego")
        one = spawn("ego", 30)
        world.spawn_actor(blueprint, carla.Transform(), attach_to=one)
        {more}
        print("there", flush=True); sys.stdin.read()
        """
    settings = in_carla(RunSettings(expect=True, max_time=0.5), server.port, wait_for={"ego": 1.0})
    one = beside(script.format(more=""))
    assert one.stdout.readline() == "there\n"
    assert run("cut_in", settings).status == "timeout"
    assert beside('spawn("ego", 40); print("there", flush=True)').stdout.readline() == "there\n"
    with pytest.raises(SimulatorError) as found:
        run("cut_in", settings)
    assert "several actors have the role_name ego: vehicle.tesla.model3" in found.value.message
    assert found.value.message.count("vehicle.tesla.model3") == 2


def test_an_ego_that_never_comes(server: StandInProcess) -> None:
    settings = in_carla(RunSettings(expect=True), server.port, wait_for={"ego": 0.3})
    with pytest.raises(SimulatorError, match="no actor with role_name ego appeared"):
        run("cut_in", settings)
    assert not server.ask("stand_in_synchronous")


TICKER = """
    settings = world.get_settings()
    settings.synchronous_mode, settings.fixed_delta_seconds = True, {dt}
    world.apply_settings(settings)
    print("there", flush=True)
    while True:
        time.sleep(0.02)
        world.tick()
"""


def test_one_makes_the_steps(server: StandInProcess, beside: Any) -> None:
    assert beside(TICKER.format(dt=0.05)).stdout.readline() == "there\n"
    with pytest.raises(SimulatorError, match="synchronous mode already"):
        run("cut_in", in_carla(RunSettings(), server.port))


FOLLOWER = """
    settings = world.get_settings()
    settings.synchronous_mode, settings.fixed_delta_seconds = True, 0.05
    world.apply_settings(settings)
    print("there", flush=True)
    for line in sys.stdin:
        if line.strip():
            settings.fixed_delta_seconds = float(line)
            world.apply_settings(settings)
        world.tick()
"""


@pytest.fixture
def lengths() -> dict[int, str]:
    """Lengths of steps that are set after so many batches."""
    return {}


@pytest.fixture
def patient(server: StandInProcess, beside: Any, lengths: dict[int, str]) -> Iterator[None]:
    """Somebody who makes the next step as soon as a batch of commands has come."""
    ticker = beside(FOLLOWER)
    batches = count()
    assert ticker.stdout.readline() == "there\n"
    over = Event()

    def follow() -> None:
        while not over.wait(0.005):
            for name, _ in server.calls():
                if name == "apply_batch":
                    ticker.stdin.write(lengths.get(next(batches), "") + "\n")
                    ticker.stdin.flush()

    thread = Thread(target=follow)
    thread.start()
    yield
    over.set()
    thread.join()


def test_the_steps_of_somebody_else(server: StandInProcess, patient: None) -> None:
    result = run("cut_in", in_carla(RunSettings(max_time=3.0), server.port, no_tick=True))
    assert (result.status, result.steps) == ("timeout", 60)
    assert roles(server) == []
    assert server.ask("stand_in_synchronous")  # that is the other one's


def test_steps_that_change_their_length(
    server: StandInProcess, patient: None, lengths: dict[int, str]
) -> None:
    lengths[20] = "0.1"
    says = r"a step of CARLA was 0\.1 s long|advanced \d+ steps at once"
    with pytest.raises(SimulatorError, match=says):
        run("cut_in", in_carla(RunSettings(max_time=3.0), server.port, no_tick=True))


def test_steps_of_another_length(server: StandInProcess, beside: Any) -> None:
    assert beside(TICKER.format(dt=0.1)).stdout.readline() == "there\n"
    with pytest.raises(SettingsError, match=r"run with --dt 0\.1"):
        run("cut_in", in_carla(RunSettings(), server.port, no_tick=True))


def test_another_map_is_refused(server: StandInProcess) -> None:
    settings = in_carla(RunSettings(), server.port, carla_load=False)
    with pytest.raises(SimulatorError, match=r"has the map highway, which is not .* crossing"):
        run("pedestrian_crossing", settings)
    assert run("cut_in", settings).status == "success"


def test_a_map_that_the_server_lacks_is_generated(tmp_path: Path) -> None:
    shutil.copy(OWN_MAPS / "curve.xodr", tmp_path)
    with StandInProcess([tmp_path], "curve") as bare:
        assert run("cut_in", in_carla(RunSettings(), bare.port)).status == "success"
        ((text, parameters),) = (
            given for name, given in bare.calls() if name == "copy_opendrive_to_file"
        )
        _, _, wall_height, *_, pedestrian_navigation = parameters
        assert wall_height == 0.0 and not pedestrian_navigation
    assert text == (OWN_MAPS / "highway.xodr").read_text(encoding="utf-8")


def test_control_of_who_is_not_there(server: StandInProcess) -> None:
    with pytest.raises(ScenarioError, match="nobody"):
        run("cut_in", in_carla(RunSettings(), server.port, control={"nobody": "driven"}))
    assert not server.ask("stand_in_synchronous")

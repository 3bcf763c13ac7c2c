"""What a run changes on a server is as before afterwards, also where its processes are killed."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from osc2tx.module_loading import scenarios_of_file
from osc2tx_runtime import RunResult, RunSettings, run_scenario
from osc2tx_runtime.errors import SimulatorError
from osc2tx_runtime.simulators.carla import plant
from osc2tx_runtime.simulators.carla.client import actors, surroundings
from osc2tx_runtime.simulators.carla.client.journal import UNDO, Journal, left_behind
from osc2tx_runtime.simulators.carla.client_process import ClientProcess

from .conftest import OWN_MAPS
from .runs import GENERATED, in_carla
from .stand_in.process import ROOT, StandInProcess
from .test_lost_servers import begin_slowly, module, wait_for_steps

Until = Callable[[Callable[[], bool]], None]

SOMEBODY = """
import carla, sys
client = carla.Client("127.0.0.1", int(sys.argv[1]))
client.set_timeout(20.0)
world = client.get_world()
"""


@pytest.fixture(autouse=True)
def journals(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of journals, for this test alone."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "osc2tx" / "carla"


@pytest.fixture
def server() -> Iterator[StandInProcess]:
    with StandInProcess([OWN_MAPS], "highway") as process:
        yield process


@pytest.fixture
def beside(server: StandInProcess) -> Iterator[Callable[[str], None]]:
    """Have somebody else do something on the server, and stay there."""
    started: list[subprocess.Popen[str]] = []

    def start(script: str) -> None:
        text = SOMEBODY + textwrap.dedent(script) + "\nprint('there', flush=True); sys.stdin.read()"
        process = subprocess.Popen(
            [sys.executable, "-c", text, str(server.port)],
            cwd=ROOT,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        assert process.stdout is not None and process.stdout.readline() == "there\n"

    yield start
    for process in started:
        process.kill()
        process.communicate()


def run(server: StandInProcess, name: str = "cut_in", **options: object) -> RunResult:
    max_time = float(str(options.pop("max_time", 1.0)))
    settings = in_carla(RunSettings(expect=True, max_time=max_time), server.port, **options)
    with scenarios_of_file(GENERATED / f"{name}.py", f"before_{name}") as scenarios:
        return run_scenario(scenarios[name], settings)


def level_of(server: StandInProcess) -> tuple[str, str]:
    """Return name and text of the level."""
    client = ClientProcess(10.0)
    client.ask("connect", "127.0.0.1", server.port, 10.0)
    found = client.ask("level")
    client.close()
    return found["name"], found["text"]


def client_of(run: subprocess.Popen[str]) -> int:
    """Return the id of the process of the client library."""
    (child,) = Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
    return int(child)


# --- processes that are killed ---------------------------------------------------------------


@pytest.mark.slow
def test_the_next_run_repairs_what_a_killed_one_left(
    server: StandInProcess, tmp_path: Path, journals: Path, wait: Until
) -> None:
    """Neither of its processes had time to let go: the next run does that, and says so."""
    stop = begin_slowly(server)
    killed = module(server.port, tmp_path / "trace.jsonl", "--carla-view", "ego")
    wait_for_steps(server, wait)
    client = client_of(killed)
    killed.send_signal(signal.SIGSTOP)  # it would end with its client
    os.kill(client, signal.SIGKILL)
    killed.kill()
    killed.communicate()
    stop()
    assert server.ask("stand_in_synchronous") and server.ask("stand_in_actors")
    assert len(list(journals.glob("*.jsonl"))) == 1
    following = module(server.port, tmp_path / "next.jsonl")
    _, errors = following.communicate()
    assert following.returncode == 0, errors
    said = "CARLA: restored what an interrupted run had changed: camera, own actors, settings\n"
    assert said in errors
    assert not server.ask("stand_in_synchronous") and server.ask("stand_in_actors") == {}
    assert server.ask("stand_in_spectator")[0] == [0.0, 0.0, 0.0]
    assert list(journals.iterdir()) == []


@pytest.mark.slow
def test_a_check_repairs_what_a_killed_client_left(
    server: StandInProcess, tmp_path: Path, journals: Path, wait: Until
) -> None:
    stop = begin_slowly(server)
    broken = module(server.port, tmp_path / "trace.jsonl")
    wait_for_steps(server, wait)
    os.kill(client_of(broken), signal.SIGKILL)
    stop()
    _, errors = broken.communicate()
    assert broken.returncode == 4 and "has ended its process (code -9)" in errors
    check = [sys.executable, "-m", "osc2tx", "world", "check", "carla"]
    check += ["--carla", f"127.0.0.1:{server.port}", "--output-format", "json"]
    for options, says in (([], "the next run, or --fix, restores"), (["--fix"], "restored what")):
        ended = subprocess.run([*check, *options], cwd=ROOT, capture_output=True, text=True)
        assert ended.returncode == 0, ended.stderr
        assert json.loads(ended.stdout)[5]["found"].startswith(says)
    assert not server.ask("stand_in_synchronous") and server.ask("stand_in_actors") == {}
    assert list(journals.iterdir()) == []


def test_a_level_that_was_loaded_since_has_nothing_to_repair(
    server: StandInProcess, journals: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    journals.mkdir(parents=True)
    where = f"127.0.0.1:{server.port}"
    lines = [["server", where], ["episode", 1], ["own actors", 7]]
    (journals / "dead.jsonl").write_text("".join(json.dumps(each) + "\n" for each in lines))
    run(server)
    assert "restored" not in capsys.readouterr().err
    assert list(journals.iterdir()) == []


def test_journals_that_are_not_read(tmp_path: Path) -> None:
    """Of a living session, of another server, damaged; a line that was cut off is left out."""
    assert (
        actors and surroundings and {"settings", "camera"} < set(UNDO)
    )  # they declare their kinds
    folder = tmp_path / "journals"
    living = Journal()
    living.open(str(folder), "a:1")
    living.enter(5)
    living.note("settings", {"synchronous_mode": False})
    texts = {
        "other": '["server", "b:1"]\n["episode", 6]\n["own actors", 1]\n',
        "damaged": "nothing\n",
        "unknown": '["server", "a:1"]\n["episode", 5]\n["moon", 1]\n',
        "dead": '["server", "a:1"]\n["episode", 5]\n["settings", {}]\n["camera", [0.0, 0',
    }
    for name, text in texts.items():
        (folder / f"{name}.jsonl").write_text(text)
    (found,) = left_behind(str(folder), "a:1", 5)
    assert found.changes == {"settings": [{}]}
    found.changes.clear()
    found.close()
    assert {each.stem for each in folder.iterdir()} >= {"other", "damaged", "unknown"}
    assert not (folder / "dead.jsonl").exists()
    living.changes.clear()
    living.close()
    assert left_behind("", "a:1", 5) == []


# --- level, settings, weather ----------------------------------------------------------------


@pytest.mark.slow
def test_the_level_before_is_loaded_again() -> None:
    with StandInProcess([OWN_MAPS], "curve") as server:
        script = """
            settings = world.get_settings()
            settings.no_rendering_mode = True
            world.apply_settings(settings)
            world.set_weather(carla.WeatherParameters.HardRainSunset)
            """
        text = SOMEBODY + textwrap.dedent(script)
        subprocess.run([sys.executable, "-c", text, str(server.port)], check=True)
        settings, weather = server.ask("stand_in_settings"), server.ask("stand_in_surroundings")[0]
        run(server, carla_keep=False)
        assert level_of(server)[0] == "curve"
        assert server.ask("stand_in_settings") == settings
        assert server.ask("stand_in_surroundings")[0] == pytest.approx(weather, abs=1e-3)
        run(server, carla_keep=True)
        assert level_of(server)[0] == "highway"


@pytest.mark.slow
def test_a_level_made_of_a_text_is_made_again(tmp_path: Path) -> None:
    """The server has no map of that name to load."""
    file = tmp_path / "curve.xodr"
    file.write_bytes((OWN_MAPS / "curve.xodr").read_bytes())
    with StandInProcess([tmp_path], "curve") as bare:
        run(bare, carla_keep=True)
        before = level_of(bare)
        assert before[0] == "OpenDriveMap"
        run(bare, "pedestrian_crossing", carla_keep=False)
        assert level_of(bare) == before


WEATHERED = """
    settings = world.get_settings()
    settings.no_rendering_mode = True
    world.apply_settings(settings)
    world.set_weather(carla.WeatherParameters.HardRainSunset)
    place = carla.Transform(carla.Location(1.0, 2.0, 3.0), carla.Rotation(yaw=40.0))
    world.get_spectator().set_transform(place)
    world.wait_for_tick()
"""


def all_of(server: StandInProcess) -> list[object]:
    """Return what a run may change."""
    weather, lights = server.ask("stand_in_surroundings")
    at, turn = server.ask("stand_in_spectator")
    return [
        level_of(server)[0],
        server.ask("stand_in_settings"),
        [round(each, 3) for each in weather],
        [round(each, 3) for each in (*at, *turn)],
        lights,
        server.ask("stand_in_actors"),
    ]


@pytest.mark.slow
@pytest.mark.parametrize("end", ["Ctrl-C", "exception"])
def test_all_is_as_before_where_a_run_is_cut_short(
    tmp_path: Path, wait: Until, monkeypatch: pytest.MonkeyPatch, end: str
) -> None:
    """Level, settings, weather, camera, lights and actors."""
    with StandInProcess([OWN_MAPS], "curve") as server:
        text = SOMEBODY + textwrap.dedent(WEATHERED)
        subprocess.run([sys.executable, "-c", text, str(server.port)], check=True)
        before = all_of(server)
        if end == "Ctrl-C":
            stop = begin_slowly(server)
            given = ("--carla-load", "--carla-view", "ego")
            interrupted = module(server.port, tmp_path / "trace.jsonl", *given)
            wait_for_steps(server, wait)
            interrupted.send_signal(signal.SIGINT)
            stop()
            interrupted.communicate()
            assert interrupted.returncode == 130
        else:
            monkeypatch.setattr(plant.CarlaPlant, "moved", broken)
            with pytest.raises(SimulatorError, match="nothing that a run expects"):
                run(server, carla_keep=False, carla_view="ego")
        assert all_of(server) == before


def broken(*_: object) -> None:
    raise ZeroDivisionError("nothing that a run expects")


# --- actors and traffic of others ------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("control", ["exact", "exact-physics", "driven"])
def test_a_borrowed_vehicle(
    server: StandInProcess, beside: Callable[[str], None], control: str
) -> None:
    """Physics, gravity, lights and pedals are as its client had them."""
    beside("""
        blueprint = world.get_blueprint_library().find("vehicle.tesla.model3")
        blueprint.set_attribute("role_name", "ego")
        ego = world.spawn_actor(blueprint, world.get_map().get_spawn_points()[30])
        ego.set_light_state(carla.VehicleLightState.Fog)
        ego.apply_control(carla.VehicleControl(brake=0.5, hand_brake=True))
        world.wait_for_tick()
        """)
    before = server.ask("stand_in_bodies")
    assert before["ego"][2] == 128  # it has them
    run(server, wait_for={"ego": 10.0}, control={"ego": control})
    assert server.ask("stand_in_bodies") == before


@pytest.mark.slow
def test_the_traffic_manager_of_another_client(
    server: StandInProcess, beside: Callable[[str], None]
) -> None:
    """Mode and seed of it could not be put back: a run has its own, at a port of its own."""
    beside("""
        manager = client.get_trafficmanager(8042)
        manager.set_random_device_seed(5)
        """)
    server.calls()
    with pytest.raises(SimulatorError, match=r"port 8042 is used.*--carla-tm-port"):
        run(server, control={"other": "autopilot"}, carla_tm_port=8042)
    assert run(server, control={"other": "autopilot"}).status == "timeout"
    struck = {given[0] for name, given in server.calls() if name == "destroy_traffic_manager"}
    assert struck and 8042 not in struck

"""What keeps a first run from beginning: each has a message that names the remedy.

The behaviour of the server is that of CARLA's sources (`LibCarla/source/carla/client/detail`) and
of its issue threads; the stand-in shows it.
"""

from __future__ import annotations

import json
import os
import pty
import socket
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from osc2tx.module_loading import scenarios_of_file
from osc2tx_runtime import RunResult, RunSettings, run_scenario
from osc2tx_runtime.errors import InputError, SettingsError, SimulatorError
from osc2tx_runtime.simulators.carla import attendance, level
from osc2tx_runtime.simulators.carla.attendance import Attendance
from osc2tx_runtime.simulators.carla.client_process import ClientProcess
from osc2tx_runtime.simulators.carla.world import OPTIONS

from .conftest import OWN_MAPS
from .runs import GENERATED, in_carla
from .stand_in.process import StandInProcess

CLIENT = """
import os, sys, time
import carla

client = carla.Client("127.0.0.1", int(sys.argv[1]))
client.set_timeout(20.0)
world = client.get_world()
"""


@pytest.fixture
def server() -> Iterator[StandInProcess]:
    with StandInProcess([OWN_MAPS], "highway") as process:
        yield process


def run(settings: RunSettings, name: str = "cut_in") -> RunResult:
    with scenarios_of_file(GENERATED / f"{name}.py", f"contact_{name}") as scenarios:
        return run_scenario(scenarios[name], settings)


def client_of(port: int, script: str) -> subprocess.Popen[str]:
    """Start a client of somebody else; it says `there` once it is ready."""
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(CLIENT) + textwrap.dedent(script), str(port)],
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "there\n"
    return process


def message_of(settings: RunSettings, name: str = "cut_in") -> str:
    with pytest.raises((SimulatorError, SettingsError, InputError)) as found:
        run(settings, name)
    return str(found.value.message)


# --- ports -----------------------------------------------------------------------------------


def test_nothing_listens() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
    said = message_of(in_carla(RunSettings(), port))
    assert f"there is no CARLA server at 127.0.0.1:{port}" in said


def test_something_else_listens() -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        said = message_of(in_carla(RunSettings(), port, carla_timeout=1.0))
    assert "nothing of CARLA answers within 1 s" in said


def test_the_port_of_the_streams_is_closed() -> None:
    """`docker run -p 2000:2000`: calls are answered, and no snapshot arrives."""
    with StandInProcess([OWN_MAPS], "highway", "--no-streams") as server:
        said = message_of(in_carla(RunSettings(), server.port, carla_timeout=2.0))
        assert f"nothing answers at 127.0.0.1:{server.port + 1}" in said
        assert "sends no snapshots" in said


# --- versions --------------------------------------------------------------------------------


def test_a_build_from_source_is_of_its_release(capsys: pytest.CaptureFixture[str]) -> None:
    with StandInProcess([OWN_MAPS], "highway", "--version", "0.9.16-dirty") as server:
        assert run(in_carla(RunSettings(max_time=1.0), server.port)).status == "timeout"
    assert "the server calls itself 0.9.16-dirty" in capsys.readouterr().err


def test_another_release_is_refused() -> None:
    with StandInProcess([OWN_MAPS], "highway", "--version", "0.9.15-12-gabc") as server:
        said = message_of(in_carla(RunSettings(), server.port))
    assert "the server is CARLA 0.9.15-12-gabc and the client library 0.9.16" in said
    assert "osc2tx is tested with 0.9.16" in said and "pip install carla==0.9.15" in said


# --- time ------------------------------------------------------------------------------------

SYNCHRONOUS = """
    settings = world.get_settings()
    settings.synchronous_mode, settings.fixed_delta_seconds = True, 0.05
    world.apply_settings(settings)
    print("there", flush=True)
"""


def test_a_synchronous_mode_that_a_client_left_behind(
    server: StandInProcess, capsys: pytest.CaptureFixture[str]
) -> None:
    client_of(server.port, SYNCHRONOUS + "    os._exit(0)").wait()
    settings = RunSettings(max_time=1.0)
    said = message_of(in_carla(settings, server.port))
    assert "no client makes its steps" in said and "--carla-reset" in said
    result = run(in_carla(settings, server.port, carla_reset=True))
    assert result.status == "timeout"
    assert "ended a synchronous mode" in capsys.readouterr().err
    assert not server.ask("stand_in_synchronous")


def test_nobody_makes_the_steps(server: StandInProcess) -> None:
    said = message_of(in_carla(RunSettings(), server.port, no_tick=True))
    assert "CARLA is not in synchronous mode" in said


# --- maps ------------------------------------------------------------------------------------


def test_a_level_that_takes_longer_than_a_call(capsys: pytest.CaptureFixture[str]) -> None:
    """Loading a level has its own time: the library gives up after that of one call."""
    with StandInProcess([OWN_MAPS], "curve", "--loading", "4") as server:
        settings = in_carla(RunSettings(max_time=1.0), server.port, carla_timeout=2.0)
        assert run(settings).status == "timeout"
    assert "CARLA: loading highway" in capsys.readouterr().err


def test_a_map_that_takes_longer_than_a_call() -> None:
    """So does that of a large level, though the server has it already."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "slow-map") as server:
        settings = in_carla(RunSettings(max_time=0.5), server.port, carla_timeout=1.0)
        assert run(settings).status == "timeout"


def test_a_level_that_does_not_come(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(level, "LOADING", 1.0)
    with StandInProcess([OWN_MAPS], "curve", "--loading", "8") as server:
        said = message_of(in_carla(RunSettings(), server.port, carla_timeout=1.0))
    assert said == "CARLA has not loaded highway within 1 s: --carla-timeout allows longer"


def test_a_map_that_only_the_server_has(tmp_path: Path) -> None:
    """`--carla-load` loads it, and its roads are those that the server tells."""
    text = (OWN_MAPS / "highway.xodr").read_text(encoding="utf-8")
    (tmp_path / "Town99_Opt.xodr").write_text(text, encoding="utf-8")
    other = (OWN_MAPS / "curve.xodr").read_text(encoding="utf-8")
    (tmp_path / "start.xodr").write_text(other, encoding="utf-8")
    module = (GENERATED / "cut_in.py").read_text(encoding="utf-8")
    file = tmp_path / "elsewhere.py"
    file.write_text(module.replace('"highway.xodr"', '"Town99"'), encoding="utf-8")
    with StandInProcess([tmp_path], "start") as server:
        with scenarios_of_file(file, "elsewhere") as scenarios:
            settings = in_carla(RunSettings(), server.port)
            assert run_scenario(scenarios["cut_in"], settings).status == "success"
        loaded = [given[0] for name, given in server.calls() if name == "load_new_episode"]
        assert [name.rpartition("/")[2] for name in loaded] == ["Town99_Opt"]
    with (
        StandInProcess([OWN_MAPS], "curve") as server,
        scenarios_of_file(file, "nowhere") as scenarios,
        pytest.raises(InputError, match="Town99"),
    ):
        run_scenario(scenarios["cut_in"], in_carla(RunSettings(), server.port))


# --- the process of the library -----------------------------------------------------------------


def test_a_client_py_in_the_working_folder_is_not_ours(
    server: StandInProcess, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "client.py").write_text("print('not this one')\nraise SystemExit(7)\n")
    monkeypatch.chdir(tmp_path)
    client = ClientProcess(5.0)
    assert client.ask("connect", "127.0.0.1", server.port, 5.0)["listens"]
    client.close()


def test_the_last_words_of_the_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A library that ends its process is quoted: here one that does so when it is imported."""
    folder = tmp_path / "carla"
    folder.mkdir()
    text = "import os, sys\nprint('terminate called: bad stream', file=sys.stderr, flush=True)\n"
    (folder / "__init__.py").write_text(text + "os.abort()\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    client = ClientProcess(5.0)
    with pytest.raises(SimulatorError, match="last words: terminate called: bad stream"):
        client.ask("connect", "127.0.0.1", 1, 5.0)
    client.close()


def test_windows_is_named_before_anything_else(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "win32")
    with pytest.raises(SimulatorError, match="WSL2"):
        ClientProcess(5.0)


# --- attendance --------------------------------------------------------------------------------


def states(result: RunResult, actor: str) -> list[dict[str, float]]:
    lines = map(json.loads, result.trace_lines)
    return [each for each in lines if each["kind"] == "state" and each["actor"] == actor]


def test_the_scenario_waits_for_a_first_control(server: StandInProcess) -> None:
    """A stack that needs its time to attach finds the ego where it starts, at step 0."""
    stack = subprocess.Popen(
        [
            sys.executable,
            "-c",
            textwrap.dedent(CLIENT) + textwrap.dedent("""
            ego = None
            while ego is None:
                found = [a for a in world.get_actors() if a.attributes.get("role_name") == "ego"]
                ego = found[0] if found else None
            for _ in range(30):
                world.wait_for_tick()
            while True:
                ego.apply_control(carla.VehicleControl(throttle=1.0))
                world.wait_for_tick()
            """),
            str(server.port),
        ]
    )
    try:
        settings = in_carla(
            RunSettings(expect=True, max_time=1.0),
            server.port,
            control={"ego": "external"},
            wait_control=60.0,
        )
        result = run(settings)
    finally:
        stack.kill()
        stack.wait()
    first = states(result, "ego")[0]
    assert (first["t"], first["x"]) == (0.0, pytest.approx(200.0, abs=0.5))
    assert result.steps == 20


def test_nobody_takes_control(server: StandInProcess) -> None:
    settings = in_carla(
        RunSettings(expect=True), server.port, control={"ego": "external"}, wait_control=0.2
    )
    assert "the external actors are not controlled within 0.2 s" in message_of(settings)
    assert not server.ask("stand_in_synchronous")


def test_enter_begins_at_once(server: StandInProcess, monkeypatch: pytest.MonkeyPatch) -> None:
    """Somebody at the terminal does not have to wait for a stack."""
    terminal, keyboard = pty.openpty()
    monkeypatch.setattr(sys, "stdin", os.fdopen(keyboard))
    os.write(terminal, b"\n")
    settings = in_carla(
        RunSettings(expect=True, max_time=0.5),
        server.port,
        control={"ego": "external"},
        wait_control=600.0,
    )
    assert run(settings).status == "timeout"
    os.close(terminal)


def test_steps_are_not_made_before_their_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """At twice the speed of real time, of which steps use up some themselves."""
    now, slept = 100.0, []

    def sleep(seconds: float) -> None:
        nonlocal now
        slept.append(seconds)
        now += seconds

    clock = SimpleNamespace(monotonic=lambda: now, sleep=sleep)
    monkeypatch.setattr(attendance, "time", clock)
    paced = Attendance(pace=2.0)
    paced.start()
    for cost in (0.01, 0.0, 0.04, 0.0):
        now += cost
        paced.pause(0.05)
    assert slept == pytest.approx([0.015, 0.025, 0.0, 0.01])
    assert now == pytest.approx(100.1)
    Attendance().pause(0.05)
    assert len(slept) == 4  # without a factor nothing waits


def test_the_camera_follows_an_actor_and_is_put_back(server: StandInProcess) -> None:
    run(in_carla(RunSettings(max_time=1.0), server.port, carla_view="ego"))
    placed = [
        given
        for name, given in server.calls()
        if name == "set_actor_transform" or name == "apply_batch"
    ]
    assert placed
    (x, y, z), _ = server.ask("stand_in_spectator")
    assert (x, y, z) == (0.0, 0.0, 0.0)
    said = message_of(in_carla(RunSettings(), server.port, carla_view="nobody"))
    assert said == "--carla-view nobody: the scenario has no such actor"


def test_options_are_read() -> None:
    known = {each.name: each for each in OPTIONS}
    assert known["realtime"].read(["2"]) == 2.0
    assert known["carla-tm-port"].read(["8001"]) == 8001
    for name, wrong in (("realtime", "0"), ("realtime", "nan"), ("carla-tm-port", "0")):
        with pytest.raises(SettingsError, match=f"--{name} {wrong}"):
            known[name].read([wrong])


# --- as it was before ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "town", "fault"),
    [
        ("C16_weather", "highway", ""),
        ("C17_signal_cycles", "urban_crossing", ""),
        ("C17_signal_cycles", "urban_crossing", "frozen-lights"),
    ],
)
def test_weather_and_lights_are_as_before(name: str, town: str, fault: str) -> None:
    """Lights that another client had stopped stay so."""
    with (
        StandInProcess([OWN_MAPS], town, *(["--fault", fault] if fault else [])) as server,
        scenarios_of_file(GENERATED / "capabilities" / f"{name}.py", f"contact_{name}") as found,
    ):
        before = server.ask("stand_in_surroundings")
        for scenario in found.values():
            run_scenario(scenario, in_carla(RunSettings(max_time=12.0), server.port))
        called = {name for name, _ in server.calls()}
        assert called & {"set_weather_parameters", "freeze_all_traffic_lights"}
        weather, lights = server.ask("stand_in_surroundings")
    assert weather == pytest.approx(before[0], abs=1e-3)
    assert [frozen for _, frozen in lights] == [frozen for _, frozen in before[1]]


def test_the_level_is_loaded_anew() -> None:
    """Its weather, its lights and who is there are then those that it begins with."""
    with StandInProcess([OWN_MAPS], "highway") as server:
        script = """
            world.set_weather(carla.WeatherParameters.HardRainSunset)
            blueprint = world.get_blueprint_library().find("vehicle.audi.tt")
            world.spawn_actor(blueprint, world.get_map().get_spawn_points()[40])
            print("there", flush=True)
        """
        client_of(server.port, script).wait()
        before = server.ask("stand_in_surroundings")[0]
        server.calls()
        run(in_carla(RunSettings(max_time=0.5), server.port, carla_load=False, carla_reload=True))
        names = [name for name, _ in server.calls()]
        assert names.count("load_new_episode") == 1
        assert names.index("load_new_episode") < names.index("spawn_actor")
        assert server.ask("stand_in_actors") == {}
        assert server.ask("stand_in_surroundings")[0] == pytest.approx(before, abs=1e-3)


# --- large levels ----------------------------------------------------------------------------


def test_actors_that_a_large_level_does_not_stream() -> None:
    """Without a camera or a `hero` near them they would stand still, and nobody would know why."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "large-level") as server:
        said = message_of(in_carla(RunSettings(), server.port))
        assert "ego is dormant in CARLA" in said and "--carla-view ego" in said
        assert run(in_carla(RunSettings(), server.port, carla_view="ego")).status == "success"


def test_actors_that_leave_what_a_large_level_streams() -> None:
    """They are found out in the step in which they fall asleep, whatever they did before."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "large-level") as server:
        script = """
            place = carla.Transform(carla.Location(200.0, 9.0, 5.0))
            world.get_spectator().set_transform(place)
            world.wait_for_tick()
            print("there", flush=True)
        """
        client_of(server.port, script).wait()
        server.calls()
        assert "is dormant in CARLA" in message_of(in_carla(RunSettings(), server.port))
        steps = [name for name, _ in server.calls()].count("tick_cue")
    assert 60 < steps < 140  # 100 m at 19 to 26 m/s


# --- speeds at the start ---------------------------------------------------------------------


@pytest.mark.parametrize("control", ["driven", "external"])
def test_actors_start_at_their_speed(control: str) -> None:
    """A speed that is given once sags; given for half a second it stays.

    An external actor is given it before the run, and is where it starts all the same.
    """
    with StandInProcess([OWN_MAPS], "highway", "--fault", "sagging") as server:
        settings = RunSettings(expect=True, max_time=1.0)
        found = states(run(in_carla(settings, server.port, control={"ego": control})), "ego")
    assert (found[0]["x"], found[0]["y"]) == pytest.approx((200.0, -8.75), abs=0.01)
    settled = [each["v"] for each in found[6:]]  # 0.3 s
    assert settled == pytest.approx([found[0]["v"]] * len(settled), abs=0.5)


# --- heights ---------------------------------------------------------------------------------


def test_a_mesh_that_is_not_where_the_lanes_are() -> None:
    """Exact actors are where the scenario says; the run says that they float."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "sunk-mesh") as server:
        said = run(in_carla(RunSettings(max_time=0.5), server.port)).warnings
        driven = in_carla(RunSettings(max_time=0.5), server.port, control={"": "driven"})
        assert not [each for each in run(driven).warnings if "ground of CARLA" in each]
    assert "ego floats: the ground of CARLA is 0.50 m below the lane where it starts" in said, said


def test_a_mesh_that_rises_above_the_lanes() -> None:
    """Who falls on its feet is spawned higher, unless somebody stands there."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "rising-mesh") as server:
        settings = in_carla(RunSettings(max_time=0.5), server.port, control={"": "driven"})
        assert run(settings).status == "timeout"
        heights = [pose[0][2] for name, (_, pose, *_) in spawns(server)]
    assert heights == pytest.approx([0.3, 0.6, 0.3, 0.6], abs=1e-3)


def spawns(server: StandInProcess) -> list[tuple[str, list[Any]]]:
    return [(name, given) for name, given in server.calls() if name == "spawn_actor"]

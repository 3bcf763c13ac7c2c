"""What keeps a first run from beginning: each has a message that names the remedy.

The behaviour of the server is that of CARLA's sources (`LibCarla/source/carla/client/detail`) and
of its issue threads; the stand-in shows it.
"""

from __future__ import annotations

import socket
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from osc2tx.module_loading import scenarios_of_file
from osc2tx_runtime import RunSettings, run_scenario
from osc2tx_runtime.errors import InputError, SimulatorError
from osc2tx_runtime.simulators.carla import level
from osc2tx_runtime.simulators.carla.client_process import ClientProcess

from .conftest import OWN_MAPS
from .contact import client_of, message_of, run
from .runs import GENERATED, in_carla
from .stand_in.process import StandInProcess


@pytest.fixture
def server() -> Iterator[StandInProcess]:
    with StandInProcess([OWN_MAPS], "highway") as process:
        yield process


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
    assert "no CARLA server responds within 1 s" in said


def test_the_port_of_the_streams_is_closed() -> None:
    """`docker run -p 2000:2000`: calls are answered, and no snapshot arrives."""
    with StandInProcess([OWN_MAPS], "highway", "--no-streams") as server:
        said = message_of(in_carla(RunSettings(), server.port, carla_timeout=2.0))
        assert f"nothing responds at 127.0.0.1:{server.port + 1}" in said
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
    assert "no client ticks it" in said and "--carla-reset" in said
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

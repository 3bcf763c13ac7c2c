"""`osc2tx world check carla`: each line says so when the server is broken in its way."""

from __future__ import annotations

import json
import os
import shutil
import socket
import stat
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from .conftest import OWN_MAPS
from .runs import REPOSITORY
from .stand_in.process import StandInProcess

CUT_IN = REPOSITORY / "scenarios" / "cut_in.osc"
LINES = 23
COMMAND = (sys.executable, "-m", "osc2tx", "world", "check", "carla")


def checked(
    port: int, *options: str, code: int = 0, env: dict[str, str] | None = None
) -> dict[int, dict[str, Any]]:
    """Return the lines of a check by number."""
    given = ["--carla", f"127.0.0.1:{port}", "--output-format", "json", *options]
    ended = subprocess.run(
        [*COMMAND, *given],
        capture_output=True,
        text=True,
        cwd=REPOSITORY,
        env={**os.environ, **(env or {})},
    )
    assert ended.returncode == code, ended.stderr + ended.stdout
    rows = json.loads(ended.stdout)
    assert [row["number"] for row in rows] == list(range(1, LINES + 1))
    return {row["number"]: row for row in rows}


def broken(port: int, number: int, *options: str, **more: Any) -> str:
    """Return what the broken line says; those before it are fine."""
    rows = checked(port, *options, **more)
    row = rows[number]
    assert row["status"] == "differs", row
    assert all(rows[each]["status"] != "differs" for each in range(1, number)), rows
    return f"{row['found']} | {row['meaning']}"


@pytest.fixture(scope="module")
def server() -> Iterator[StandInProcess]:
    """A server as it should be."""
    with StandInProcess([OWN_MAPS], "highway") as process:
        yield process


def test_a_server_as_it_should_be(server: StandInProcess) -> None:
    rows = checked(server.port, str(CUT_IN), "--drive")
    assert {number for number, row in rows.items() if row["status"] != "ok"} == {22}
    assert rows[22]["found"] == "no sensors are attached"
    assert server.ask("stand_in_actors") == {}
    assert not server.ask("stand_in_synchronous")


def test_nothing_is_changed_without_drive(server: StandInProcess) -> None:
    server.calls()
    rows = checked(server.port, str(CUT_IN))
    assert {n for n, row in rows.items() if row["found"] == "not tried"} == {
        *(7, 8, 14, 15, 16, 17, 18, 19, 23)
    }
    assert {name for name, _ in server.calls()}.isdisjoint(
        {"spawn_actor", "apply_batch", "set_episode_settings", "tick_cue"}
    )


def test_as_text(server: StandInProcess) -> None:
    ended = subprocess.run(
        [*COMMAND, "--carla", f"127.0.0.1:{server.port}"],
        capture_output=True,
        text=True,
    )
    assert ended.returncode == 0
    assert " 3 ok       server: CARLA 0.9.16\n" in ended.stdout


# --- contact ---------------------------------------------------------------------------------


def test_1_without_the_library(server: StandInProcess, tmp_path: Path) -> None:
    (tmp_path / "carla.py").write_text("raise ImportError('no', name='carla')\n")
    path = os.pathsep.join([str(tmp_path), str(REPOSITORY), str(REPOSITORY / "runtime_lib")])
    said = broken(server.port, 1, code=5, env={"PYTHONPATH": path})
    assert "pip install osc2tx-runtime[carla]" in said


def test_2_a_closed_port() -> None:
    assert "start CarlaUE4.sh" in broken(1, 2, code=5)


def test_3_another_program() -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        assert "still starting" in broken(port, 3, "--carla-timeout", "1", code=5)


def test_4_another_release() -> None:
    with StandInProcess([OWN_MAPS], "highway", "--version", "0.9.15") as server:
        said = broken(server.port, 4, code=5)
    assert "server 0.9.15, library 0.9.16" in said


def test_5_closed_streams() -> None:
    with StandInProcess([OWN_MAPS], "highway", "--no-streams") as server:
        said = broken(server.port, 5, "--carla-timeout", "2", code=5)
    assert "open or publish port" in said


STALE = """
import os, sys, carla
client = carla.Client("127.0.0.1", int(sys.argv[1])); client.set_timeout(20.0)
world = client.get_world()
settings = world.get_settings()
settings.synchronous_mode, settings.fixed_delta_seconds = True, 0.05
world.apply_settings(settings)
os._exit(0)
"""


def test_6_a_stale_synchronous_mode_is_mended(server: StandInProcess) -> None:
    subprocess.run([sys.executable, "-c", STALE, str(server.port)], check=True)
    assert "--carla-reset" in broken(server.port, 6, code=5)
    assert checked(server.port, "--fix")[6]["status"] == "ok"
    assert not server.ask("stand_in_synchronous")


# --- surroundings ------------------------------------------------------------------------------


def test_9_another_map() -> None:
    with StandInProcess([OWN_MAPS], "curve") as server:
        said = broken(server.port, 9, str(CUT_IN), code=5)
    assert "curve instead of highway" in said and "--carla-load loads it" in said


def test_11_a_level_that_is_streamed(tmp_path: Path) -> None:
    shutil.copy(OWN_MAPS / "highway.xodr", tmp_path / "Town12.xodr")
    with StandInProcess([tmp_path], "Town12") as server:
        assert "hero" in broken(server.port, 11, str(CUT_IN))


LEFT = """
import os, sys, carla
client = carla.Client("127.0.0.1", int(sys.argv[1])); client.set_timeout(20.0)
world = client.get_world()
blueprint = world.get_blueprint_library().find("vehicle.audi.tt")
blueprint.set_attribute("role_name", "ego")
world.spawn_actor(blueprint, world.get_map().get_spawn_points()[40])
os._exit(0)
"""


def test_12_an_actor_that_a_client_has_left(server: StandInProcess) -> None:
    subprocess.run([sys.executable, "-c", LEFT, str(server.port)], check=True)
    assert "ego (vehicle.audi.tt" in broken(server.port, 12, str(CUT_IN))
    subprocess.run(
        [sys.executable, "-c", LEFT.replace("[40]", "[20]"), str(server.port)], check=True
    )
    assert "since ego is there twice" in broken(server.port, 12, str(CUT_IN))
    assert checked(server.port, str(CUT_IN), "--fix")[12]["found"].startswith("removed ego")
    assert server.ask("stand_in_actors") == {}


def test_13_a_model_that_the_server_lacks(server: StandInProcess, tmp_path: Path) -> None:
    text = CUT_IN.read_text(encoding="utf-8").replace(
        "    ego: vehicle\n",
        '    ego: vehicle with:\n        keep(it.model == "vehicle.tesla.model_3")\n',
    )
    file = tmp_path / "cut_in.osc"
    file.write_text(text, encoding="utf-8")
    options = ("--dialect", "carla", "--map-path", str(OWN_MAPS))
    said = broken(server.port, 13, str(file), *options, code=5)
    assert "did you mean vehicle.tesla.model3" in said


def test_20_lights_without_ids() -> None:
    with StandInProcess([OWN_MAPS], "urban_crossing", "--fault", "nameless-lights") as server:
        assert "signals without a light" in broken(server.port, 20)


def test_20_lights_that_a_client_has_stopped() -> None:
    with StandInProcess([OWN_MAPS], "urban_crossing", "--fault", "frozen-lights") as server:
        assert "lights are frozen" in broken(server.port, 20)


def test_21_a_port_that_is_taken(server: StandInProcess) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = str(other.getsockname()[1])
        assert "--carla-tm-port" in broken(server.port, 21, "--carla-tm-port", port)


def test_22_topics_that_nobody_publishes(server: StandInProcess, tmp_path: Path) -> None:
    program = tmp_path / "ros2"
    program.write_text("#!/bin/sh\necho /rosout\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    stack = tmp_path / "stack.json"
    stack.write_text(json.dumps([{"id": "imu", "type": "sensor.other.imu"}]))
    path = os.pathsep.join([str(tmp_path), os.environ["PATH"]])
    said = broken(server.port, 22, str(CUT_IN), "--sensors", f"ego={stack}", env={"PATH": path})
    assert "missing: /carla/ego/imu" in said and "--ros2" in said


# --- motion ----------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("number", "fault", "says"),
    [
        (7, "long-steps", "steps are 0.1 s long"),
        (7, "few-substeps", "substeps cover 0.01 of 0.05 s"),
        (8, "slow", "times real time"),
        (10, "sunk-mesh", "0.50 m at most"),
        (14, "no-boxes", "0.00 m long"),
        (11, "large-level", "far from the camera are dormant"),
        (14, "no-wheels", "are at one place"),
        (14, "late-boxes", "changes after its first step"),
        (15, "loose", "20.0 mm"),
        (16, "sagging", "of 20 m/s"),
        (17, "weak", "speed within"),
        (17, "soft-brakes", "brake 0.24"),
        (18, "other-axes", "by the server"),
        (19, "late-walkers", "1.40 m in 2 s"),
        (19, "sunk-walkers", "its origin is 0.00 m above the ground"),
        (23, "sticky-camera", "not restored: camera"),
    ],
)
def test_what_has_to_be_tried(number: int, fault: str, says: str) -> None:
    with StandInProcess([OWN_MAPS], "highway", "--fault", fault) as server:
        rows = checked(server.port, str(CUT_IN), "--drive")
    assert rows[number]["status"] == "differs", rows[number]
    assert says in rows[number]["found"]


@pytest.mark.slow
def test_the_proposed_gains_are_the_remedy() -> None:
    """Brakes are half as strong as the gains of runs expect."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "soft-brakes") as server:
        proposed = checked(server.port, "--drive")[17]["meaning"].partition(" makes driven cars")[0]
        assert proposed == "--carla-gains brake=0.24"
        assert checked(server.port, "--drive", *proposed.split())[17]["status"] == "ok"


def test_every_line_is_broken_once() -> None:
    """The numbers in this file are those of all lines."""
    text = Path(__file__).read_text(encoding="utf-8")
    assert all(f"test_{n}_" in text or f"        ({n}, " in text for n in range(1, LINES + 1))

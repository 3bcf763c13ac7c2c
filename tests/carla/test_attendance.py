"""Attendance of a run: a stack that needs time, somebody at the terminal, a camera, real time."""

from __future__ import annotations

import os
import pty
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from types import SimpleNamespace

import pytest

from osc2tx_runtime import RunSettings
from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.simulators.carla import attendance
from osc2tx_runtime.simulators.carla.attendance import Attendance
from osc2tx_runtime.simulators.carla.world import OPTIONS

from .conftest import OWN_MAPS
from .contact import CLIENT, message_of, run, states
from .runs import in_carla
from .stand_in.process import StandInProcess


@pytest.fixture
def server() -> Iterator[StandInProcess]:
    with StandInProcess([OWN_MAPS], "highway") as process:
        yield process


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
    assert known["carla-gains"].read(["throttle=0.25", "brake=0.2"]) == {
        "throttle": 0.25,
        "brake": 0.2,
    }
    for name, wrong in (("carla-gains", "steering=1"), ("carla-gains", "brake=0")):
        with pytest.raises(SettingsError, match=f"--{name} {wrong}"):
            known[name].read([wrong])
    for name, wrong in (("realtime", "0"), ("realtime", "nan"), ("carla-tm-port", "0")):
        with pytest.raises(SettingsError, match=f"--{name} {wrong}"):
            known[name].read([wrong])

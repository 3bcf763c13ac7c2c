"""Servers that are not there, are others, or are lost: a message, exit code 4, nothing left."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime.errors import SimulatorError
from osc2tx_runtime.simulators.carla.client_process import ClientProcess

from .conftest import OWN_MAPS
from .runs import GENERATED, REPOSITORY
from .stand_in.process import StandInProcess

pytestmark = pytest.mark.slow

CUT_IN = GENERATED / "cut_in.py"
Until = Callable[[Callable[[], bool]], None]


@pytest.fixture
def server() -> Iterator[StandInProcess]:
    """A stand-in that may come to an end."""
    with StandInProcess([OWN_MAPS], "highway") as process:
        yield process


AS_MODULE = (str(CUT_IN),)
AS_SOURCE = ("-m", "osc2tx", "run", str(REPOSITORY / "scenarios" / "cut_in.osc"))


def module(
    port: int, trace: Path, *options: str, program: tuple[str, ...] = AS_MODULE
) -> subprocess.Popen[str]:
    """Start a generated module, or its source, in CARLA."""
    given = ["--world", "carla", "--carla", f"127.0.0.1:{port}", "--trace", str(trace), *options]
    return subprocess.Popen(
        [sys.executable, *program, "--carla-timeout", "2", *given],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=listen_to_interrupts,
    )


def listen_to_interrupts() -> None:
    """What is started in the background of a shell ignores them."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def wait_for_steps(server: StandInProcess, wait: Until, number: int = 40) -> None:
    """Wait until the run is in its middle."""
    seen: list[str] = []

    def there() -> bool:
        seen.extend(name for name, _ in server.calls())
        return seen.count("tick_cue") >= number

    wait(there)


def last_line(trace: Path) -> dict[str, Any]:
    """Return how a trace ends."""
    line: dict[str, Any] = json.loads(trace.read_text(encoding="utf-8").splitlines()[-1])
    return line


def begin_slowly(server: StandInProcess) -> Callable[[], None]:
    """Have the server stop now and then, so that a run takes its time; returns what ends that."""
    end = threading.Event()

    def brake() -> None:
        while not end.wait(0.02):
            os.kill(server.pid, signal.SIGSTOP)
            time.sleep(0.02)
            os.kill(server.pid, signal.SIGCONT)

    thread = threading.Thread(target=brake)
    thread.start()

    def stop() -> None:
        end.set()
        thread.join()

    return stop


def test_a_server_that_is_killed(server: StandInProcess, tmp_path: Path, wait: Until) -> None:
    trace = tmp_path / "trace.jsonl"
    stop = begin_slowly(server)
    run = module(server.port, trace)
    wait_for_steps(server, wait)
    stop()
    os.kill(server.pid, signal.SIGKILL)
    _, errors = run.communicate()
    assert run.returncode == 4, errors
    assert errors.count("error[OSC") == errors.count("\n") == 1
    end = last_line(trace)
    assert (end["kind"], end["status"]) == ("result", "error")
    assert end["steps"] > 30


def test_a_server_that_freezes(server: StandInProcess, tmp_path: Path, wait: Until) -> None:
    """When it wakes up again, the actors go and the settings are restored."""
    trace = tmp_path / "trace.jsonl"
    stop = begin_slowly(server)
    run = module(server.port, trace)
    wait_for_steps(server, wait)
    stop()
    os.kill(server.pid, signal.SIGSTOP)
    _, errors = run.communicate()
    assert run.returncode == 4, errors
    assert "error[OSC808]: " in errors
    assert last_line(trace)["status"] == "error"
    os.kill(server.pid, signal.SIGCONT)
    wait(lambda: server.ask("stand_in_actors") == {})
    wait(lambda: not server.ask("stand_in_synchronous"))


@pytest.mark.parametrize("program", [AS_MODULE, AS_SOURCE], ids=["module", "osc2tx run"])
def test_ctrl_c(
    server: StandInProcess, tmp_path: Path, wait: Until, program: tuple[str, ...]
) -> None:
    trace = tmp_path / "trace.jsonl"
    stop = begin_slowly(server)
    run = module(server.port, trace, program=program)
    wait_for_steps(server, wait)
    stop()
    os.kill(server.pid, signal.SIGSTOP)  # the run cannot end before the signal is there
    run.send_signal(signal.SIGINT)
    os.kill(server.pid, signal.SIGCONT)
    _, errors = run.communicate()
    assert run.returncode == 130, errors
    assert errors == "cut_in: interrupted\n"
    assert "interrupted at" in last_line(trace)["reason"]
    assert server.ask("stand_in_actors") == {}
    assert not server.ask("stand_in_synchronous")


def test_a_run_that_is_killed(server: StandInProcess, tmp_path: Path, wait: Until) -> None:
    """The process of the client library lets go of the server on its own."""
    stop = begin_slowly(server)
    run = module(server.port, tmp_path / "trace.jsonl")
    wait_for_steps(server, wait)
    run.kill()
    stop()
    run.communicate()
    wait(lambda: server.ask("stand_in_actors") == {})
    wait(lambda: not server.ask("stand_in_synchronous"))


def test_no_server(tmp_path: Path) -> None:
    run = module(1, tmp_path / "trace.jsonl")
    _, errors = run.communicate()
    assert run.returncode == 4
    assert "there is no CARLA server at 127.0.0.1:1" in errors
    assert "--carla HOST:PORT" in errors


def test_another_version() -> None:
    with StandInProcess([OWN_MAPS], "highway", "--version", "0.9.15") as old:
        run = module(old.port, Path("unused"))
        _, errors = run.communicate()
    assert run.returncode == 4
    assert "the server is CARLA 0.9.15 and the client library 0.9.16" in errors


def test_an_error_of_the_server_goes_to_who_asked(server: StandInProcess) -> None:
    client = ClientProcess(5.0)
    client.ask("connect", "127.0.0.1", server.port, 5.0)
    with pytest.raises(SimulatorError, match="map Atlantis not found"):
        client.ask("load", "Atlantis", 5.0)
    assert client.ask("level")["name"] == "highway"  # it goes on
    client.close()


def test_no_answer_is_no_hang(server: StandInProcess) -> None:
    """Even where the library waits for ever."""
    client = ClientProcess(0.2)
    client.ask("connect", "127.0.0.1", server.port, 60.0)
    os.kill(server.pid, signal.SIGSTOP)
    try:
        with pytest.raises(SimulatorError, match="does not respond any more"):
            while True:  # the signal takes a moment to stop it
                client.ask("level")
    finally:
        os.kill(server.pid, signal.SIGCONT)
    client.close()

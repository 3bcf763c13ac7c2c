"""Runs that meet a server for the first time, and other clients of it."""

from __future__ import annotations

import json
import subprocess
import sys
import textwrap

import pytest

from osc2tx.module_loading import scenarios_of_file
from osc2tx_runtime import RunResult, RunSettings, run_scenario
from osc2tx_runtime.errors import InputError, SettingsError, SimulatorError

from .runs import GENERATED

CLIENT = """
import os, sys, time
import carla

client = carla.Client("127.0.0.1", int(sys.argv[1]))
client.set_timeout(20.0)
world = client.get_world()
"""


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


def states(result: RunResult, actor: str) -> list[dict[str, float]]:
    lines = map(json.loads, result.trace_lines)
    return [each for each in lines if each["kind"] == "state" and each["actor"] == actor]

"""Processes that are started without standard output, or without standard error."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.unit.building.projects import drive

OSC2TX = f"{sys.executable} -m osc2tx"
COMMANDS = [
    "check a.osc --output-format json",
    pytest.param("run a.osc", marks=pytest.mark.slow),
]


@pytest.mark.parametrize("command", COMMANDS)
def test_closed_streams(tmp_path: Path, command: str) -> None:
    """Output that is lost is a fault; who closes standard error wants no messages."""
    drive(tmp_path / "a.osc")
    silent = _bash(tmp_path, f"{OSC2TX} {command} >&-")
    assert (silent.returncode, silent.stdout) == (4, "")
    assert silent.stderr.endswith("error: standard output cannot be written: it is closed\n")
    usual = _bash(tmp_path, f"{OSC2TX} {command}")
    deaf = _bash(tmp_path, f"{OSC2TX} {command} <&- 2>&-")
    assert (deaf.returncode, deaf.stdout) == (usual.returncode, usual.stdout)
    assert usual.stdout


@pytest.mark.parametrize("words", ["--help", "--version", "check --help"])
def test_help_for_nobody(tmp_path: Path, words: str) -> None:
    silent = _bash(tmp_path, f"{OSC2TX} {words} >&-")
    assert silent.returncode == 4
    assert silent.stderr == "error: standard output cannot be written: it is closed\n"


@pytest.mark.slow
def test_a_module_without_streams(tmp_path: Path) -> None:
    drive(tmp_path / "a.osc")
    assert _bash(tmp_path, f"{OSC2TX} build a.osc -o out").returncode == 0
    silent = _bash(tmp_path, f"{sys.executable} out/a.py >&-")
    assert silent.returncode == 4
    assert silent.stderr.endswith("error: standard output cannot be written: it is closed\n")
    assert _bash(tmp_path, f"{sys.executable} out/a.py <&- 2>&-").returncode == 0


def _bash(folder: Path, script: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        ["bash", "-c", script], cwd=folder, capture_output=True, text=True, check=False
    )

"""The how-to over the stand-in: its commands print what it shows, and its stack drives the ego."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from .conftest import OWN_MAPS
from .pictures import UNDER_TEST, stack_for
from .runs import REPOSITORY
from .stand_in.process import StandInProcess

PAGE = REPOSITORY / "docs" / "how-to" / "carla.md"
PORT = "2000"
INSTALLING = 2
"""Commands of the transcript that make the environment, which tests have."""


def transcript() -> list[tuple[list[str], list[str]]]:
    """Return the commands, each with the lines that it prints."""
    text = PAGE.read_text(encoding="utf-8").partition("```console\n")[2].partition("```")[0]
    found: list[tuple[list[str], list[str]]] = []
    for line in text.splitlines():
        if line.startswith("$ "):
            found.append((line[2:].split(), []))
        else:
            found[-1][1].append(line)
    return found


@pytest.mark.slow
def test_the_commands_print_what_the_page_shows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(REPOSITORY / "scenarios", tmp_path / "scenarios")
    maps = tmp_path / "maps"
    maps.mkdir()
    shutil.copy(OWN_MAPS / "curve.xodr", maps)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    commands = transcript()
    assert [program.rpartition("/")[2] for (program, *_), _ in commands[:INSTALLING]] == [
        "python3",
        "pip",
    ]
    with StandInProcess([maps], "curve") as server:
        for (program, *options), expected in commands[INSTALLING:]:
            assert program == ".venv/bin/osc2tx"
            ended = subprocess.run(
                [sys.executable, "-m", "osc2tx"]
                + [each.replace(PORT, str(server.port)) for each in options],
                cwd=tmp_path,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                env={**os.environ, "PYTHONUNBUFFERED": "1"},
            )
            printed = ended.stdout.replace(str(server.port), PORT).splitlines()
            assert list(map(anywhere, printed)) == list(map(anywhere, expected))
        assert (tmp_path / "cut_in.html").is_file() and (tmp_path / "cut_in.jsonl").is_file()


def anywhere(line: str) -> str:
    """Return a line without the folder of the client library."""
    return re.sub(r"(client library: [\d.]+), .*", r"\1", line)


@pytest.mark.slow
def test_the_stack_of_the_page_keeps_its_speed(tmp_path: Path) -> None:
    """It finds the ego, drives it at 70 km/h, and ends with it."""
    trace = tmp_path / "trace.jsonl"
    with StandInProcess([OWN_MAPS], "highway") as server:
        stack = subprocess.Popen([sys.executable, "-c", stack_for(server.port)])
        run = [sys.executable, "-m", "osc2tx", "run", "scenarios/cut_in.osc", "--world", "carla"]
        run += ["--carla", f"127.0.0.1:{server.port}", "--trace", str(trace), *UNDER_TEST]
        ended = subprocess.run(run, cwd=REPOSITORY, capture_output=True, text=True)
        assert ended.returncode == 0, ended.stderr
        assert stack.wait(timeout=60.0) == 0
    lines = map(json.loads, trace.read_text(encoding="utf-8").splitlines())
    speeds = [each["v"] for each in lines if each.get("actor") == "ego" and "v" in each]
    assert speeds == pytest.approx([70.0 / 3.6] * len(speeds), abs=0.5)


def test_the_page_states_the_command_of_that_run() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert f"osc2tx run scenarios/cut_in.osc --world carla {' '.join(UNDER_TEST)}" in text

"""What a terminal and a log of a CI server get: the shape of that of a harmless twin, no more."""

from __future__ import annotations

import os
import pty
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.unit.hostile.attacks import Attack, attacks
from tests.unit.hostile.shapes import assert_calm, lines_shape
from tests.unit.hostile.texts import quoted

pytestmark = pytest.mark.slow

SOURCE = """import osc.standard.all

namespace null use std, stdtypes

scenario |{name}|:
    |{name} actor|: vehicle
    |{name} wait|: string = {string}
    |{name} wait|: string
"""
TWIN = "harmless name"
COLORS = re.compile("\x1b\\[[0-9;]*m")
EACH = 12


def on_terminal(folder: Path, *arguments: str) -> str:
    """Return what a terminal gets of a command: standard output and standard error together."""
    beginning, end = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "osc2tx", *arguments],
        stdin=end,
        stdout=end,
        stderr=end,
        cwd=folder,
        env={**os.environ, "TERM": "xterm-256color", "COLUMNS": "100"},
    )
    os.close(end)
    chunks = []
    while chunk := _read(beginning):
        chunks.append(chunk)
    os.close(beginning)
    assert process.wait() in {0, 1, 2, 3, 4, 5}
    return b"".join(chunks).decode("utf-8").replace("\r\n", "\n")


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 65536)
    except OSError:  # Linux: nobody writes any more
        return b""


def in_log(folder: Path, *arguments: str) -> str:
    """Return what the log of a CI server gets of a command."""
    ended = subprocess.run(
        [sys.executable, "-m", "osc2tx", *arguments, "--output-format", "github"],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        cwd=folder,
        check=False,
    )
    assert ended.returncode in {0, 1, 2, 3, 4, 5}, ended.stdout
    return ended.stdout


def write(folder: Path, attack: Attack) -> Path:
    text = SOURCE.format(name=attack.text, string=quoted(attack.text))
    path = folder / "source.osc"
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    return path


def controls(text: str) -> list[str]:
    """The sequences that steer a terminal, in order: those of our colors."""
    return COLORS.findall(text)


@pytest.mark.parametrize("attack", [*attacks("scenario", 1)][:EACH], ids=str)
def test_names_in_messages(tmp_path: Path, attack: Attack) -> None:
    shown, logged = [], []
    for each in (Attack("scenario", TWIN), attack):
        write(tmp_path, each)
        shown.append(on_terminal(tmp_path, "check", "source.osc"))
        logged.append(in_log(tmp_path, "check", "source.osc"))
    harmless, hostile = shown
    assert_calm(hostile, colored=True)
    assert controls(hostile) and set(controls(hostile)) <= set(controls(harmless))
    assert lines_shape(COLORS.sub("", hostile)) == lines_shape(COLORS.sub("", harmless))
    harmless, hostile = logged
    assert_calm(hostile, commands=True)  # annotations are commands, ours
    assert [line.split(" ")[0] for line in hostile.splitlines() if line.startswith("::")] == [
        line.split(" ")[0] for line in harmless.splitlines() if line.startswith("::")
    ]


@pytest.mark.parametrize("attack", [*attacks("option", 1)][:EACH], ids=str)
def test_values_of_options(tmp_path: Path, attack: Attack) -> None:
    """A usage error, with the value in it."""
    if "\0" in attack.text:
        pytest.skip("no program can be started with it")
    write(tmp_path, Attack("scenario", TWIN))
    for arguments in (("check", "source.osc", "--std", attack.text), ("check", f"./{attack.text}")):
        assert_calm(on_terminal(tmp_path, *arguments), colored=True)
        assert_calm(in_log(tmp_path, *arguments), commands=True)

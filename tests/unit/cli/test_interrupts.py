"""Ctrl-C while the command line is loaded and works: exit code 130, and no traceback."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.unit.cli.shell import DRIVE

# Interrupts the process when it imports its `number`th module after the handler is set.
INTERRUPTED = """
import os, signal, sys

class Interrupt:
    count = 0

    def find_spec(self, name, path=None, target=None):
        if signal.getsignal(signal.SIGINT) is not signal.default_int_handler or Interrupt.count:
            Interrupt.count += 1
            if Interrupt.count == {number}:
                os.kill(os.getpid(), signal.SIGINT)
        return None

signal.signal(signal.SIGINT, signal.default_int_handler)
sys.meta_path.insert(0, Interrupt())
sys.argv[1:] = {arguments!r}
from osc2tx.start import main
main()
"""


def started(folder: Path, number: int, *arguments: str) -> subprocess.CompletedProcess[str]:
    code = INTERRUPTED.format(number=number, arguments=list(arguments))
    return subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=folder, check=False
    )


@pytest.mark.parametrize(
    "number",
    [1, *(pytest.param(n, marks=pytest.mark.slow) for n in (2, 5, 12, 30, 60, 100, 200, 300))],
)
def test_ctrl_c_while_modules_are_imported(tmp_path: Path, number: int) -> None:
    (tmp_path / "a.osc").write_text(DRIVE.format(name="top"), encoding="utf-8")
    ended = started(tmp_path, number, "run", "a.osc", "--no-cache")
    assert (ended.returncode, "Traceback" in ended.stderr) == (130, False), ended.stderr


def test_little_is_imported_before_ctrl_c_is_quiet() -> None:
    """What Python itself loads, and the signals; `typing` alone takes longer than all of it."""
    code = (
        "import sys; before = set(sys.modules); import osc2tx.start;"
        "print(*sorted(set(sys.modules) - before))"
    )
    ended = subprocess.run(
        [sys.executable, "-c", f"import __future__, re, signal; {code}"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert ended.stdout.split() == ["osc2tx", "osc2tx.start", "osc2tx.version"]

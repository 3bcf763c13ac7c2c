"""Ctrl-C while the command line is loaded and works: exit code 130, and no traceback."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import NoReturn

import pytest

from osc2tx.module_loading import scenarios_of_file
from tests.end_to_end.harness import REPOSITORY
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


# The same in a module that osc2tx made.
OF_A_MODULE = """
import os, runpy, signal, sys

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
import __main__
__main__.__file__ = sys.argv[0] = {module!r}
exec(compile(open({module!r}).read(), {module!r}, "exec"))
"""
MODULE = REPOSITORY / "generated" / "cut_in.py"


@pytest.mark.parametrize(
    "number",
    [1, *(pytest.param(n, marks=pytest.mark.slow) for n in (2, 5, 12, 30, 100, 200, 300))],
)
def test_ctrl_c_while_a_generated_module_is_loaded(number: int) -> None:
    code = OF_A_MODULE.format(number=number, module=str(MODULE))
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert ended.returncode == 130, ended.stderr
    assert "Traceback" not in ended.stderr


@pytest.mark.parametrize("text", ["import osc2tx_runtime\n", "from generated import cut_in\n"])
def test_other_programs_keep_their_ways(tmp_path: Path, text: str) -> None:
    (tmp_path / "own.py").write_text(
        f"{text}import signal\nassert signal.getsignal(2) is signal.default_int_handler\n"
    )
    program = [sys.executable, str(tmp_path / "own.py")]
    env = {**os.environ, "PYTHONPATH": str(REPOSITORY)}
    subprocess.run(program, check=True, env=env, preexec_fn=listen_to_interrupts)


def listen_to_interrupts() -> None:
    """What is started in the background of a shell ignores them."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.parametrize("place", ["choose_scenario", "make_parser", "run_scenario", "verdict"])
def test_ctrl_c_in_a_module_at_any_time(monkeypatch: pytest.MonkeyPatch, place: str) -> None:
    from osc2tx_runtime.running import main as command

    def interrupt(*_: object, **__: object) -> NoReturn:
        raise KeyboardInterrupt

    with scenarios_of_file(MODULE, "interrupted") as scenarios:
        monkeypatch.setattr(command, place, interrupt)
        assert command.main(*scenarios.values(), argv=["--max-time", "0.1"]) == 130


def test_little_is_imported_before_ctrl_c_is_quiet() -> None:
    """What Python itself loads, and the signals; `typing` alone takes longer than all of it."""
    code = (
        "import sys; before = set(sys.modules); import osc2tx.start;"
        "print(*sorted(set(sys.modules) - before))"
    )
    ended = subprocess.run(
        [sys.executable, "-c", f"import __future__, gc, re, signal; {code}"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert ended.stdout.split() == ["osc2tx", "osc2tx.start", "osc2tx.version"]

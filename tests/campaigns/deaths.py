"""Drivers in processes of their own, also such that die when they have stored so many rows."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from osc2tx.campaigns.store import Store

DIES = """
import os
import sys

from osc2tx.campaigns.store import Store
from osc2tx.start import main

left, blow = int(sys.argv.pop(1)), int(sys.argv.pop(1))
add = Store.add


def add_and_die(self, results, left_out=()):
    global left
    results = list(results)
    add(self, results[:left], left_out)
    left -= len(results)
    if left <= 0:
        os.kill(os.getpid(), blow)


Store.add = add_and_die
main()
"""


def words_of(source: Path, place: Path, samples: int) -> list[str]:
    """Return the words of a command whose two workers have few rows at once."""
    few = ["--workers", "2", "--batch", "3", "--kpi", "min_gap", "--samples", str(samples)]
    return ["campaign", "run", str(source), "--store", str(place), *few]


def drive(words: Sequence[str]) -> subprocess.CompletedProcess[str]:
    """Run a command to its end."""
    command = [sys.executable, "-m", "osc2tx", *words]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr
    return ended


def driver_that_dies(rows: int, blow: signal.Signals, words: Sequence[str]) -> None:
    """Run a command whose process gets a signal as soon as it has stored so many rows."""
    command = [sys.executable, "-c", DIES, str(rows), str(int(blow)), *words]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == (-blow if blow is signal.SIGKILL else 130), ended.stderr


def numbers(place: Path) -> set[int]:
    """Return the numbers of the rows of a store."""
    with Store(place) as store:
        return store.done()

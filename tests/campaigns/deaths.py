"""Drivers in processes of their own, also such that die when they have stored so many rows."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from osc2tx.campaigns.store import Store
from tests.campaigns.kit import TRIANGLE

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


TWO = ("--workers", "2")


def words_of(source: Path, place: Path, samples: int, workers: Sequence[str]) -> list[str]:
    """Return the words of a command whose workers have few rows at once."""
    few = ["--batch", "3", "--kpi", "min_gap", "--samples", str(samples)]
    return ["campaign", "run", str(source), "--store", str(place), *few, *workers]


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


def die_twenty_times(folder: Path, workers: Sequence[str]) -> None:
    """Run the campaign of `calm`; its driver dies after each two rows, and is started anew."""
    source = folder / "triangle.osc"
    source.write_text(TRIANGLE, encoding="utf-8")
    drive(["build", str(source), "-o", str(folder)])  # so that it is not compiled each time
    words = words_of(source.with_suffix(".py"), folder / "store", 40, workers)
    for death in range(1, 21):
        driver_that_dies(2, signal.SIGKILL, words)
        assert len(numbers(folder / "store")) == 2 * death
    assert ", 0 new: 40 success" in drive(words).stdout

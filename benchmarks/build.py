"""How fast `osc2tx build` is on a tree of many scenarios.

    python benchmarks/build.py [--files 1000] [--folder FOLDER]

Makes a tree of scenarios that differ, in folders with an imported file each, and prints how long
these take, each in a process of its own as a user would start it:

- the first build, with one process and with one for each processor;
- a build with nothing to do, and `--check` with nothing to find;
- a build after an edit of one file, and after an edit of one that a tenth of the others import;
- a build and a `--check` without what earlier builds remember (`OSC2TX_NO_CACHE`).

The ratios count; `design` is the target. Least of a few runs where a run changes nothing.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from osc2tx.building.workers import processors

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = 10
NOOP_TARGET = 50  # the first build takes so many times as long as one with nothing to do

LIBRARY = """\
import osc.standard.all

namespace null use std, stdtypes

scenario vehicle.settle_{folder}:
    v: speed = {speed}kph
    do serial:
        actor.drive(duration: 2s) with:
            speed(v)
"""
SCENARIO = """\
# Approach number {n}: the ego vehicle closes in on a slower one and passes it.
import "library.osc"
import osc.standard.all

namespace null use std, stdtypes

scenario approach_{n}:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    lead: vehicle
    v_ego: speed = {fast}kph
    # Slower than the ego vehicle
    v_lead: speed with:
        keep(it in [{slow}kph..{slower}kph])
    gap: length = {gap}m
    event close_enough is rise(lead.space_gap(reference: ego, direction: longitudinal) < gap)

    do parallel:
        lead_drives: lead.drive() with:
            lane(2, at: start)
            position({ahead}m, at: start)
            speed(v_lead)
        ego_passes: serial:
            approach: ego.drive() with:
                lane(same_as: lead, at: start)
                position(60m, behind: lead, at: start)
                speed(v_ego)
                until @close_enough
            ego.change_lane(num_of_lanes: 1, side: left)
            one_of:
                pass: ego.drive(duration: {duration}s)
                wait elapsed(9s)
            ego.settle_{folder}()
"""


def make_tree(folder: Path, files: int) -> None:
    """Write the scenarios."""
    for number in range(FOLDERS):
        place = folder / f"group_{number}"
        place.mkdir(parents=True)
        library = LIBRARY.format(folder=number, speed=50 + number)
        (place / "library.osc").write_text(library)
    for n in range(files - FOLDERS):
        text = SCENARIO.format(
            n=n,
            folder=n % FOLDERS,
            fast=90 + n % 40,
            slow=50 + n % 7,
            slower=60 + n % 9,
            gap=8 + n % 11,
            ahead=200 + n,
            duration=2 + n % 5,
        )
        (folder / f"group_{n % FOLDERS}/approach_{n}.osc").write_text(text)


class Builds:
    """Builds of one tree, timed."""

    def __init__(self, folder: Path) -> None:
        self.sources = folder / "scenarios"
        self.out = folder / "generated"
        self._environment = {
            **os.environ,
            "XDG_CACHE_HOME": str(folder / "cache"),
            "PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "runtime_lib")]),
        }
        self._environment.pop("OSC2TX_NO_CACHE", None)

    def run(self, *options: str, is_cold: bool = False) -> float:
        """Return the seconds of one build."""
        command = [sys.executable, "-m", "osc2tx", "build", str(self.sources), "-o", str(self.out)]
        environment = dict(self._environment)
        if is_cold:
            environment["OSC2TX_NO_CACHE"] = "1"
        started = time.perf_counter()
        ended = subprocess.run(
            [*command, *options], env=environment, capture_output=True, text=True, check=False
        )
        if ended.returncode:
            sys.exit(ended.stderr[-2000:])
        return time.perf_counter() - started

    def first(self, workers: int) -> float:
        """Return the seconds of a build into an empty folder, with nothing remembered."""
        shutil.rmtree(self.out, ignore_errors=True)
        shutil.rmtree(Path(self._environment["XDG_CACHE_HOME"]), ignore_errors=True)
        return self.run("-j", str(workers))

    def edit(self, name: str, old: str, new: str) -> None:
        """Change a source."""
        path = self.sources / name
        path.write_text(path.read_text().replace(old, new))


def least(build: Callable[[], float], times: int = 3) -> float:
    """Return the least of a few runs."""
    return min(build() for _ in range(times))


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--files", type=int, default=1000, help="how many scenarios, 11 at least")
    parser.add_argument("--folder", type=Path, help="where to work; an empty folder")
    arguments = parser.parse_args()
    if arguments.folder is None:
        with tempfile.TemporaryDirectory(prefix="osc2tx-benchmark-") as folder:
            measure(Path(folder), arguments.files)
    else:
        measure(arguments.folder, arguments.files)


def measure(folder: Path, files: int) -> None:
    """Build the tree in all ways."""
    builds = Builds(folder)
    make_tree(builds.sources, files)
    cores = processors()
    alone = builds.first(1)
    first = builds.first(cores) if cores > 1 else alone
    print(f"{files} scenarios, {cores} processors\n")

    def show(name: str, seconds: float, remark: str = "") -> None:
        print(f"{name:34}{seconds:9.2f} s   first / it ={first / seconds:7.1f}   {remark}")

    show("first build, -j 1", alone)
    show(f"first build, -j {cores}", first, f"-j {cores}: {alone / first:.2f} times as fast")
    noop = least(builds.run)
    show("nothing to do", noop, f"design: {NOOP_TARGET} at least")
    show("nothing to do, --check", least(lambda: builds.run("--check")))
    builds.edit("group_0/approach_0.osc", "9s", "8s")
    show("one file edited", builds.run())
    builds.edit("group_0/library.osc", "50kph", "55kph")
    show("a file that a tenth imports edited", builds.run())
    show("nothing remembered", builds.run(is_cold=True))
    show("nothing remembered, --check", builds.run("--check", is_cold=True))


if __name__ == "__main__":
    main()

"""How fast `osc2tx build` is on a tree of many scenarios.

    python benchmarks/build.py [--files 1000] [--folder FOLDER]

Makes a tree of scenarios that differ, in folders with an imported file each, and prints what
these cost, each in a process of its own as a user would start it:

- the first build, with one process and with one for each processor;
- a build with nothing to do, and `--check` with nothing to find;
- a build after an edit of one file, after a comment in a file that a tenth of the others import,
  and after an edit of a value in it that they use;
- `--check` of a copy in another folder, and `--diff-against` the commit before the edits;
- a build after one that was killed half-way;
- a build and a `--check` without what earlier builds remember (`OSC2TX_NO_CACHE`).

The ratios of processor time count; `design` is the target at 1,000 files. Least of a few runs where
a run changes nothing.
"""

import argparse
import os
import resource
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
NOOP_TARGET = 1  # percent of the first build, with nothing to do

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
        self.wall = 0.0
        self._environment = {
            **os.environ,
            "XDG_CACHE_HOME": str(folder / "cache"),
            "PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "runtime_lib")]),
        }
        self._environment.pop("OSC2TX_NO_CACHE", None)

    def run(self, *options: str, is_cold: bool = False) -> float:
        """Return the processor time of one build in seconds, with that of its processes."""
        command = [sys.executable, "-m", "osc2tx", "build", str(self.sources), "-o", str(self.out)]
        environment = dict(self._environment)
        if is_cold:
            environment["OSC2TX_NO_CACHE"] = "1"
        started, before = time.perf_counter(), _spent()
        ended = subprocess.run(
            [*command, *options], env=environment, capture_output=True, text=True, check=False
        )
        if ended.returncode:
            sys.exit(ended.stderr[-2000:])
        self.wall = time.perf_counter() - started
        return _spent() - before

    def elsewhere(self, folder: Path) -> "Builds":
        """Return a copy of the tree in another folder, with the same cache."""
        copy = Builds(folder)
        shutil.copytree(self.sources, copy.sources)
        shutil.copytree(self.out, copy.out)
        copy._environment["XDG_CACHE_HOME"] = self._environment["XDG_CACHE_HOME"]
        return copy

    def commit(self) -> None:
        """Put the sources into a repository of their own."""
        identity = ("-c", "user.name=benchmark", "-c", "user.email=benchmark@localhost")
        for arguments in (("init", "-q"), ("add", "."), (*identity, "commit", "-qm", "before")):
            subprocess.run(["git", "-C", str(self.sources), *arguments], check=True)

    def kill_half_way(self, files: int) -> None:
        """Start a first build, and end it without a word when half of the files are done."""
        shutil.rmtree(self.out, ignore_errors=True)
        cache = Path(self._environment["XDG_CACHE_HOME"])
        shutil.rmtree(cache, ignore_errors=True)
        command = [sys.executable, "-m", "osc2tx", "build", str(self.sources), "-o", str(self.out)]
        started = subprocess.Popen(command, env=self._environment, stderr=subprocess.DEVNULL)
        results = cache / "osc2tx" / "results"
        while started.poll() is None and len(list(results.glob("??/*"))) < files // 2:
            time.sleep(0.05)
        started.kill()
        started.wait()

    def first(self, workers: int) -> float:
        """Return the seconds of a build into an empty folder, with nothing remembered."""
        shutil.rmtree(self.out, ignore_errors=True)
        shutil.rmtree(Path(self._environment["XDG_CACHE_HOME"]), ignore_errors=True)
        return self.run("-j", str(workers))

    def edit(self, name: str, old: str, new: str) -> None:
        """Change a source."""
        path = self.sources / name
        path.write_text(path.read_text().replace(old, new))


def _spent() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


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
    alone, slow = builds.first(1), builds.wall
    first = builds.first(cores) if cores > 1 else alone
    faster = slow / builds.wall
    print(f"{files} scenarios, {cores} processors\n")

    def show(name: str, seconds: float, remark: str = "") -> None:
        share = 100 * seconds / first
        print(f"{name:34}{seconds:9.2f} s  {share:7.1f} % of the first   {remark}")

    show("first build, -j 1", alone)
    show(f"first build, -j {cores}", first, f"-j {cores}: {faster:.2f} times as fast")
    noop = least(builds.run)
    show("nothing to do", noop, f"design: {NOOP_TARGET} % of the first")
    show("nothing to do, --check", least(lambda: builds.run("--check")))
    builds.edit("group_0/approach_0.osc", "9s", "8s")
    show("one file edited", builds.run())
    builds.commit()
    builds.edit("group_0/library.osc", "scenario vehicle", "# Reaches a speed\nscenario vehicle")
    show("a comment in a library", builds.run(), "design: 3 % of the first")
    builds.edit("group_0/library.osc", "50kph", "55kph")
    show("a value that a tenth uses edited", builds.run())
    show("--diff-against", builds.run("--diff-against", "HEAD"), "design: 10 % of the first")
    show("a copy in another folder, --check", builds.elsewhere(folder / "copy").run("--check"))
    builds.kill_half_way(files)
    show("after one killed half-way", builds.run(), "design: 60 % of the first")
    show("nothing remembered", builds.run(is_cold=True))
    show("nothing remembered, --check", builds.run("--check", is_cold=True))


if __name__ == "__main__":
    main()

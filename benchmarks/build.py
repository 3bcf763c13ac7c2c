"""What `osc2tx build` costs in a repository of many scenarios.

    python benchmarks/build.py [--scenarios 1000] [--folder FOLDER]

Makes a repository (`repository.py`) and prints what these cost, each in a process of its own as a
user would start it:

- the first build, with one process and with one for each processor, and its memory;
- a build with nothing to do, and `--check` with nothing to find;
- a build after an edit of one scenario, after a comment in each library (the greatest), and after
  an edit of a range in a base that a quarter of the scenarios inherit;
- `--diff-against` the commit before that edit, and `--check` of a clone in another folder;
- a build after one that was killed half-way;
- a build and a `--check` without what earlier builds remember (`OSC2TX_NO_CACHE`).

The ratios of processor time count; `design` is the target at 1,000 scenarios. Least of a few runs
where a run changes nothing.
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

from repository import LIBRARIES, make_repository

from osc2tx.building.workers import processors

ROOT = Path(__file__).resolve().parents[1]
BASE = "scenarios/lib/slow_base.osc"
RANGE, OTHER_RANGE = "[10kph..60kph]", "[10kph..65kph]"  # of what a quarter inherits
SCENARIO = "scenarios/jam/queue/queue_0000.osc"


class Repository:
    """A repository with a cache of its own; its builds are timed."""

    def __init__(self, folder: Path, cache: Path) -> None:
        self.folder = folder
        self.cache = cache
        self.wall = 0.0
        self.memory = 0.0

    def run(self, *options: str, is_cold: bool = False) -> float:
        """Return the processor time of one build in seconds, with that of its processes."""
        started, before = time.perf_counter(), _spent()
        process = self._start(*options, is_cold=is_cold)
        self.memory = 0.0
        while process.poll() is None:
            self.memory = max(self.memory, _memory(process.pid))
            time.sleep(0.1)
        if process.returncode:
            sys.exit(process.stderr.read()[-2000:] if process.stderr else 1)
        self.wall = time.perf_counter() - started
        return _spent() - before

    def first(self, workers: int) -> float:
        """Return the seconds of a build into an empty folder, with nothing remembered."""
        self._forget()
        return self.run("-j", str(workers))

    def kill_half_way(self, scenarios: int) -> None:
        """Start a first build, and end it without a word when half of the files are done."""
        self._forget()
        process = self._start()
        results = self.cache / "osc2tx" / "results"
        while process.poll() is None and len(list(results.glob("??/*"))) < scenarios // 2:
            time.sleep(0.05)
        process.kill()
        process.wait()

    def commit(self) -> None:
        """Put everything into version control."""
        identity = ("-c", "user.name=benchmark", "-c", "user.email=benchmark@localhost")
        for arguments in (("init", "-q"), ("add", "."), (*identity, "commit", "-qm", "before")):
            subprocess.run(["git", "-C", str(self.folder), *arguments], check=True)

    def clone(self, folder: Path) -> "Repository":
        """Return a clone in another folder, with the same cache."""
        subprocess.run(["git", "clone", "-q", str(self.folder), str(folder)], check=True)
        return Repository(folder, self.cache)

    def edit(self, name: str, old: str, new: str) -> None:
        """Change a source."""
        path = self.folder / name
        text = path.read_text()
        assert old in text, f"{name} has no {old}"
        path.write_text(text.replace(old, new))

    def _start(self, *options: str, is_cold: bool = False) -> "subprocess.Popen[str]":
        environment = {
            **os.environ,
            "XDG_CACHE_HOME": str(self.cache),
            "PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "runtime_lib")]),
            "PYTHONPYCACHEPREFIX": str(self.cache.parent / "bytecode"),
        }
        environment.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed osc2tx is compiled
        environment.pop("OSC2TX_NO_CACHE", None)
        if is_cold:
            environment["OSC2TX_NO_CACHE"] = "1"
        return subprocess.Popen(
            [sys.executable, "-m", "osc2tx", "build", *options],
            cwd=self.folder,
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )

    def _forget(self) -> None:
        for place in (self.folder / "generated", self.cache):
            shutil.rmtree(place, ignore_errors=True)


def _spent() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _memory(process: int) -> float:
    """Return the memory of a process and its children in MB; shared pages count once."""
    try:
        children = Path(f"/proc/{process}/task/{process}/children").read_text().split()
        lines = Path(f"/proc/{process}/smaps_rollup").read_text().splitlines()
    except OSError:  # it has ended, or this is no Linux
        return 0.0
    own = next(float(line.split()[1]) for line in lines if line.startswith("Pss:")) / 1024
    return own + sum(_memory(int(child)) for child in children)


def least(build: Callable[[], float], times: int = 3) -> float:
    """Return the least of a few runs."""
    return min(build() for _ in range(times))


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--scenarios", type=int, default=1000)
    parser.add_argument("--folder", type=Path, help="where to work; an empty folder")
    arguments = parser.parse_args()
    if arguments.folder is None:
        with tempfile.TemporaryDirectory(prefix="osc2tx-benchmark-") as folder:
            measure(Path(folder), arguments.scenarios)
    else:
        measure(arguments.folder, arguments.scenarios)


def measure(folder: Path, scenarios: int) -> None:
    """Build the repository in all ways."""
    project = Repository(folder / "project", folder / "cache")
    make_repository(project.folder, scenarios)
    cores = processors()
    alone, slow, small = project.first(1), project.wall, project.memory
    first = project.first(cores) if cores > 1 else alone
    print(f"{scenarios} scenarios, {len(LIBRARIES)} libraries, {cores} processors\n")

    def show(name: str, seconds: float, remark: str = "") -> None:
        share = 100 * seconds / first
        print(f"{name:36}{seconds:9.2f} s  {share:7.1f} % of the first   {remark}", flush=True)

    show("first build, -j 1", alone, f"{small:.0f} MB")
    faster = f"{project.memory:.0f} MB, {slow / project.wall:.2f} times as fast"
    show(f"first build, -j {cores}", first, faster)
    show("nothing to do", least(project.run), "design: 1 % of the first")
    show("nothing to do, --check", least(lambda: project.run("--check")))
    project.edit(SCENARIO, "# Stop and go", "# Go and stop")
    project.edit(SCENARIO, "duration: 3s", "duration: 4s")
    show("one scenario edited", project.run())
    project.commit()
    show("a clone in another folder", project.clone(folder / "clone").run(), "design: 5 %")
    comments = {}
    for name in LIBRARIES:
        project.edit(name, "\nnamespace ", "\n# Units of the standard\nnamespace ")
        comments[project.run()] = name
    show(f"a comment in {Path(comments[max(comments)]).name}", max(comments), "design: 3 %")
    project.edit(BASE, RANGE, OTHER_RANGE)
    show("a range in a base of a quarter", project.run(), "design: 30 %")
    show("--diff-against", project.run("--diff-against", "HEAD"), "design: 10 %")
    project.kill_half_way(scenarios)
    show("after one killed half-way", project.run(), "design: 60 %")
    show("nothing remembered", project.run(is_cold=True))
    show("nothing remembered, --check", project.run("--check", is_cold=True))


if __name__ == "__main__":
    main()

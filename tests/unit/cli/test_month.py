"""A month in a repository of scenarios: edits as a team makes them, each with its expected answer.

The repository is that of `benchmarks/build.py`, with twelve scenarios. The steps build on each
other, so there is one test; its messages name the step.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from benchmarks.repository import LIBRARIES, make_repository
from osc2tx.building import workers
from osc2tx.building.jobs import Job
from osc2tx.building.results import FileResult, compile_job
from tests.processes import HANGING
from tests.unit.building.projects import contents
from tests.unit.cli.shell import Ended, Shell

SCENARIOS = 12
QUEUES = {f"jam/queue/queue_{number:04}" for number in range(SCENARIOS // 4)}
BRAKES = {f"highway/braking/brake_{number:04}" for number in range(SCENARIOS // 4)}
SIDE_FILES = (".map.json", ".coverage.json", ".report.json")


class Month:
    """The repository, what its builds do, and git."""

    def __init__(self, shell: Shell, compiled: list[str]) -> None:
        self.shell = shell
        self.folder = shell.folder
        self.compiled = compiled
        self._before: dict[str, bytes] = {}

    def osc2tx(self, *arguments: str) -> Ended:
        self.compiled.clear()
        return self.shell(*arguments)

    def build(self, *arguments: str, code: int = 0) -> tuple[set[str], set[str]]:
        """Build; return the sources that were compiled, and the committed outputs that changed."""
        before = self.outputs()
        ended = self.osc2tx("build", "-j", "1", *arguments)
        assert ended.code == code, ended.out + ended.err
        self.said = ended.out + ended.err
        after = self.outputs()
        changed = {path for path in before | after if before.get(path) != after.get(path)}
        return {name.removesuffix(".osc") for name in self.compiled}, changed

    def outputs(self) -> dict[str, bytes]:
        found = contents(self.folder / "generated") if (self.folder / "generated").exists() else {}
        return {
            path: data
            for path, data in found.items()
            if not path.startswith(".osc2tx") and not path.endswith(SIDE_FILES)
        }

    def edit(self, name: str, old: str, new: str) -> None:
        path = self.folder / name
        text = path.read_text(encoding="utf-8")
        assert old in text, f"{name}: {old}"
        path.write_text(text.replace(old, new), encoding="utf-8")

    def git(self, *arguments: str, code: int = 0) -> str:
        identity = ("-c", "user.name=month", "-c", "user.email=month@localhost")
        done = subprocess.run(
            ["git", "-C", str(self.folder), *identity, *arguments],
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == code, done.stdout + done.stderr
        return done.stdout

    def commit(self, message: str) -> None:
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", message)

    def start(self, *arguments: str) -> subprocess.Popen[str]:
        """Start a build as a process of its own."""
        return subprocess.Popen(
            [sys.executable, "-m", "osc2tx", "build", *arguments],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )


@pytest.fixture
def month(
    shell: Shell, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory
) -> Month:
    compiled: list[str] = []

    def counted(job: Job, memory: object = None, **others: object) -> FileResult:
        compiled.append(job.name)
        return compile_job(job, memory, **others)  # type: ignore[arg-type]

    monkeypatch.setattr(workers, "compile_job", counted)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
    monkeypatch.delenv("OSC2TX_NO_CACHE", raising=False)
    make_repository(shell.folder, SCENARIOS)
    month = Month(shell, compiled)
    month.git("init", "--quiet", "--initial-branch=main")
    return month


@contextmanager
def step(name: str) -> Iterator[None]:
    """Name the step in what fails."""
    try:
        yield
    except AssertionError as error:
        raise AssertionError(f"{name}: {error}") from error


def files(*names: str, ends: tuple[str, ...] = (".py", ".xosc")) -> set[str]:
    return {name + end for name in names for end in ends}


def modules(*names: str) -> set[str]:
    return files(*names, ends=(".py",))


@pytest.mark.slow
def test_a_month(month: Month) -> None:
    for play in STEPS:
        with step((play.__doc__ or play.__name__).rstrip(".")):
            play(month)


def first_build(month: Month) -> None:
    """Everything is compiled and written."""
    compiled, changed = month.build()
    assert len(compiled) == SCENARIOS + len(LIBRARIES)
    assert changed >= files(*QUEUES) | modules("lib/moves", "oem/fleet")
    month.commit("first")


def unchanged(month: Month) -> None:
    """Nothing is compiled, nothing is written, and the check agrees."""
    assert month.build() == (set(), set())
    assert month.build("--check") == (set(), set())


def comment_in_a_library(month: Month) -> None:
    """A comment in a library changes the module of the library alone."""
    month.edit("scenarios/lib/moves.osc", "# Leaves the lane", "# Soon leaves the lane")
    assert month.build() == ({"lib/moves"}, modules("lib/moves"))


def unused_declaration(month: Month) -> None:
    """A declaration that nobody uses does, too."""
    path = month.folder / "shared/oem/limits.osc"
    text = path.read_text() + "\nstruct sport_limits:\n    acceleration: acceleration = 5mpss\n"
    path.write_text(text)
    assert month.build() == ({"oem/limits"}, modules("oem/limits"))


def range_in_a_base(month: Month) -> None:
    """A range in a base changes its module, and of what inherits it the XML at most."""
    month.edit("scenarios/lib/slow_base.osc", "[5kph..60kph]", "[5kph..70kph]")
    compiled, changed = month.build()
    assert compiled == {"lib/slow_base", *QUEUES}
    assert modules("lib/slow_base") <= changed <= modules("lib/slow_base") | files(*QUEUES)
    assert not changed & modules(*QUEUES)
    month.commit("limits")


def value_of_one_scenario(month: Month) -> None:
    """A value in a scenario changes its module and its XML."""
    month.edit("scenarios/jam/queue/queue_0001.osc", "duration: 3s", "duration: 4s")
    name = "jam/queue/queue_0001"
    assert month.build() == ({name}, files(name))


def partial_build(month: Month) -> None:
    """A build of a folder writes its outputs, and says nothing of others."""
    month.edit("scenarios/jam/queue/queue_0000.osc", "duration: 3s", "duration: 4s")
    month.edit("scenarios/highway/braking/brake_0000.osc", "duration: 2s", "duration: 3s")
    name = "highway/braking/brake_0000"
    compiled, changed = month.build("scenarios/highway")
    assert (name in compiled, changed) == (True, files(name))
    assert "orphan" not in month.said and "queue" not in month.said
    assert month.build()[0] == {"jam/queue/queue_0000"}


def one_file_as_all(month: Month) -> None:
    """A check of one file finds the same imports as that of all."""
    assert month.osc2tx("check", "scenarios/highway/trucks/truck_0000.osc").code == 0
    assert month.osc2tx("check").code == 0
    month.commit("durations")


def renamed_declaration(month: Month) -> None:
    """A declaration renamed in a library alone is one error, and outputs of its users stay."""
    month.edit("scenarios/lib/moves.osc", "scenario vehicle.brake_to:", "scenario vehicle.slow_to:")
    before = month.outputs()
    _, changed = month.build(code=3)
    assert "brake_to" in month.said
    assert changed <= files("lib/moves", "lib/moves.vehicle_slow_to", "lib/moves.vehicle_brake_to")
    assert {path: before[path] for path in files(*QUEUES)}.items() <= month.outputs().items()


def renamed_with_its_users(month: Month) -> None:
    """With its users it is an edit of these."""
    for path in month.folder.glob("scenarios/*/*/*.osc"):
        path.write_text(path.read_text().replace(".brake_to(", ".slow_to("))
    compiled, changed = month.build()
    assert compiled == QUEUES | BRAKES
    assert modules(*QUEUES, *BRAKES) <= changed
    month.commit("renamed declaration")


def renamed_source(month: Month) -> None:
    """One build removes the outputs of the old name; the scenario is still called by its own."""
    month.git("mv", "scenarios/jam/queue/queue_0002.osc", "scenarios/jam/queue/long_queue.osc")
    _, changed = month.build()
    document = "jam/queue/long_queue.queue_0002.xosc"
    assert changed == files("jam/queue/queue_0002") | modules("jam/queue/long_queue") | {document}
    assert month.build("--check") == (set(), set())


def moved_folder(month: Month) -> None:
    """So it does for a folder."""
    month.git("mv", "scenarios/highway/trucks", "scenarios/trucks")
    month.build()
    assert not (month.folder / "generated/highway/trucks").exists()
    assert (month.folder / "generated/trucks/truck_0000.py").exists()


def deleted_source(month: Month) -> None:
    """And for a deleted source; a check says it first."""
    (month.folder / "scenarios/trucks/truck_0001.osc").unlink()
    month.build("--check", code=1)
    assert "trucks/truck_0001.py" in month.said
    ends = (".py", ".xosc", ".params.xosc")
    assert month.build()[1] == files("trucks/truck_0001", ends=ends)
    month.commit("moved")


def library_in_the_other_folder(month: Month) -> None:
    """A library that moves to another folder of sources keeps its name, so nothing changes."""
    (month.folder / "scenarios/oem").mkdir()
    month.git("mv", "shared/oem/limits.osc", "scenarios/oem/limits.osc")
    assert month.build()[1] == set()
    month.commit("one folder")


def error_in_one_scenario(month: Month) -> None:
    """A scenario with an error keeps no other from being built."""
    month.edit("scenarios/jam/queue/queue_0000.osc", "duration: 4s", "duration: 4kph")
    month.edit("scenarios/jam/queue/queue_0001.osc", "duration: 4s", "duration: 6s")
    _, changed = month.build(code=3)
    assert changed == files("jam/queue/queue_0001")
    month.edit("scenarios/jam/queue/queue_0000.osc", "duration: 4kph", "duration: 4s")
    assert month.build() == (set(), set())
    month.commit("one duration")


def edited_output(month: Month) -> None:
    """A module that was edited by hand is kept, said, and replaced on request."""
    module = month.folder / "generated/jam/queue/queue_0001.py"
    module.write_text(module.read_text() + "# mine\n")
    assert month.build(code=1)[1] == set()
    assert "queue_0001.py was edited by hand" in month.said.replace(": ", " ")
    assert month.build("--force")[1] == modules("jam/queue/queue_0001")


def stale_outputs_in_a_review(month: Month) -> None:
    """A pull request without its outputs fails with an annotation at each."""
    month.edit("scenarios/jam/queue/queue_0001.osc", "duration: 6s", "duration: 7s")
    month.build("--check", "--output-format", "github", code=1)
    assert "::error file=generated/jam/queue/queue_0001.py" in month.said
    month.build()
    month.commit("another duration")


def clean_merge(month: Month) -> None:
    """Branches that edit different scenarios merge, and their outputs as well."""
    month.git("switch", "--quiet", "--create", "side")
    month.edit("scenarios/jam/queue/queue_0000.osc", "duration: 4s", "duration: 2s")
    month.build()
    month.commit("side")
    month.git("switch", "--quiet", "main")
    month.edit("scenarios/jam/queue/queue_0001.osc", "duration: 7s", "duration: 8s")
    month.build()
    month.commit("main")
    month.git("merge", "--quiet", "--no-edit", "side")
    assert month.build() == (set(), set())


def conflict(month: Month) -> None:
    """Conflict markers in a source are called so; those in outputs go with the next build."""
    for branch, value in (("other", "1s"), ("main", "3s")):
        if branch == "other":
            month.git("switch", "--quiet", "--create", "other")
        else:
            month.git("switch", "--quiet", "main")
        month.edit("scenarios/jam/queue/queue_0000.osc", "duration: 2s", f"duration: {value}")
        month.build()
        month.commit(branch)
    month.git("merge", "--no-edit", "other", code=1)
    month.build(code=3)
    assert month.said.count("error[") == 1 and "a merge conflict is not resolved here" in month.said
    source = month.folder / "scenarios/jam/queue/queue_0000.osc"
    month.git("checkout", "--quiet", "--ours", str(source))
    assert b"<<<<<<<" in (month.folder / "generated/jam/queue/queue_0000.py").read_bytes()
    month.build()
    assert b"<<<<<<<" not in b"".join(month.outputs().values())
    month.commit("resolved")


def windows(month: Month) -> None:
    """A working copy with CRLF is up to date."""
    for folder in ("scenarios", "shared", "generated"):
        for path in (month.folder / folder).rglob("*"):
            if path.suffix in (".osc", ".py", ".xosc"):
                path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    month.build("--check")
    month.git("checkout", "--quiet", ".")
    assert month.build("--check") == (set(), set())


def clone(month: Month) -> None:
    """A clone in another folder compiles nothing, and only writes what is not committed."""
    place = month.folder.with_name("clone")
    subprocess.run(["git", "clone", "-q", str(month.folder), str(place)], check=True)
    copy = Month(Shell(month.shell.capsys, place), month.compiled)
    os.chdir(place)
    try:
        assert copy.build() == (set(), set())
        assert (place / "generated/lib/moves.map.json").exists()
    finally:
        os.chdir(month.folder)
        shutil.rmtree(place)


def difference_from_a_revision(month: Month) -> None:
    """The effect of an edit, without a build of what it does not concern."""
    month.edit("scenarios/lib/slow_base.osc", "[10kph..60kph]", "[10kph..50kph]")
    month.build("--diff-against", "HEAD")
    names = {line.split("/", 2)[2] for line in month.said.splitlines() if line.startswith("+++ ")}
    assert "lib/slow_base.py" in names
    assert not any(name.startswith(("highway", "trucks")) for name in names)
    assert not any("brake" in name or "truck" in name for name in month.compiled)


def affected(month: Month) -> None:
    """Which scenarios an edit can affect; a comment affects none."""
    ended = month.osc2tx("check", "--affected-since", "HEAD")
    assert "queue_0000" in ended.out and "brake" not in ended.out
    month.git("checkout", "--quiet", ".")
    month.edit("scenarios/lib/moves.osc", "# Soon leaves", "# Leaves")
    ended = month.osc2tx("graph", "--affected-since", "HEAD")
    assert ended.code == 0 and "queue" not in ended.out
    month.git("checkout", "--quiet", ".")


def old_revision(month: Month) -> None:
    """What was built before is not compiled again."""
    month.git("checkout", "--quiet", "HEAD~3")
    compiled, changed = month.build()
    assert (compiled, changed) == (set(), set())
    month.git("switch", "--quiet", "main")
    assert month.build() == (set(), set())


def killed_build(month: Month) -> None:
    """A killed build leaves every file old or new, and the next one completes it."""
    for path in sorted(month.folder.glob("scenarios/*/*/*.osc")):
        path.write_text(path.read_text().replace("position(", "position(1m + "))
    before = month.outputs()
    started = month.start("-j", "1")
    records = month.folder / "generated/.osc2tx"
    cache = Path(os.environ["XDG_CACHE_HOME"], "osc2tx/results")
    known = len(list(cache.rglob("*")))
    while started.poll() is None and len(list(cache.rglob("*"))) < known + 3:
        time.sleep(0.01)
    started.kill()
    started.communicate(timeout=HANGING)
    assert records.exists()
    left = month.outputs()
    compiled, _ = month.build()
    after = month.outputs()
    assert all(left[path] in (before.get(path), after.get(path)) for path in left)
    assert 0 < len(compiled) < SCENARIOS
    assert month.build("--check") == (set(), set())
    month.commit("positions")


def two_builds(month: Month) -> None:
    """Two builds at once: the second waits, and both succeed."""
    for path in sorted(month.folder.glob("scenarios/*/*/*.osc")):
        path.write_text(path.read_text().replace("1m + ", "2m + "))
    started = [month.start("-j", "1") for _ in range(2)]
    told = [each.communicate(timeout=HANGING)[1] for each in started]
    assert [each.returncode for each in started] == [0, 0], told
    assert sum("waiting for the build of process" in each for each in told) == 1
    assert month.build("--check") == (set(), set())
    month.commit("positions again")


def warnings_of_old(month: Month) -> None:
    """A baseline holds what is there; a new warning fails a strict check."""
    assert month.osc2tx("check", "--strict").code == 1  # bases without `do`
    month.edit("osc2tx.toml", "sources =", 'baseline = "known.json"\nsources =')
    assert month.osc2tx("check", "--write-baseline").code == 0
    assert month.osc2tx("check", "--strict").code == 0
    month.edit("scenarios/jam/queue/queue_0001.osc", "\n    do ", "\n    spare: vehicle\n    do ")
    ended = month.osc2tx("check", "--strict")
    assert ended.code == 1 and "spare" in ended.err


STEPS: tuple[Callable[[Month], None], ...] = (
    first_build,
    unchanged,
    comment_in_a_library,
    unused_declaration,
    range_in_a_base,
    value_of_one_scenario,
    partial_build,
    one_file_as_all,
    renamed_declaration,
    renamed_with_its_users,
    renamed_source,
    moved_folder,
    deleted_source,
    library_in_the_other_folder,
    error_in_one_scenario,
    edited_output,
    stale_outputs_in_a_review,
    clean_merge,
    conflict,
    windows,
    clone,
    difference_from_a_revision,
    affected,
    old_revision,
    killed_build,
    two_builds,
    warnings_of_old,
)

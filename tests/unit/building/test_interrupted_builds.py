"""A build that is killed leaves each output old or new, and the next one puts all right."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

from osc2tx.building import write as writing
from osc2tx.building.written_digests import read_digests
from tests.processes import HANGING
from tests.unit.building.projects import Project, contents

ROOT = Path(__file__).parents[3]


class Killed(BaseException):
    """The end of the process: nothing of the build runs after it."""


CALLS = ("open", "fdopen", "replace", "unlink")


class Axe:
    """Ends the build at one of its calls of the system, before or after it."""

    def __init__(self, patch: pytest.MonkeyPatch, number: int) -> None:
        self.left = number
        for name in CALLS:
            patch.setattr(writing.os, name, self._falling_on(getattr(os, name)))

    def _falling_on(self, call):  # type: ignore[no-untyped-def]
        def called(*args, **more):  # type: ignore[no-untyped-def]
            self._strike()
            result = call(*args, **more)
            self._strike()
            return result

        return called

    def _strike(self) -> None:
        self.left -= 1
        if self.left == 0:
            raise Killed


def prepared(folder: Path) -> tuple[Project, dict[str, bytes], dict[str, bytes]]:
    """Return a project with old outputs and changed sources, and its outputs before and after."""
    project = Project(folder)
    for name in ("a.osc", "b.osc", "gone.osc"):
        project.drive(name)
    project.build()
    before = contents(project.out)
    (project.sources / "gone.osc").unlink()
    project.drive("a.osc", speed=40)
    project.drive("sub/new.osc")
    other = project.copy(folder.parent / f"{folder.name}-whole")
    other.build(prune=True)
    return project, before, contents(other.out)


def assert_old_or_new(project: Project, before: dict[str, bytes], after: dict[str, bytes]) -> None:
    for name, data in contents(project.out).items():
        if name not in writing.RECORDS and not name.endswith(writing.TEMPORARY):
            assert data in (before.get(name), after.get(name)), name


def assert_heals(project: Project, after: dict[str, bytes]) -> None:
    result = project.build(prune=True)
    assert result.remaining() == ()
    assert contents(project.out) == after
    assert project.check() == []


@pytest.mark.parametrize("step", [9, pytest.param(1, marks=pytest.mark.slow)])
def test_killed_at_any_call(tmp_path: Path, step: int) -> None:
    original, before, after = prepared(tmp_path / "project")
    number = 0
    while True:
        number += step
        project = original.copy(tmp_path / f"killed-{number}")
        with pytest.MonkeyPatch.context() as patch:
            axe = Axe(patch, number)
            with suppress(Killed):
                project.build(prune=True)
        assert_old_or_new(project, before, after)
        if axe.left > 0:
            break
        # The sources change once more before the next build: its own work must not look foreign.
        moved_on = project.copy(tmp_path / f"moved-on-{number}")
        moved_on.drive("a.osc", speed=50)
        moved_on.drive("sub/new.osc", speed=50)
        assert moved_on.build(prune=True).remaining() == ()
        assert moved_on.check() == []
        assert_heals(project, after)
    assert number > 40


def test_a_partial_build_keeps_what_an_unfinished_one_wrote(tmp_path: Path) -> None:
    original, before, _ = prepared(tmp_path / "project")
    for number in range(10, 100):
        project = original.copy(tmp_path / f"killed-{number}")
        with pytest.MonkeyPatch.context() as patch, suppress(Killed):
            Axe(patch, number)
            project.build()
        now = contents(project.out)
        if len(read_digests(project.out)["a.py"].digests) == 2 and now["a.py"] != before["a.py"]:
            break
    assert (
        len(read_digests(project.out)["a.py"].digests) == 2
    )  # the new one and that of the old text
    project.build(project.sources / "b.osc")
    project.drive("a.osc", speed=50)
    assert [change.state.name for change in project.build().remaining()] == ["ORPHANED"] * 2


def command(project: Project) -> list[str]:
    paths = [str(project.sources), "-o", str(project.out)]
    return [sys.executable, "-m", "osc2tx", "build", *paths, "--target", "py", "-j", "2", "--prune"]


@pytest.mark.slow
def test_killed_for_real(tmp_path: Path) -> None:
    project = Project(tmp_path / "project")
    chance = random.Random(7)
    folders = os.pathsep.join([str(ROOT), str(ROOT / "runtime_lib")])
    environment = {**os.environ, "PYTHONPATH": folders, "OSC2TX_NO_CACHE": "1"}
    for number in range(40):
        project.drive(f"s{number}.osc")
    project.build()
    old = contents(project.out)
    for path in project.sources.iterdir():
        project.drive(path.name, speed=40)
    whole = project.copy(tmp_path / "whole")
    started = time.monotonic()
    subprocess.run(command(whole), env=environment, check=True, capture_output=True)
    length = time.monotonic() - started
    new = contents(whole.out)
    for _ in range(20):
        victim = project.copy(tmp_path / "victim")
        process = subprocess.Popen(
            command(victim), env=environment, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL
        )
        try:
            process.wait(timeout=length * chance.uniform(0.2, 1.05))
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
        process.wait()
        assert_old_or_new(victim, old, new)
        assert_heals(victim, new)
        shutil.rmtree(victim.folder)


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks for processes there")
def test_no_worker_outlives_a_killed_build(tmp_path: Path) -> None:
    project = Project(tmp_path)
    for number in range(200):
        project.drive(f"s{number}.osc")
    folders = os.pathsep.join([str(ROOT), str(ROOT / "runtime_lib")])
    process = subprocess.Popen(
        command(project),
        env={**os.environ, "PYTHONPATH": folders, "OSC2TX_NO_CACHE": "1"},
        stderr=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
    )
    workers: list[int] = []
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    while len(workers) < 2 and process.poll() is None:
        workers = [int(pid) for pid in children.read_text().split()]
        time.sleep(0.02)
    process.kill()
    process.wait()
    assert len(workers) == 2
    deadline = time.monotonic() + HANGING
    while any(is_running(pid) for pid in workers) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not any(is_running(pid) for pid in workers)


def is_running(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return False
    return state != "Z"


def processes_of(parent: int) -> list[int]:
    """Return the processes that a process started."""
    found = Path(f"/proc/{parent}/task/{parent}/children").read_text().split()
    return [int(each) for each in found]


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="processes are listed elsewhere")
def test_an_interrupted_build_keeps_what_is_done(tmp_path: Path) -> None:
    """Ctrl-C ends it with its workers, says what is kept, and the next build compiles the rest."""
    project = Project(tmp_path / "project")
    for number in range(60):
        project.drive(f"s{number:02}.osc")
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path / "cache")}
    environment.pop("OSC2TX_NO_CACHE", None)
    started = subprocess.Popen(
        command(project), env=environment, stderr=subprocess.PIPE, text=True, cwd=ROOT
    )
    results = tmp_path / "cache/osc2tx/results"
    while started.poll() is None and len(list(results.rglob("?" * 30))) < 10:
        time.sleep(0.01)
    workers = processes_of(started.pid)
    started.send_signal(signal.SIGINT)
    _, told = started.communicate(timeout=HANGING)
    assert started.returncode == 130
    kept = int(told.split("interrupted: ")[1].split()[0])
    assert 10 <= kept < 60 and "are done and kept" in told
    assert not any(Path(f"/proc/{each}").exists() for each in workers)
    ended = subprocess.run(
        command(project), env=environment, capture_output=True, text=True, check=True, cwd=ROOT
    )
    assert "60 modules" in ended.stdout


@pytest.mark.slow
def test_a_second_build_waits_for_the_first(tmp_path: Path) -> None:
    project = Project(tmp_path / "project")
    for number in range(20):
        project.drive(f"s{number:02}.osc")
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path / "cache")}
    environment.pop("OSC2TX_NO_CACHE", None)
    started = [
        subprocess.Popen(
            command(project),
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=ROOT,
        )
        for _ in range(3)
    ]
    ended = [(each.communicate(timeout=HANGING), each.returncode) for each in started]
    assert [code for _, code in ended] == [0, 0, 0]
    waited = [told for (_, told), _ in ended if "waiting for the build of process" in told]
    assert len(waited) >= 1
    assert sum("40 files written" in out for (out, _), _ in ended) == 1

"""Faults of every kind: a build leaves what is old or new, says why, and the next one heals it."""

from __future__ import annotations

import os
import resource
import shutil
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from random import Random
from types import FrameType

import pytest

from osc2tx import cli
from osc2tx.building import workers
from osc2tx.building import write as writing
from osc2tx.building.jobs import Job
from osc2tx.building.results import FileResult, compile_job
from osc2tx.building.written_digests import DIGESTS_NAME
from tests.processes import Ended, forked
from tests.unit.building.projects import Project, contents

pytestmark = pytest.mark.slow
KILLED = 9


def command(project: Project, before: Callable[[], object] = bool) -> Ended:
    """Run the command in a copy of this process."""

    def main() -> None:
        before()
        cli.main(["build", str(project.sources), "-o", str(project.out), "--target", "py", "-j1"])

    return forked(main)


@pytest.fixture(autouse=True)
def compiled_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each text in its place is compiled once: what the build does with the result is tested."""
    found: dict[tuple[Job, bytes], FileResult] = {}

    def compiled(job: Job, memory: object = None, **others: object) -> FileResult:
        key = job, job.path.read_bytes()
        if key not in found:
            found[key] = compile_job(job)
        return found[key]

    monkeypatch.setattr(workers, "compile_job", compiled)


@pytest.fixture
def changed(tmp_path: Path) -> tuple[Project, dict[str, bytes], dict[str, bytes]]:
    """A project with old outputs and changed sources; its outputs before, and as they should be."""
    project = Project(tmp_path / "project")
    project.drive("a.osc")
    project.drive("sub/b.osc")
    project.build()
    before = contents(project.out)
    project.drive("a.osc", speed=40)
    project.drive("c.osc")
    whole = project.copy(tmp_path / "victim")  # where it is compiled again and again
    whole.build()
    after = contents(whole.out)
    shutil.rmtree(whole.folder)
    return project, before, after


def assert_whole(project: Project, before: dict[str, bytes], after: dict[str, bytes]) -> None:
    """Check that each output is old or new, and that the next build puts all right."""
    for name, data in contents(project.out).items():
        if name not in writing.RECORDS and not name.endswith(writing.TEMPORARY):
            assert data in (before.get(name), after.get(name)), name
    assert command(project).code == 0
    assert contents(project.out) == after


def dies_after(calls: int) -> Callable[[], object]:
    """Return what ends the process without a word at a call of a Python function in the build."""

    def count(frame: FrameType, event: str, _: object) -> None:
        nonlocal calls
        if event != "call" or f"{os.sep}building{os.sep}" not in frame.f_code.co_filename:
            return
        calls -= 1
        if calls == 0:
            os._exit(KILLED)

    return lambda: sys.setprofile(count)


def test_killed_at_many_moments(
    tmp_path: Path, changed: tuple[Project, dict[str, bytes], dict[str, bytes]]
) -> None:
    original, before, after = changed
    moments = 0
    seen = [before]
    while True:
        project = original.copy(tmp_path / "victim")
        if command(project, dies_after(moments + 1)).code != KILLED:
            break
        moments += 1
        left = contents(project.out)
        if left not in seen or moments % 25 == 0:
            seen.append(left)
            assert_whole(project, before, after)
        shutil.rmtree(project.folder)
    assert moments >= 500 and len(seen) > 10


def test_a_disk_that_is_full(
    tmp_path: Path, changed: tuple[Project, dict[str, bytes], dict[str, bytes]]
) -> None:
    original, before, after = changed
    largest = max(map(len, after.values()))

    def most(size: int) -> Callable[[], object]:
        def limit() -> None:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        return limit

    for number in range(20):
        project = original.copy(tmp_path / "victim")
        ended = command(project, most(largest * number // 20))
        assert ended.code in (0, 4), ended.err
        assert "Traceback" not in ended.err
        assert_whole(project, before, after)
        shutil.rmtree(project.folder)


def test_a_folder_that_takes_nothing(
    tmp_path: Path, changed: tuple[Project, dict[str, bytes], dict[str, bytes]]
) -> None:
    original, before, after = changed

    def refuse(number: int, code: int) -> Callable[[], object]:
        def patch() -> None:
            real, left = os.open, [number]

            def opened(path, flags, *more):  # type: ignore[no-untyped-def]
                left[0] -= bool(flags & os.O_CREAT)
                if flags & os.O_CREAT and left[0] < 0:
                    raise OSError(code, os.strerror(code))
                return real(path, flags, *more)

            writing.os.open = opened

        return patch

    for number in range(8):
        for code in (30, 13, 5):  # read-only, not allowed, input or output
            project = original.copy(tmp_path / "victim")
            ended = command(project, refuse(number, code))
            assert ended.code in (0, 4), ended.err
            assert "Traceback" not in ended.err
            assert_whole(project, before, after)
            shutil.rmtree(project.folder)


def test_builds_at_the_same_time(
    changed: tuple[Project, dict[str, bytes], dict[str, bytes]],
) -> None:
    project, before, after = changed
    children = []
    for _ in range(8):
        child = os.fork()
        if child == 0:
            os._exit(min(command(project).code, 99))
        children.append(child)
    codes = [os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) for child in children]
    assert set(codes) <= {0, 1, 4}
    assert_whole(project, before, after)


@pytest.mark.parametrize("seed", range(60))
def test_damaged_records_and_caches(
    cache: Path, changed: tuple[Project, dict[str, bytes], dict[str, bytes]], seed: int
) -> None:
    project, before, after = changed
    random = Random(seed)
    files = [project.out / DIGESTS_NAME]
    files += sorted(path for path in cache.rglob("*") if path.is_file())
    path = files[seed % len(files)]
    kept = path.read_bytes()
    data = bytearray(kept)
    match seed % 5:
        case 0:
            del data[random.randrange(len(data)) :]
        case 1:
            for _ in range(5):
                data[random.randrange(len(data))] = random.randrange(256)
        case 2:
            data = bytearray(b"[" * 100_000)
        case 3:
            data[random.randrange(len(data)) : 0] = b"\xff\x00\x1b[2J"
        case 4:
            data = bytearray(b'{"format": 2, "digests": {"../x": ["y", "0"]}}')
    path.write_bytes(data)
    ended = command(project)
    assert ended.code in (0, 1, 2), ended.err
    assert "Traceback" not in ended.err and "\x1b" not in ended.err
    if path.is_relative_to(project.out):
        path.write_bytes(kept)
    assert_whole(project, before, after)

"""Several processes: same results, same order, and one that dies harms no other."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from osc2tx.building import workers
from osc2tx.building.jobs import Job
from osc2tx.building.results import FileResult, compile_job
from tests.unit.building.projects import Project, contents, write

if TYPE_CHECKING:
    from osc2tx.compilation.driver import Memory


@pytest.fixture
def project(tmp_path: Path) -> Project:
    project = Project(tmp_path)
    for number in range(12):
        project.drive(f"s{number:02}.osc", head="use std.stdtypes\n" if number % 3 else "")
    write(project.sources / "s05.osc", "scenario\n")
    return project


def test_results_do_not_depend_on_the_number_of_processes(project: Project) -> None:
    one = project.build(check_only=True, want_texts=True)
    os.environ["OSC2TX_NO_CACHE"] = "1"
    try:
        two = project.build(check_only=True, want_texts=True, workers=2)
    finally:
        del os.environ["OSC2TX_NO_CACHE"]
    assert [r.job.name for r in two.results] == [r.job.name for r in one.results]
    assert [[repr(d) for d in r.reports] for r in two.results] == [
        [repr(d) for d in r.reports] for r in one.results
    ]
    assert two.changes == one.changes


def deadly(job: Job, memory: Memory | None = None, **others: object) -> FileResult:
    if job.name == "s06.osc":
        os._exit(1)
    return compile_job(job, memory)


def test_a_process_that_dies_costs_one_file(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(workers, "compile_job", deadly)
    result = project.build(workers=2)
    (bug,) = result.bugs
    assert bug.startswith(f"{project.sources / 's06.osc'}: internal error: ")
    assert not (project.out / "s06.py").exists()
    assert result.modules == 3
    monkeypatch.undo()
    assert project.build().modules == 4


def test_progress_is_told(project: Project) -> None:
    from osc2tx.building.jobs import find_jobs
    from osc2tx.config import ConfigFiles, GivenOptions

    jobs = find_jobs([project.sources], GivenOptions(), ConfigFiles())
    told: list[tuple[int, int]] = []
    for number in (1, 2):
        told.clear()
        workers.compile_jobs(jobs, number, progress=lambda *numbers: told.append(numbers))
        assert told == [(done, len(jobs)) for done in range(1, len(jobs) + 1)]


def test_spawned_processes_do_the_same(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    import multiprocessing

    project.build()
    before = contents(project.out)
    monkeypatch.setattr(multiprocessing, "get_all_start_methods", lambda: ["spawn"])
    for path in project.out.rglob("*.py"):
        path.unlink()
    project.build(workers=2)
    assert contents(project.out) == before

"""Diffs against a revision: what the change of the sources did, and nothing else."""

import hashlib
import subprocess
from pathlib import Path

import pytest

import osc2tx_runtime
from osc2tx.building.compare import Comparison, compare_with
from osc2tx.compilation.inputs import InputError
from osc2tx.config import GivenOptions
from tests.unit.building.projects import Project, contents, write

MAPS = Path(osc2tx_runtime.__file__).parent / "maps"


def git(folder: Path, *arguments: str) -> str:
    identity = ["-c", "user.name=x", "-c", "user.email=x@y", "-c", "commit.gpgsign=false"]
    ended = subprocess.run(
        ["git", *identity, *arguments], cwd=folder, check=True, capture_output=True, text=True
    )
    return ended.stdout


@pytest.fixture
def project(tmp_path: Path) -> Project:
    project = Project(tmp_path / "re po")
    project.drive("a.osc")
    project.drive("sub/b c.osc", head='import "../lib.osc"\n')
    project.drive("old.osc")
    write(project.sources / "lib.osc", "global shade: int = 1\n")
    write(project.folder / "osc2tx.toml", '[scenarios.a]\nstd = "2.2"\n')
    git(project.folder, "init", "-q")
    git(project.folder, "add", ".")
    git(project.folder, "commit", "-qm", "one")
    return project


def compared(project: Project, *paths: Path, revision: str = "HEAD") -> Comparison:
    return compare_with(revision, paths or [project.sources], GivenOptions(), workers=1)


def test_without_a_change_there_is_no_difference(project: Project) -> None:
    project.build()
    write(project.out / "a.py", "edited, of no interest here")
    assert compared(project).differences == ()
    assert compared(project).problems == ()


def test_what_changed(project: Project) -> None:
    before = git(project.folder, "status", "--porcelain")
    project.drive("a.osc", speed=31)
    project.drive("new.osc")
    (project.sources / "old.osc").unlink()
    found = {d.path: (d.old is not None, d.new is not None) for d in compared(project).differences}
    assert {path: sides for path, sides in found.items() if path.endswith(".py")} == {
        "a.py": (True, True),
        "new.py": (False, True),
        "old.py": (True, False),
    }
    assert before == ""
    assert not project.out.exists()


def test_settings_of_the_revision_count_for_it(project: Project) -> None:
    write(project.folder / "osc2tx.toml", "")
    (difference,) = compared(project).differences
    assert difference.old is not None and "DSL 2.2" in difference.old
    assert difference.new is not None and "DSL 2.1" in difference.new


def test_imports_of_the_revision_count_for_it(project: Project) -> None:
    write(project.sources / "lib.osc", "global shade: int = 2\n")
    assert compared(project).differences == ()
    write(project.sources / "lib.osc", "scenario\n")
    paths = [d.path for d in compared(project).differences]
    assert paths == [f"sub/b_c.{suffix}" for suffix in ("py", "top.xosc")]


ON_A_MAP = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "own.xodr")
    ego: vehicle
    do serial:
        ego.drive(duration: 3s) with:
            lane(1, at: start)
            position(20m, at: start)
            speed(10mps)
"""


def with_a_map(project: Project, folder: str = "maps") -> Path:
    """A scenario that OpenSCENARIO XML can only express with its map, which the settings name."""
    write(project.folder / "osc2tx.toml", f'map_paths = ["{folder}"]\n')
    write(project.sources / "a.osc", ON_A_MAP)
    road = project.folder / folder / "own.xodr"
    road.parent.mkdir(exist_ok=True)
    road.write_bytes((MAPS / "highway.xodr").read_bytes())
    return road


def commit_all(project: Project) -> None:
    git(project.folder, "add", ".")
    git(project.folder, "commit", "-qm", "more")


def test_maps_of_the_revision_count_for_it(project: Project) -> None:
    road = with_a_map(project)
    commit_all(project)
    assert (compared(project).differences, compared(project).problems) == ((), ())
    road.write_bytes((MAPS / "crossing.xodr").read_bytes())
    assert {d.path for d in compared(project).differences} <= {
        "a.top.xosc",
        "a.top.xosc.report.json",
    }
    assert compared(project).differences


def test_a_map_in_git_lfs_is_that_of_the_working_copy(project: Project) -> None:
    road = with_a_map(project)
    data = road.read_bytes()
    digest = hashlib.sha256(data).hexdigest()
    road.write_text(
        f"version https://git-lfs.github.com/spec/v1\noid sha256:{digest}\nsize {len(data)}\n"
    )
    commit_all(project)
    road.write_bytes(data)
    assert (compared(project).differences, compared(project).problems) == ((), ())
    road.write_bytes(data + b"\n")
    (problem,) = compared(project).problems
    assert problem.startswith("HEAD: maps/own.xodr is in Git LFS")


def test_maps_outside_of_the_repository_are_named(project: Project) -> None:
    with_a_map(project, "../maps")
    commit_all(project)
    (problem,) = compared(project).problems
    assert problem == "HEAD: ../maps of the settings is outside of the repository and not read"


def test_warnings_that_settings_ignore_are_left_out(project: Project) -> None:
    write(project.sources / "a.osc", ON_A_MAP.partition("    do")[0])
    assert {r.code for result in compared(project).results for r in result.reports} == {"OSC510"}
    write(project.folder / "osc2tx.toml", '[files."**"]\nignore = ["OSC510"]\n')
    assert not [r for result in compared(project).results for r in result.reports]


def test_a_source_with_errors_then_is_told(project: Project) -> None:
    write(project.sources / "a.osc", "scenario\n")
    git(project.folder, "commit", "-qam", "broken")
    project.drive("a.osc")
    found = compared(project)
    assert found.problems == ("HEAD: a.osc has errors and makes nothing",)
    assert [d.old for d in found.differences] == [None] * 2


def test_a_single_file_and_a_relative_path(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    project.drive("a.osc", speed=31)
    project.drive("old.osc", speed=31)
    monkeypatch.chdir(project.sources)
    found = compared(project, Path("a.osc"))
    assert [d.path for d in found.differences] == ["a.py", "a.top.xosc"]
    assert len(compared(project, Path(".")).differences) == 4


def test_links_are_as_in_the_repository(project: Project) -> None:
    (project.sources / "linked.osc").symlink_to("a.osc")
    git(project.folder, "add", ".")
    git(project.folder, "commit", "-qm", "links")
    assert compared(project).differences == ()
    assert compared(project).problems == ()


def test_links_out_of_the_repository_are_not_read(project: Project) -> None:
    outside = project.folder.parent / "outside.osc"
    project.drive("a.osc")
    outside.write_text("scenario of_nobody:\n    do wait elapsed(1s)\n")
    (project.sources / "far.osc").symlink_to(outside)
    (project.sources / "farther.osc").symlink_to("far.osc")
    git(project.folder, "add", ".")
    git(project.folder, "commit", "-qm", "links")
    found = compared(project)
    assert [problem for problem in found.problems if "link" in problem] == [
        "HEAD: in/far.osc is a link out of the repository, which is not read",
    ]


@pytest.mark.parametrize("revision", ["nothing", "--help", "HEAD:in", "", "-q"])
def test_what_is_no_revision(project: Project, revision: str) -> None:
    with pytest.raises(InputError, match="git knows no revision"):
        compared(project, revision=revision)


def test_outside_of_a_repository(tmp_path: Path, project: Project) -> None:
    other = Project(tmp_path / "other")
    path = other.drive("a.osc")
    with pytest.raises(InputError, match="is in no git repository"):
        compared(other)
    with pytest.raises(InputError, match="is not in the repository"):
        compared(project, project.sources, path)


def test_the_repository_is_left_as_it_was(project: Project) -> None:
    project.drive("a.osc", speed=31)
    before = contents(project.folder)
    compared(project)
    assert contents(project.folder) == before


def test_what_is_known_is_not_compiled_again(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    from osc2tx.building import compare as module

    compiled: list[str] = []
    compile_jobs = module.compile_jobs

    def watched(jobs, workers, memory=None, known=(), *args):  # type: ignore[no-untyped-def]
        compiled.extend(job.name for job in jobs if job not in known)
        return compile_jobs(jobs, workers, memory, known or None, *args)

    monkeypatch.setattr(module, "compile_jobs", watched)
    assert compared(project).differences == ()
    first = list(compiled)
    assert sorted(first) == sorted(set(first))  # what both states have is compiled once
    name = min(first)
    project.drive(name, speed=77)
    compiled.clear()
    assert compared(project).differences
    assert compiled == [name]

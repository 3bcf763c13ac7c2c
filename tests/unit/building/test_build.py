"""What a build writes, and what a file that fails does to the others."""

import os
import stat

import pytest

from osc2tx import ir
from osc2tx.building import write as writing
from osc2tx.config import ConfigError, GivenOptions
from osc2tx.diagnostics import InternalCompilerError
from tests.unit.building.projects import Project, contents, listing, write

# --- outputs ---


def test_the_layout_is_mirrored(project: Project) -> None:
    project.drive("one.osc")
    project.drive("sub/two-lanes.osc")
    write(project.sources / "library.osc", "global shade: int = 1\n")
    result = project.build()
    assert (result.collisions, result.failures, result.modules) == ((), (), 2)
    assert listing(project.out) == [
        "one.map.json",
        "one.py",
        "sub/two_lanes.map.json",
        "sub/two_lanes.py",
    ]
    text = (project.out / "sub/two_lanes.py").read_text()
    assert "Made by osc2tx from sub/two-lanes.osc" in text


def test_files_and_folders_can_be_mixed(project: Project) -> None:
    project.drive("folder/a.osc")
    single = project.drive("other/b.osc")
    project.build(project.sources / "folder", single)
    assert listing(project.out) == ["a.map.json", "a.py", "b.map.json", "b.py"]


def test_what_is_current_is_not_touched(project: Project) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    project.build()
    paths = [project.out / name for name in ("a.py", "a.map.json", "b.py")]
    for path in paths:
        os.utime(path, (1, 1))
    assert project.build().written == ()
    assert [path.stat().st_mtime for path in paths] == [1, 1, 1]
    project.drive("b.osc", speed=31)
    assert project.written(project.build()) == ["b.py"]  # no line has moved
    assert [path.stat().st_mtime == 1 for path in paths] == [True, True, False]


def test_permissions_stay(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    (project.out / "a.py").chmod(0o600)
    project.drive("a.osc", speed=31)
    project.build()
    assert stat.S_IMODE((project.out / "a.py").stat().st_mode) == 0o600


def test_check_writes_nothing(project: Project) -> None:
    project.drive("a.osc")
    assert project.check() == ["a.py is missing"]
    assert not project.out.exists()
    project.build()
    assert project.check() == []


def test_settings_of_a_file_reach_the_module(project: Project) -> None:
    project.drive("a.osc")
    write(project.sources / "osc2tx.toml", '[scenarios.a]\nstd = "2.2"\none_of = "seeded"\n')
    project.build(given=GivenOptions(one_of="first"))
    text = (project.out / "a.py").read_text()
    assert "OpenSCENARIO DSL 2.2, dialect asam." in text
    assert 'one_of = "first"' in text


def test_the_folder_of_the_settings_may_be_imported_from(project: Project) -> None:
    write(project.folder / "osc2tx.toml", "")
    write(project.folder / "lib.osc", "enum paint: [red]\n")
    project.drive("a.osc", head='import "../lib.osc"\n')
    assert project.build().results[0].reports == ()


def test_wrong_settings_stop_the_build(project: Project) -> None:
    project.drive("a.osc")
    write(project.folder / "osc2tx.toml", "x = 1\n")
    with pytest.raises(ConfigError):
        project.build()


# --- failures of single files ---


def test_one_broken_file_does_not_stop_the_others(project: Project) -> None:
    project.drive("good.osc")
    write(project.sources / "bad.osc", "scenario\n")
    (project.sources / "binary.osc").write_bytes(b"\0")
    result = project.build()
    assert listing(project.out) == ["good.map.json", "good.py"]
    assert [r.is_complete for r in result.results] == [False, False, True]


def test_a_bug_that_one_file_shows_does_not_stop_the_others(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(module: ir.Module) -> None:
        if module.source == "bad.osc":
            raise InternalCompilerError("a tree without root")

    monkeypatch.setattr(ir, "verify", fail)
    bad = project.drive("bad.osc")
    project.drive("good.osc")
    assert project.build().bugs == (f"{bad}: internal error: a tree without root",)
    assert listing(project.out) == ["good.map.json", "good.py"]
    monkeypatch.undo()
    assert project.build().bugs == ()  # a bug is not remembered


def test_outputs_of_a_broken_source_stay_and_are_no_orphans(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    before = contents(project.out)
    write(project.sources / "a.osc", "scenario\n")
    result = project.build(prune=True)
    assert (result.changes, contents(project.out)) == ((), before)


def test_two_sources_of_one_output_write_neither(project: Project) -> None:
    for name in ("two-lanes.osc", "two_lanes.osc", "other.osc"):
        project.drive(name)
    (problem,) = project.build().collisions
    assert "two-lanes.osc and " in problem
    assert "make the same module; rename one of them" in problem
    assert listing(project.out) == ["other.map.json", "other.py"]


def test_a_collision_keeps_what_was_there(project: Project) -> None:
    project.drive("two-lanes.osc")
    project.build()
    before = contents(project.out)
    project.drive("two_lanes.osc")
    result = project.build(prune=True)
    assert (len(result.collisions), contents(project.out)) == (1, before)


def test_an_output_folder_that_is_a_file(project: Project) -> None:
    project.drive("a.osc")
    write(project.out, "a file")
    result = project.build()
    assert result.written == ()
    assert all("cannot be written" in failure for failure in result.failures)
    assert result.failures


def test_a_folder_in_place_of_an_output(project: Project) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    (project.out / "a.py").mkdir(parents=True)
    result = project.build(force=True)
    assert [failure.partition(": ")[0] for failure in result.failures] == [
        str(project.out / "a.py")
    ]
    assert listing(project.out) == ["b.map.json", "b.py"]


def test_no_temporary_file_is_left_when_writing_fails(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(writing.os, "replace", fail)
    project.drive("a.osc")
    (failure,) = project.build().failures
    assert failure.endswith("cannot be written: No space left on device")
    assert contents(project.out) == {}

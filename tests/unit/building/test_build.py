"""What a build writes, what it leaves alone, and what it finds out."""

import os
import stat
from pathlib import Path

import pytest

from osc2tx import ir
from osc2tx.building import build as module
from osc2tx.building import write as writing
from osc2tx.building.manifest import MANIFEST_NAME, ManifestError, read_manifest
from osc2tx.config import ConfigError, GivenOptions
from osc2tx.diagnostics import InternalCompilerError
from tests.unit.building.projects import Project, contents, listing, write


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path)


# --- outputs ---


def test_the_layout_is_mirrored(project: Project) -> None:
    project.drive("one.osc")
    project.drive("sub/two-lanes.osc")
    write(project.sources / "library.osc", "enum color: [red]\n")
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
    paths = [project.out / name for name in ("a.py", "a.map.json", "b.py", MANIFEST_NAME)]
    for path in paths:
        os.utime(path, (1, 1))
    assert project.build().written == ()
    assert [path.stat().st_mtime for path in paths] == [1, 1, 1, 1]
    project.drive("b.osc", speed=31)
    assert project.written(project.build()) == ["b.map.json", "b.py"]
    assert [path.stat().st_mtime == 1 for path in paths] == [True, True, False, False]


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
    assert "OpenSCENARIO DSL 2.2, dialect asam; `one_of` takes its first member." in text


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
    assert listing(project.out) == ["a.map.json", "b.map.json", "b.py"]


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


# --- edited, foreign, orphaned ---


def test_what_was_edited_by_hand_is_kept_without_force(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    made = (project.out / "a.py").read_text()
    (project.out / "a.py").write_text("edited")
    project.drive("b.osc")
    assert project.check() == ["a.py was edited by hand", "b.py is missing"]
    result = project.build()
    assert [change.path.name for change in result.remaining()] == ["a.py"]
    assert (project.out / "a.py").read_text() == "edited"
    assert (project.out / "b.py").exists()
    project.build(force=True)
    assert (project.out / "a.py").read_text() == made
    assert project.check() == []


def test_an_edited_output_of_a_changed_source_is_kept_too(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    (project.out / "a.py").write_text("edited")
    project.drive("a.osc", speed=31)
    project.build()
    assert (project.out / "a.py").read_text() == "edited"
    assert project.check() == ["a.py was edited by hand"]


def test_foreign_files_are_never_touched(project: Project) -> None:
    project.drive("a.osc")
    project.drive("sub/b.osc")
    for name in ("a.py", "notes.txt", "sub/other.py", "empty/x"):
        write(project.out / name, "mine")
    assert "a.py was not made by osc2tx" in project.check()
    project.build(prune=True)
    for path in project.sources.rglob("*.osc"):
        path.unlink()
    project.drive("c.osc")
    project.build(prune=True)
    mine = {name for name, data in contents(project.out).items() if data == b"mine"}
    assert mine == {"a.py", "notes.txt", "sub/other.py", "empty/x"}
    assert listing(project.out) == sorted([*mine, "c.map.json", "c.py"])


def test_orphans_are_reported_and_removed_on_request(project: Project) -> None:
    project.drive("a.osc")
    project.drive("deep/er/b.osc")
    project.build()
    (project.sources / "deep/er/b.osc").unlink()
    assert project.check() == ["deep/er/b.py is orphaned"]
    result = project.build()
    assert [change.origin for change in result.remaining()] == ["deep/er/b.osc"] * 2
    assert (project.out / "deep/er/b.py").exists()
    project.build(prune=True)
    assert listing(project.out) == ["a.map.json", "a.py"]
    assert not (project.out / "deep").exists()
    assert set(read_manifest(project.out).outputs) == {"a.map.json", "a.py"}


def test_an_edited_orphan_is_only_removed_by_force(project: Project) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    project.build()
    (project.sources / "b.osc").unlink()
    (project.out / "b.py").write_text("edited")
    project.build(prune=True)
    assert listing(project.out) == ["a.map.json", "a.py", "b.py"]
    project.build(prune=True, force=True)
    assert listing(project.out) == ["a.map.json", "a.py"]


def test_a_source_that_became_a_library_leaves_an_orphan(project: Project) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    project.build()
    write(project.sources / "b.osc", "enum color: [red]\n")
    assert project.check() == ["b.py is orphaned"]


def test_building_a_single_file_says_nothing_of_the_others(project: Project) -> None:
    single = project.drive("a.osc")
    project.drive("b.osc")
    project.build()
    assert project.build(single, prune=True).changes == ()
    assert listing(project.out) == ["a.map.json", "a.py", "b.map.json", "b.py"]
    assert set(read_manifest(project.out).outputs) == set(listing(project.out))


# --- the manifest ---


def test_without_manifest_what_is_current_is_entered_again(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    manifest = project.out / MANIFEST_NAME
    text = manifest.read_text()
    manifest.unlink()
    assert project.check() == [f"{MANIFEST_NAME} is stale"]
    assert project.build().written == ()
    assert manifest.read_text() == text
    assert project.check() == []


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "<<<<<<< HEAD\n",
        '{"format": 2, "outputs": {}}',
        '{"format": 1}',
        '{"format": 1, "outputs": []}',
        '{"format": 1, "outputs": {"a.py": 3}}',
        '{"format": 1, "outputs": {"a.py": {"source": "a.osc"}}}',
        '{"format": 1, "outputs": {}, "unfinished": 3}',
    ],
)
def test_a_damaged_manifest_stops_the_build(project: Project, text: str) -> None:
    project.drive("a.osc")
    write(project.out / MANIFEST_NAME, text)
    with pytest.raises(ManifestError, match="is damaged"):
        project.build()


@pytest.mark.parametrize(
    "path",
    ["../x", "/x", "a/../../x", "./x", "a//x", "", "..", "c:/x", "\\x", "a\\..\\..\\x", "x\0"],
)
def test_a_manifest_cannot_name_what_lies_elsewhere(project: Project, path: str) -> None:
    import json

    project.drive("a.osc")
    entry = {"source": "gone.osc", "sha256": "0" * 64}
    write(project.out / MANIFEST_NAME, json.dumps({"format": 1, "outputs": {path: entry}}))
    with pytest.raises(ManifestError):
        project.build(prune=True, force=True)


def test_a_manifest_cannot_reach_through_a_link(project: Project) -> None:
    import hashlib
    import json

    project.drive("a.osc")
    outside = write(project.folder / "elsewhere/file", "precious")
    project.out.mkdir()
    (project.out / "link").symlink_to(outside.parent)
    entry = {"source": "gone.osc", "sha256": hashlib.sha256(b"precious").hexdigest()}
    write(project.out / MANIFEST_NAME, json.dumps({"format": 1, "outputs": {"link/file": entry}}))
    project.build(prune=True, force=True)
    assert outside.read_text() == "precious"


def test_the_manifest_names_no_machine(project: Project) -> None:
    project.drive("sub/a.osc")
    project.build()
    text = (project.out / MANIFEST_NAME).read_text()
    assert str(project.folder) not in text
    assert '"sub/a.py": {"source": "sub/a.osc", "sha256": "' in text


# --- incremental ---


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the files that builds compile."""
    found: list[str] = []
    compile_jobs = module.compile_jobs

    def watched(jobs, *args):  # type: ignore[no-untyped-def]
        found.extend(job.name for job in jobs)
        return compile_jobs(jobs, *args)

    monkeypatch.setattr(module, "compile_jobs", watched)
    return found


def rebuilt(project: Project, compiled: list[str]) -> list[str]:
    compiled.clear()
    project.build()
    return sorted(compiled)


def test_only_what_changed_is_compiled(project: Project, compiled: list[str]) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    assert rebuilt(project, compiled) == ["a.osc", "b.osc"]
    assert rebuilt(project, compiled) == []
    project.drive("b.osc", speed=31)
    os.utime(project.sources / "a.osc")
    assert rebuilt(project, compiled) == ["b.osc"]


def test_the_same_time_and_size_do_not_deceive(project: Project, compiled: list[str]) -> None:
    path = project.drive("a.osc", speed=30)
    os.utime(path, (1, 1))
    project.build()
    project.drive("a.osc", speed=31)
    os.utime(path, (1, 1))
    assert rebuilt(project, compiled) == ["a.osc"]


def test_transitive_imports_count(project: Project, compiled: list[str]) -> None:
    write(project.sources / "base.osc", "enum color: [red]\n")
    write(project.sources / "lib.osc", 'import "base.osc"\n')
    project.drive("a.osc", head='import "lib.osc"\n')
    project.drive("b.osc")
    project.build()
    write(project.sources / "base.osc", "enum color: [red, blue]\n")
    assert rebuilt(project, compiled) == ["a.osc", "base.osc", "lib.osc"]
    (project.sources / "base.osc").unlink()
    assert rebuilt(project, compiled) == ["a.osc", "lib.osc"]
    write(project.sources / "base.osc", "enum color: [red]\n")
    assert rebuilt(project, compiled) == ["a.osc", "base.osc", "lib.osc"]


def test_a_file_that_would_now_be_found_first_counts(project: Project, compiled: list[str]) -> None:
    write(project.sources / "shapes.osc", "enum color: [red]\n")
    project.drive("sub/a.osc", head="import shapes\n")
    project.build()
    write(project.sources / "sub/shapes.osc", "enum paint: [red]\n")
    assert rebuilt(project, compiled) == ["sub/a.osc", "sub/shapes.osc"]


def test_a_link_that_points_elsewhere_counts(project: Project, compiled: list[str]) -> None:
    for name in ("one", "two"):
        write(project.sources / f"{name}/lib.osc", "enum color: [red]\n")
    link = project.sources / "lib.osc"
    link.symlink_to("one/lib.osc")
    project.drive("a.osc", head='import "lib.osc"\n')
    project.build()
    link.unlink()
    link.symlink_to("two/lib.osc")
    assert "a.osc" in rebuilt(project, compiled)


def test_options_count(project: Project, compiled: list[str]) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    write(project.sources / "osc2tx.toml", "")
    project.build()
    write(project.sources / "osc2tx.toml", '[scenarios.a]\none_of = "first"\n')
    assert rebuilt(project, compiled) == ["a.osc"]


def test_osc2tx_itself_counts(
    project: Project, compiled: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from osc2tx.building import memory

    project.drive("a.osc")
    project.build()
    monkeypatch.setattr(memory, "tool_stamp", lambda: "another")
    assert rebuilt(project, compiled) == ["a.osc"]


def test_outputs_that_are_gone_are_made_again(project: Project, compiled: list[str]) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    project.build()
    (project.out / "b.py").unlink()
    assert rebuilt(project, compiled) == ["b.osc"]
    assert project.check() == []


def test_a_damaged_memory_is_none(project: Project, compiled: list[str], cache: Path) -> None:
    project.drive("a.osc")
    project.build()
    for damage in (b"", b"{", b"[]", b'{"format": 1}'):
        for path in (cache / "osc2tx/builds").iterdir():
            path.write_bytes(damage)
        assert rebuilt(project, compiled) == ["a.osc"]
        assert rebuilt(project, compiled) == []


def test_the_memory_of_somebody_else_is_not_read(
    project: Project, compiled: list[str], cache: Path
) -> None:
    project.drive("a.osc")
    project.build()
    for path in (cache / "osc2tx/builds").iterdir():
        path.chmod(0o666)
    assert rebuilt(project, compiled) == ["a.osc"]


def test_without_cache_all_is_compiled(
    project: Project, compiled: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OSC2TX_NO_CACHE", "1")
    project.drive("a.osc")
    project.build()
    assert rebuilt(project, compiled) == ["a.osc"]


def test_remembered_reports_are_those_of_the_first_time(project: Project) -> None:
    from osc2tx.reported import settle_all

    library = "import osc.standard\nscenario base:\n  do serial:\n    wait @gone\n"
    write(project.sources / "lib.osc", library)
    project.drive("a.osc", head='import "lib.osc"\nuse std.stdtypes\n')
    write(project.sources / "bad.osc", "scenario top:\n  x: vehicel\n  x: int\n")
    write(project.sources / "kept.osc", "use std.stdtypes  #! allow OSC601: old\n")
    given = GivenOptions(dialect="carla")

    def reports() -> list[str]:
        results = project.build(given=given).results
        settled = settle_all(results)
        spans = [repr(d.primary) for d in settled.shown]
        entries = [repr(entry) for result in results for entry in result.scenarios]
        return [*map(repr, settled.shown), *map(repr, settled.suppressed), *spans, *entries]

    first = reports()
    assert len(first) > 8
    assert reports() == first

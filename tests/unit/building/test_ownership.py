"""Whose a file of the output folder is: edited, foreign, orphaned; the manifest that says it."""

import subprocess
from pathlib import Path

import pytest

from osc2tx.building.fingerprint import digest
from osc2tx.building.manifest import MANIFEST_NAME, ManifestError, read_manifest
from osc2tx.building.version_control import committed_objects
from osc2tx.building.written_digests import DIGESTS_NAME, render_digests
from tests.unit.building.projects import Project, contents, listing, write

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
    assert set(read_manifest(project.out).outputs) == {"a.py"}


def test_an_edited_orphan_is_only_removed_by_force(project: Project) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    project.build()
    (project.sources / "b.osc").unlink()
    (project.out / "b.py").write_text("edited")
    project.build(prune=True)
    assert listing(project.out) == ["a.map.json", "a.py", "b.map.json", "b.py"]
    project.build(prune=True, force=True)
    assert listing(project.out) == ["a.map.json", "a.py"]


@pytest.mark.parametrize("is_edited", [False, True])
def test_a_source_that_became_a_library_takes_its_outputs_with_it(
    project: Project, is_edited: bool
) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    project.build()
    write(project.sources / "b.osc", "global shade: int = 1\n")
    if is_edited:
        (project.out / "b.py").write_text("edited")
    assert project.check() == ["b.py is orphaned"]
    project.build()
    kept = ["b.map.json", "b.py"] if is_edited else []
    assert listing(project.out) == ["a.map.json", "a.py", *kept]


def test_building_a_single_file_says_nothing_of_the_others(project: Project) -> None:
    single = project.drive("a.osc")
    project.drive("b.osc")
    project.build()
    assert project.build(single, prune=True).changes == ()
    assert listing(project.out) == ["a.map.json", "a.py", "b.map.json", "b.py"]
    assert set(read_manifest(project.out).outputs) == {"a.py", "b.py"}


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
        '{"format": 3}',
        '{"format": 3, "outputs": []}',
        '{"format": 3, "outputs": {"a.osc": 3}}',
        '{"format": 3, "outputs": {"a.osc": {"a.py": "0"}}}',
        '{"format": 3, "outputs": {"a.osc": [3]}}',
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
    outputs = {"gone.osc": [path]}
    write(project.out / MANIFEST_NAME, json.dumps({"format": 3, "outputs": outputs}))
    with pytest.raises(ManifestError):
        project.build(prune=True, force=True)


def test_a_manifest_cannot_reach_through_a_link(project: Project) -> None:
    import json

    project.drive("a.osc")
    outside = write(project.folder / "elsewhere/file", "precious")
    project.out.mkdir()
    (project.out / "link").symlink_to(outside.parent)
    outputs = {"gone.osc": ["link/file"]}
    write(project.out / MANIFEST_NAME, json.dumps({"format": 3, "outputs": outputs}))
    digests = {"link/file": (digest(b"precious"),)}
    write(project.out / DIGESTS_NAME, render_digests(digests))
    project.build(prune=True, force=True)
    assert outside.read_text() == "precious"


def test_the_manifest_says_which_files_there_are_and_not_what_is_in_them(project: Project) -> None:
    project.drive("sub/a.osc")
    project.build()
    text = (project.out / MANIFEST_NAME).read_text()
    assert '    "sub/a.osc": ["a.py"]\n' in text
    assert str(project.folder) not in text
    project.drive("sub/a.osc", speed=31)
    project.build()
    assert (project.out / MANIFEST_NAME).read_text() == text


# --- what nobody has edited: known from the last build, or from version control ---


def git(folder: Path, *arguments: str) -> None:
    identity = ("-c", "user.name=test", "-c", "user.email=test@localhost")
    subprocess.run(["git", "-C", str(folder), *identity, *arguments], check=True)


def commit(project: Project) -> None:
    """Commit all that git does not ignore."""
    git(project.folder, "init", "--quiet")
    git(project.folder, "add", "--all")
    git(project.folder, "commit", "--quiet", "--message", "all")


def test_git_ignores_the_digests(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    assert (project.out / DIGESTS_NAME).exists()
    commit(project)
    assert committed_objects(project.out).keys() == {MANIFEST_NAME, "a.map.json", "a.py"}


def test_what_is_as_committed_may_be_replaced(project: Project) -> None:
    """As after a clone: nothing is known of earlier builds, and sources have moved on."""
    project.drive("a.osc")
    project.drive("gone.osc")
    project.build()
    commit(project)
    (project.out / DIGESTS_NAME).unlink()
    project.drive("a.osc", speed=31)
    (project.sources / "gone.osc").unlink()
    assert project.check() == ["a.py is stale", "gone.py is orphaned"]
    assert project.build(prune=True).remaining() == ()
    assert project.check() == []


def test_what_differs_from_the_commit_was_edited_by_hand(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    commit(project)
    (project.out / DIGESTS_NAME).unlink()
    (project.out / "a.py").write_text("edited")
    assert project.check() == ["a.py was edited by hand"]
    project.build()
    assert (project.out / "a.py").read_text() == "edited"


def test_an_edit_that_was_committed_is_stale_like_any_other_text(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    (project.out / "a.py").write_text("edited")
    commit(project)
    assert project.check() == ["a.py is stale"]


@pytest.mark.parametrize("digests", [None, "", "[]", '{"format": 1}', '{"format": 0}'])
def test_without_digests_and_commits_what_differs_is_kept(
    project: Project, digests: str | None
) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    project.build()
    (project.out / DIGESTS_NAME).unlink()
    if digests is not None:
        write(project.out / DIGESTS_NAME, digests)
    project.drive("a.osc", speed=31)
    assert project.check() == ["a.py was edited by hand"]
    project.build(force=True)
    project.drive("a.osc", speed=32)
    project.drive("b.osc", speed=32)
    assert project.check() == ["a.py is stale", "b.py is stale"]


# --- source maps: nobody commits them, and they go with their modules ---


def test_a_check_does_not_ask_for_source_maps(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    source_map = project.out / "a.map.json"
    made = source_map.read_text()
    for text in (None, "edited"):
        source_map.unlink() if text is None else source_map.write_text(text)
        assert project.check() == []
        assert project.written(project.build()) == ["a.map.json"]
        assert source_map.read_text() == made


def test_a_map_of_somebody_else_is_kept(project: Project) -> None:
    project.drive("a.osc")
    write(project.out / "a.map.json", "mine")
    assert "a.map.json was not made by osc2tx" in project.check()
    assert project.written(project.build()) == ["a.py"]
    assert (project.out / "a.map.json").read_text() == "mine"

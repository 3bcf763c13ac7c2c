"""Whose a file of the output folder is: edited, foreign, orphaned; each output names its source."""

import subprocess
from pathlib import Path

import pytest

from osc2tx.building.ownership import stated_source
from osc2tx.building.version_control import committed_objects
from osc2tx.building.written_digests import DIGESTS_NAME, Written, read_digests, render_digests
from osc2tx.config import GivenOptions
from osc2tx.support.records import digest
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


@pytest.mark.parametrize("speed", [30, 31])
@pytest.mark.parametrize("is_known", [True, False], ids=["digests", "no digests"])
def test_only_the_edited_module_is_called_edited(
    project: Project, speed: int, is_known: bool
) -> None:
    """Its source map is as osc2tx wrote it, and stays with the module that it belongs to."""
    project.drive("a.osc")
    project.build()
    module = project.out / "a.py"
    module.write_text(module.read_text() + "# mine\n")
    before = (project.out / "a.map.json").read_bytes()
    project.drive("a.osc", speed=speed)
    if not is_known:
        (project.out / DIGESTS_NAME).unlink()
    assert project.check() == ["a.py was edited by hand"]
    result = project.build()
    assert [(each.path.name, each.state.value) for each in result.changes] == [
        ("a.py", "was edited by hand")
    ]
    assert result.written == ()
    assert (project.out / "a.map.json").read_bytes() == before


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
    assert set(read_digests(project.out)) == {"a.py"}


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
    assert set(read_digests(project.out)) == {"a.py", "b.py"}


# --- outputs that nothing but themselves tells of, as after a clone or a merge ---


def forget(project: Project) -> None:
    (project.out / DIGESTS_NAME).unlink(missing_ok=True)


def test_an_output_of_a_merge_is_ours(project: Project) -> None:
    project.drive("a.osc")
    project.drive("gone.osc")
    project.build()
    forget(project)
    (project.sources / "gone.osc").unlink()
    assert project.check() == ["gone.py is orphaned"]
    result = project.build(prune=True)
    assert [each.is_untouched for each in result.remaining()] == [False, False]  # nobody can tell
    project.build(prune=True, force=True)
    assert listing(project.out) == ["a.map.json", "a.py"]


@pytest.mark.parametrize("text", ["mine", '"""Made by me from gone.osc."""\n'])
def test_what_names_no_source_is_foreign(project: Project, text: str) -> None:
    project.drive("a.osc")
    write(project.out / "gone.py", text)
    project.build(prune=True, force=True)
    assert (project.out / "gone.py").read_text() == text


@pytest.mark.parametrize("source", ["../x.osc", "/x.osc", "a/../../x.osc", "c:/x.osc"])
def test_a_source_elsewhere_is_no_reason_to_remove(project: Project, source: str) -> None:
    project.drive("a.osc")
    text = f'"""Made by osc2tx from {source}: edit the scenario, not this module."""\n'
    write(project.out / "x.py", text.replace('"""', '"""\n'))
    assert project.build(prune=True, force=True).remaining() == ()
    assert (project.out / "x.py").exists()


def test_no_output_is_looked_for_through_a_link(project: Project) -> None:
    project.drive("a.osc")
    outside = write(project.folder / "elsewhere/file.py", "precious")
    project.out.mkdir()
    (project.out / "link").symlink_to(outside.parent)
    digests = {"link/file.py": Written("link/file.osc", (digest(b"precious"),))}
    write(project.out / DIGESTS_NAME, render_digests(digests))
    project.build(prune=True, force=True)
    assert outside.read_text() == "precious"


@pytest.mark.parametrize("version", ["1.0", "1.3"])
def test_every_kind_of_output_states_its_source(project: Project, version: str) -> None:
    source = project.drive("sub/a & b.osc")
    text = source.read_text(encoding="utf-8")
    logical = text.replace("ego.drive(duration: 5s)", "ego.drive(duration: d)").replace(
        "  ego: vehicle",
        "  ego: vehicle\n  d: time with:\n    keep(it in [4s..6s])\n    cover(it, unit: s)",
    )
    source.write_text(logical, encoding="utf-8")
    given = GivenOptions(target="all", xml_version=version)
    project.build(given=given)
    made = [name for name in listing(project.out) if not name.endswith(".map.json")]
    assert len(made) >= 3, made
    for name in made:
        assert stated_source(name, (project.out / name).read_bytes()) == "sub/a & b.osc", name


def test_line_ends_of_windows_do_not_count(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    for path in (project.out / "a.py", project.sources / "a.osc"):
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    assert project.check() == []
    before = (project.out / "a.py").read_bytes()
    project.build()
    assert (project.out / "a.py").read_bytes() == before
    forget(project)
    commit(project)
    project.drive("a.osc", speed=31)
    assert project.check() == ["a.py is stale"]


def test_conflict_markers_are_called_so_and_replaced(project: Project) -> None:
    project.drive("a.osc")
    project.build()
    text = (project.out / "a.py").read_text()
    marked = text.replace(
        "\nclass", "\n<<<<<<< ours\nx = 1\n=======\nx = 2\n>>>>>>> theirs\nclass", 1
    )
    assert marked != text
    (project.out / "a.py").write_text(marked)
    assert project.check() == ["a.py has conflict markers of a merge"]
    assert project.build().remaining() == ()
    assert (project.out / "a.py").read_text() == text


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
    assert committed_objects(project.out).keys() == {"a.map.json", "a.py"}


TEMPLATES = Path(__file__).parents[3] / "templates/project"
ALL = GivenOptions(target="all")
REPORT = "a.computed.xosc.report.json"
COMPUTED = """import osc.standard

scenario computed:
  ego, other: vehicle
  do ego.drive() with:
    speed(30kph)
    until ego.speed > 2 * other.speed
"""


@pytest.fixture
def reported(project: Project) -> Project:
    """A scenario that XML cannot express, which has a report instead."""
    write(project.sources / "a.osc", COMPUTED)
    assert set(project.written(project.build(given=ALL))) == {"a.map.json", "a.py", REPORT}
    return project


def test_reports_are_not_committed(reported: Project) -> None:
    """A check in a clone, without them, is content; a build writes them."""
    (reported.folder / ".gitignore").write_bytes((TEMPLATES / "gitignore").read_bytes())
    commit(reported)
    assert committed_objects(reported.out).keys() == {"a.py"}
    for name in ("a.map.json", REPORT):
        (reported.out / name).unlink()
    assert reported.build(given=ALL, check_only=True).changes == ()
    assert reported.written(reported.build(given=ALL)) == [REPORT, "a.map.json"]


def test_reports_are_replaced_whoever_wrote_them(reported: Project) -> None:
    """There is nothing in them to keep, and version control does not say how they were."""
    (reported.out / DIGESTS_NAME).unlink()
    path = reported.out / REPORT
    path.write_text(path.read_text().replace('"written": false', '"written": true'))
    assert reported.build(given=ALL, check_only=True).changes == ()
    assert reported.written(reported.build(given=ALL)) == [REPORT]
    path.write_text("mine")
    assert reported.written(reported.build(given=ALL)) == []
    assert path.read_text() == "mine"


def test_reports_go_with_their_sources(reported: Project) -> None:
    (reported.out / DIGESTS_NAME).unlink()
    (reported.sources / "a.osc").unlink()
    reported.drive("b.osc")
    reported.build(given=ALL, prune=True)
    assert not (reported.out / REPORT).exists()


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
    edited = (project.out / "a.py").read_text() + "# edited\n"
    (project.out / "a.py").write_text(edited)
    assert project.check() == ["a.py was edited by hand"]
    project.build()
    assert (project.out / "a.py").read_text() == edited


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

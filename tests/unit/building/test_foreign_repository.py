"""Repositories of strangers: reading a revision runs nothing and writes nothing elsewhere."""

import shutil
import subprocess
from pathlib import Path

import pytest

from osc2tx.building.compare import compare_with
from osc2tx.building.version_control import committed_objects
from osc2tx.compilation.inputs import InputError
from osc2tx.config import GivenOptions
from tests.unit.building.projects import Project, contents

EVIL = b"scenario evil:\n    do wait elapsed(1s)\n"


def git(folder: Path, *arguments: str, stdin: bytes = b"") -> str:
    identity = ["-c", "user.name=x", "-c", "user.email=x@y", "-c", "commit.gpgsign=false"]
    ended = subprocess.run(
        ["git", *identity, *arguments], cwd=folder, check=True, capture_output=True, input=stdin
    )
    return ended.stdout.decode().strip()


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", "/dev/null")
    project = Project(tmp_path / "repository")
    project.drive("a.osc")
    git(project.folder, "init", "-q")
    git(project.folder, "add", ".")
    git(project.folder, "commit", "-qm", "one")
    return project


class Forge:
    """Makes revisions of trees that git itself would not write."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def blob(self, data: bytes) -> str:
        return git(self._folder, "hash-object", "-w", "--stdin", stdin=data)

    def tree(self, *entries: tuple[str, str, str]) -> str:
        data = b"".join(
            f"{mode} {name}\0".encode() + bytes.fromhex(object) for mode, name, object in entries
        )
        arguments = ("hash-object", "-t", "tree", "-w", "--stdin", "--literally")
        return git(self._folder, *arguments, stdin=data)

    def revision(self, *entries: tuple[str, str, str]) -> str:
        return git(self._folder, "commit-tree", self.tree(*entries), "-m", "forged")


def compare(project: Project, revision: str) -> tuple[str, ...]:
    return compare_with(revision, [project.sources], GivenOptions(), workers=1).problems


@pytest.mark.parametrize("name", ["..", ".", ".git", ".GIT"])
def test_names_that_lead_elsewhere_are_refused(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    (tmp_path / "temporary").mkdir()
    forge = Forge(project.folder)
    inner = forge.tree(("100644", "evil.osc", forge.blob(EVIL)))
    revision = forge.revision(("40000", "in", forge.tree(("40000", name, inner))))
    before = contents(tmp_path)
    with pytest.raises(InputError, match="is no name that git would check out"):
        compare(project, revision)
    assert contents(tmp_path) == before


@pytest.mark.parametrize("is_link_first", [True, False])
def test_nothing_is_written_through_a_link(
    project: Project, tmp_path: Path, is_link_first: bool
) -> None:
    victim = tmp_path / "victim"
    victim.mkdir()
    forge = Forge(project.folder)
    link = ("120000", "x.osc", forge.blob(str(victim).encode()))
    folder = ("40000", "x.osc", forge.tree(("100644", "evil.osc", forge.blob(EVIL))))
    pair = (link, folder) if is_link_first else (folder, link)
    problems = compare(project, forge.revision(("40000", "in", forge.tree(*pair))))
    assert any("is a link out of the repository" in problem for problem in problems)
    assert list(victim.iterdir()) == []


def test_a_link_inside_and_a_folder_of_one_name_are_refused(project: Project) -> None:
    forge = Forge(project.folder)
    evil = ("100644", "evil.osc", forge.blob(EVIL))
    link, folder = ("120000", "x.osc", forge.blob(b".")), ("40000", "x.osc", forge.tree(evil))
    with pytest.raises(InputError, match="is there twice"):
        compare(project, forge.revision(link, folder))


def test_two_files_of_one_name_are_refused(project: Project) -> None:
    forge = Forge(project.folder)
    one, two = (("100644", "x.osc", forge.blob(EVIL + each)) for each in (b"", b"\n"))
    with pytest.raises(InputError, match="is there twice"):
        compare(project, forge.revision(one, two))


def test_a_missing_blob_is_named(project: Project) -> None:
    blob = git(project.folder, "rev-parse", "HEAD:in/a.osc")
    Path(project.folder, ".git/objects", blob[:2], blob[2:]).unlink()
    with pytest.raises(InputError, match=r"in/a\.osc: the repository has no contents"):
        compare(project, "HEAD")


def settings_that_run(project: Project, mark: Path) -> None:
    """Let every kind of setting that runs a command make a file."""
    command = f"touch {mark}; false"
    hooks = project.folder / ".git/hooks"
    shutil.rmtree(hooks, ignore_errors=True)
    hooks.mkdir()
    for name in ("post-checkout", "post-index-change", "reference-transaction", "fsmonitor"):
        (hooks / name).write_text(f"#!/bin/sh\n{command}\n")
        (hooks / name).chmod(0o755)
    git(project.folder, "config", "core.repositoryformatversion", "1")
    for key, value in {
        "core.fsmonitor": str(hooks / "fsmonitor"),
        "core.pager": command,
        "core.sshCommand": command,
        "core.askPass": command,
        "diff.external": command,
        "diff.osc.textconv": command,
        "filter.osc.smudge": command,
        "filter.osc.process": command,
        "alias.ls-tree": f"!{command}",
        "alias.cat-file": f"!{command}",
        "protocol.allow": "always",
        "extensions.partialClone": "origin",
        "remote.origin.promisor": "true",
        "remote.origin.uploadpack": command,
        "core.alternateRefsCommand": command,
    }.items():
        git(project.folder, "config", key, value)
    (project.folder / ".git/info/attributes").write_text("*.osc filter=osc diff=osc\n")


@pytest.mark.parametrize("kind", ["tree", "blob"])
@pytest.mark.parametrize("address", ["{folder}", "ssh://nowhere.invalid/x", "ext::touch {mark}"])
def test_nothing_of_the_settings_runs(
    project: Project, tmp_path: Path, kind: str, address: str
) -> None:
    mark = tmp_path / "ran"
    name = git(project.folder, "rev-parse", {"tree": "HEAD:in", "blob": "HEAD:in/a.osc"}[kind])
    Path(project.folder, ".git/objects", name[:2], name[2:]).unlink()
    url = address.format(folder=project.folder, mark=mark)
    git(project.folder, "config", "remote.origin.url", url)
    settings_that_run(project, mark)
    with pytest.raises(InputError):
        compare(project, "HEAD")
    committed_objects(project.folder)
    assert not mark.exists()


def test_a_whole_repository_with_such_settings_is_read(project: Project, tmp_path: Path) -> None:
    settings_that_run(project, tmp_path / "ran")
    assert compare(project, "HEAD") == ()
    assert "in/a.osc" in committed_objects(project.folder)
    assert not (tmp_path / "ran").exists()

"""A loss of power leaves old files or whole ones: what is put in place is on the disk before."""

import os
from pathlib import Path

import pytest

from osc2tx.building.write import RECORDS
from osc2tx.building.written_digests import DIGESTS_NAME
from tests.unit.building.test_interrupted_builds import prepared


def test_texts_are_on_the_disk_before_they_are_in_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    project, _, _ = prepared(tmp_path / "project")
    synced: list[tuple[int, int]] = []
    placed: list[str] = []
    fsync, replace = os.fsync, os.replace

    def sync(descriptor: int) -> None:
        fsync(descriptor)
        state = os.fstat(descriptor)
        synced.append((state.st_ino, state.st_size))

    def put(staged: Path, path: Path) -> None:
        state = os.stat(staged)
        if path.is_relative_to(project.out):  # the user's cache may be lost
            assert (state.st_ino, state.st_size) in synced, f"{path} is not on the disk as it is"
            placed.append(path.relative_to(project.out).as_posix())
        replace(staged, path)

    monkeypatch.setattr(os, "fsync", sync)
    monkeypatch.setattr(os, "replace", put)
    assert project.build(prune=True).remaining() == ()
    folders = {os.stat((project.out / each).parent).st_ino for each in placed}
    assert folders <= {inode for inode, _ in synced}
    assert {"a.py", "sub/new.py", DIGESTS_NAME} <= set(placed)
    # Announced before the first output changes, and said to be done after the last one.
    assert placed.index(DIGESTS_NAME) < placed.index("sub/new.py")
    assert placed[-1] in RECORDS

"""Files of another kind, characters that XML does not have, and what killed builds leave."""

from __future__ import annotations

import gzip
import os
import time
import zipfile
from pathlib import Path

import pytest
from lxml import etree

from osc2tx_shared.own_folders import FRESH, REVISION, own_folder
from tests.unit.cli.shell import DRIVE, Shell


@pytest.mark.parametrize("kind", ["zip", "gzip"])
def test_archives_are_no_inputs(shell: Shell, tmp_path: Path, kind: str) -> None:
    drive, archive = tmp_path / "drive.osc", tmp_path / "archive.osc"
    drive.write_text(DRIVE.format(name="drive"))
    if kind == "zip":
        with zipfile.ZipFile(archive, "w") as file:
            file.write(drive, "drive.osc")
    else:
        archive.write_bytes(gzip.compress(drive.read_bytes()))
    for words, code in (
        (("build", "archive.osc", "-o", "out"), 4),
        (("run", "drive.osc", "--map-path", "archive.osc"), 4),
        (("map", "archive.osc"), 4),
        (("verify", "archive.osc"), 4),
        (("report", "archive.osc", "-o", "page.html"), 4),
        (("import", "archive.osc", "-o", "in"), 4),
        (("campaign", "export", "archive.osc", "rows.csv"), 2),
    ):
        ended = shell(*words)
        assert (ended.code, "Traceback" in ended.err) == (code, False), (words, ended.err)
        assert "archive.osc" in ended.err, words


@pytest.mark.parametrize("character", ["\ufffe", "\uffff", "\x01"])
def test_characters_that_no_document_can_have(shell: Shell, tmp_path: Path, character: str) -> None:
    text = DRIVE.format(name="odd").replace(
        "  do serial", f'  note: string = "a{character}"\n  do serial'
    )
    (tmp_path / "odd.osc").write_text(f"# {character}\n{text}", encoding="utf-8")
    ended = shell("build", "odd.osc", "-o", "out")
    assert ended.code in (0, 3, 4) and "Traceback" not in ended.err
    for document in (tmp_path / "out").glob("*.xosc"):
        etree.parse(document)


def test_a_line_of_many_megabytes(shell: Shell, tmp_path: Path) -> None:
    text = DRIVE.format(name="long")
    (tmp_path / "comment.osc").write_text(f"# {'x' * 5_000_000}\n{text}")
    assert shell("check", "comment.osc").code == 0
    (tmp_path / "sum.osc").write_text(f"{text}  total: int = {'1 + ' * 200_000}1\n")
    ended = shell("check", "sum.osc")
    assert (ended.code, "OSC115" in ended.err) == (3, True)
    assert len(ended.err) < 2000


def test_a_build_removes_what_killed_ones_have_left(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "drive.osc").write_text(DRIVE.format(name="drive"))
    (tmp_path / "tmp").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "tmp"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))  # a result kept compiles nothing
    left, young = (tmp_path / "tmp" / f"{REVISION}{name}" for name in ("left", "young"))
    left.mkdir()
    young.mkdir()
    old = time.time() - 2 * FRESH
    with own_folder(REVISION) as used:
        for place in (left, used):
            os.utime(place, (old, old))
        assert shell("build", "drive.osc", "-o", "out").code == 0
        assert not left.exists()
        assert young.exists() and Path(used).exists()

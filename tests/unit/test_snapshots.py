"""Snapshots in the user's cache folder: never trusted further than they deserve."""

import marshal
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from random import Random
from typing import Any

import pytest

from osc2tx_shared.cache import Snapshots, cache_folder, snapshots

ROOT = Path(__file__).resolve().parents[2]
SAME: dict[str, Any] = {"kind": "squares 1", "code": ROOT / "osc2tx", "parts": ("syntax", "ir")}
SQUARES = Snapshots(**SAME)
INPUTS = "from 0 to 99"
DATA = [(number, number**2) for number in range(100)]


def load() -> Any:
    return SQUARES.load("squares", INPUTS)


def save() -> Path | None:
    return SQUARES.save("squares", INPUTS, DATA)


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache of the test's own, with a snapshot in it."""
    monkeypatch.delenv("OSC2TX_NO_CACHE", raising=False)
    monkeypatch.setattr(snapshots, "_STARTED", 1 << 62)  # others may be editing the code
    for name in ("XDG_CACHE_HOME", "HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path))
    folder = cache_folder()
    assert folder is not None and folder.is_relative_to(tmp_path)
    save()
    return folder


def the_file(cache: Path) -> Path:
    (path,) = cache.iterdir()
    return path


def test_a_snapshot_gives_what_was_saved() -> None:
    assert load() == DATA


@pytest.mark.parametrize("length", [0, 5, 13, 17, 18, 100, -1])
def test_a_truncated_snapshot_is_ignored(cache: Path, length: int) -> None:
    path = the_file(cache)
    path.write_bytes(path.read_bytes()[:length])
    assert load() is None


def test_a_snapshot_with_a_flipped_bit_is_ignored(cache: Path) -> None:
    path = the_file(cache)
    data = path.read_bytes()
    random = Random(7)
    for _ in range(300):
        bit = random.randrange(len(data) * 8)
        damaged = bytearray(data)
        damaged[bit // 8] ^= 1 << bit % 8
        path.write_bytes(damaged)
        assert load() is None
    path.write_bytes(data)
    assert load() == DATA


@pytest.mark.parametrize(
    "content",
    [b"", b"no marshal", marshal.dumps(3), marshal.dumps((1, 2)), marshal.dumps((1, 2, 3))],
)
def test_a_snapshot_with_other_contents_is_ignored(cache: Path, content: bytes) -> None:
    magic = the_file(cache).read_bytes().partition(b"\n")[0] + b"\n"
    the_file(cache).write_bytes(magic + snapshots._checksum(content) + content)
    assert load() is None


def test_a_snapshot_of_other_inputs_is_ignored() -> None:
    assert SQUARES.load("squares", "from 0 to 9") is None


@pytest.mark.parametrize("other", [{"kind": "squares 2"}, {"parts": ("syntax",)}], ids=str)
def test_a_snapshot_of_other_code_is_ignored(other: dict[str, Any]) -> None:
    assert Snapshots(**(SAME | other)).load("squares", INPUTS) is None


def test_a_snapshot_of_code_that_changes_is_ignored(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(snapshots, "_STARTED", 0)
    assert load() is None


posix = pytest.mark.skipif(sys.platform == "win32", reason="permissions of POSIX")


@posix
@pytest.mark.parametrize("mode", [0o777, 0o720])
def test_a_folder_that_others_may_write_to_is_not_read(cache: Path, mode: int) -> None:
    assert cache.stat().st_mode & 0o777 == 0o700
    cache.chmod(mode)
    assert load() is None
    the_file(cache).unlink()
    assert save() is None
    assert not list(cache.iterdir())


@posix
def test_a_file_that_others_may_write_to_is_not_read(cache: Path) -> None:
    the_file(cache).chmod(0o666)
    assert load() is None


@posix
def test_what_belongs_to_another_user_is_not_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 1)
    assert load() is None


@posix
def test_links_and_pipes_are_not_read(cache: Path, tmp_path: Path) -> None:
    path = the_file(cache)
    elsewhere = tmp_path / "elsewhere"
    path.rename(elsewhere)
    path.symlink_to(elsewhere)
    assert load() is None
    path.unlink()
    os.mkfifo(path)
    assert load() is None
    path.unlink()
    path.mkdir()
    assert load() is None


@posix
def test_a_link_in_place_of_the_folder_is_not_followed(cache: Path, tmp_path: Path) -> None:
    cache.rename(tmp_path / "real")
    cache.symlink_to(tmp_path / "real")
    assert load() is None


def test_a_damaged_snapshot_is_replaced(cache: Path) -> None:
    the_file(cache).write_bytes(b"nonsense")
    save()
    assert load() == DATA


def test_a_folder_that_cannot_be_made_is_no_problem(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("")
    for name in ("XDG_CACHE_HOME", "HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(blocked))
    assert save() is None and load() is None
    assert blocked.read_text() == ""


@pytest.mark.parametrize("function", ["open", "replace"])
def test_a_read_only_home_is_no_problem(
    function: str, monkeypatch: pytest.MonkeyPatch, cache: Path
) -> None:
    """Permissions do not stop root, so the calls that would fail do so here."""

    def refuse(*arguments: object, **options: object) -> None:
        raise PermissionError(30, "Read-only file system")

    the_file(cache).unlink()
    monkeypatch.setattr(f"os.{function}", refuse)
    assert save() is None
    assert not list(cache.iterdir())


def test_no_cache_neither_reads_nor_writes(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OSC2TX_NO_CACHE", "1")
    assert load() is None
    the_file(cache).unlink()
    assert save() is None
    assert not list(cache.iterdir())


def test_writers_at_the_same_time_leave_one_whole_snapshot(cache: Path) -> None:
    def write_and_read(_: int) -> Any:
        save()
        return load()

    with ThreadPoolExecutor(8) as pool:
        assert all(found == DATA for found in pool.map(write_and_read, range(40)))
    assert the_file(cache).is_file()

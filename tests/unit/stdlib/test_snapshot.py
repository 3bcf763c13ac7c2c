"""Snapshots of the library: same as parsing, and never trusted further than they deserve."""

import marshal
import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from random import Random
from typing import Any

import pytest

from osc2tx import stdlib
from osc2tx.diagnostics import SourceFile
from osc2tx.semantics import DIALECTS, ModelBuilder, dump_model
from osc2tx.semantics.builder import DiagnosticSink
from osc2tx.semantics.declarations import library
from osc2tx.stdlib import LIBRARY, TYPES, library_source, parse_library_file, snapshot
from osc2tx.stdlib.snapshot import load_snapshot, save_snapshot
from osc2tx.syntax import ast, dump_ast, parse
from osc2tx.syntax.packed_ast import PackingError, pack, unpack
from osc2tx_shared.cache import Snapshots, cache_folder, snapshots

ROOT = Path(__file__).resolve().parents[3]
OWN = sorted(ROOT.glob("scenarios/*.osc")) + sorted(ROOT.glob("tests/golden/ast/*/input.osc"))
MISTAKES = sorted(ROOT.glob("tests/golden/diagnostics/semantic_*/*.osc"))
SCENARIOS = [*OWN, *MISTAKES]
TEXTS = [(name, standard) for name in LIBRARY for standard in ("2.1", "2.2")]
TEXTS += [("dialects/carla.osc", "2.1")]


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A cache of the test's own, with a snapshot of `types.osc` in it."""
    monkeypatch.delenv("OSC2TX_NO_CACHE", raising=False)
    monkeypatch.setattr(snapshots, "_STARTED", 1 << 62)  # others may be editing the code
    for name in ("XDG_CACHE_HOME", "HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path))
    forget()
    folder = cache_folder()
    assert folder is not None and folder.is_relative_to(tmp_path)
    save_snapshot(parse_library_file(types()), "2.2")
    yield folder
    forget()


def forget() -> None:
    stdlib.library_file.cache_clear()
    library.shared_library.cache_clear()


def types() -> SourceFile:
    return library_source(TYPES, "2.2")


def the_file(cache: Path) -> Path:
    (path,) = cache.iterdir()
    return path


@pytest.mark.parametrize(("name", "standard"), TEXTS)
def test_a_snapshot_gives_what_parsing_gives(name: str, standard: str) -> None:
    source = library_source(name, standard)
    file = parse_library_file(source)
    save_snapshot(file, standard)
    loaded = load_snapshot(source, standard)
    assert loaded is not None and loaded is not file
    assert dump_ast(loaded) == dump_ast(file)
    assert loaded.span.source is source


@pytest.mark.parametrize(
    "path",
    [*OWN, *(pytest.param(path, marks=pytest.mark.slow) for path in MISTAKES)],
    ids=lambda path: f"{path.parent.name}/{path.stem}",
)
def test_every_construct_survives_packing(path: Path) -> None:
    source = SourceFile(path.name, path.read_bytes().decode("utf-8", "replace"))
    file = parse(source, DiagnosticSink())
    data = marshal.loads(marshal.dumps(pack(file)))
    assert dump_ast(unpack(data, source)) == dump_ast(file)


def modelled(path: Path, dialect: str) -> tuple[str, list[str]]:
    """The model of a file and what is reported on it, places in the library included."""
    sink = DiagnosticSink()
    file = parse(SourceFile(path.name, path.read_bytes().decode("utf-8", "replace")), sink)
    builder = ModelBuilder(
        sink, standard="2.2", dialect=DIALECTS[dialect], load=lambda statement, source: None
    )
    model = builder.build(file)
    return dump_model(model), [
        f"{d.code} {d.primary!r} {d.message} {[(x.span, x.message) for x in d.labels]}"
        for d in sink.sorted()
    ]


@pytest.mark.parametrize("dialect", ["asam", pytest.param("carla", marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    "first",
    [
        pytest.param(SCENARIOS[:1], id="first file"),
        pytest.param(SCENARIOS, marks=pytest.mark.slow, id="all files"),
    ],
)
def test_models_do_not_differ(
    dialect: str, first: list[Path], monkeypatch: pytest.MonkeyPatch, cache: Path
) -> None:
    """Without snapshots, in the process that writes them (its first file does), and from them."""
    found = {}
    for kind, paths in (("none", SCENARIOS), ("written", first), ("read", SCENARIOS)):
        forget()
        monkeypatch.setenv("OSC2TX_NO_CACHE", "1" if kind == "none" else "")
        found[kind] = [modelled(path, dialect) for path in paths]
    assert found["read"] == found["none"]
    assert found["written"] == found["none"][: len(first)]
    assert len(list(cache.iterdir())) >= 2


@pytest.mark.parametrize("length", [0, 5, 13, 17, 18, 100, -1])
def test_a_truncated_snapshot_is_ignored(cache: Path, length: int) -> None:
    path = the_file(cache)
    path.write_bytes(path.read_bytes()[:length])
    assert load_snapshot(types(), "2.2") is None


def test_a_snapshot_with_a_flipped_bit_is_ignored(cache: Path) -> None:
    path = the_file(cache)
    data = path.read_bytes()
    random = Random(7)
    for _ in range(300):
        bit = random.randrange(len(data) * 8)
        damaged = bytearray(data)
        damaged[bit // 8] ^= 1 << bit % 8
        path.write_bytes(damaged)
        assert load_snapshot(types(), "2.2") is None
    path.write_bytes(data)
    assert load_snapshot(types(), "2.2") is not None


@pytest.mark.parametrize(
    "content",
    [b"", b"no marshal", marshal.dumps(3), marshal.dumps((1, 2)), marshal.dumps((1, 2, 3))],
)
def test_a_snapshot_with_other_contents_is_ignored(cache: Path, content: bytes) -> None:
    magic = the_file(cache).read_bytes().partition(b"\n")[0] + b"\n"
    the_file(cache).write_bytes(magic + snapshots._checksum(content) + content)
    assert load_snapshot(types(), "2.2") is None


@pytest.mark.parametrize(
    "packed",
    [None, [], [("File", 1, [])], [("Nothing", 1, [])], [("Name", 1, [("plain", [1])] * 3)]],
)
def test_data_that_are_no_ast_are_refused(packed: object) -> None:
    with pytest.raises(PackingError):
        unpack(packed, types())  # type: ignore[arg-type]


def test_a_snapshot_of_another_text_is_ignored() -> None:
    other = SourceFile("<library>/types.osc", types().text + "\n")
    assert load_snapshot(other, "2.2") is None


@pytest.mark.parametrize("other", [{"kind": "osc2tx 0 AST 1"}, {"parts": ("syntax",)}], ids=str)
def test_a_snapshot_of_other_code_is_ignored(
    other: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    made = snapshot.SNAPSHOTS
    same = {"kind": made._magic.decode().strip(), "code": made._code, "parts": made._parts}
    monkeypatch.setattr(snapshot, "SNAPSHOTS", Snapshots(**(same | other)))
    assert load_snapshot(types(), "2.2") is None


def test_a_snapshot_of_code_that_changes_is_ignored(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(snapshots, "_STARTED", 0)
    assert load_snapshot(types(), "2.2") is None


posix = pytest.mark.skipif(sys.platform == "win32", reason="permissions of POSIX")


@posix
@pytest.mark.parametrize("mode", [0o777, 0o720])
def test_a_folder_that_others_may_write_to_is_not_read(cache: Path, mode: int) -> None:
    assert cache.stat().st_mode & 0o777 == 0o700
    cache.chmod(mode)
    assert load_snapshot(types(), "2.2") is None
    the_file(cache).unlink()
    save_snapshot(parse_library_file(types()), "2.2")
    assert not list(cache.iterdir())


@posix
def test_a_file_that_others_may_write_to_is_not_read(cache: Path) -> None:
    the_file(cache).chmod(0o666)
    assert load_snapshot(types(), "2.2") is None


@posix
def test_what_belongs_to_another_user_is_not_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 1)
    assert load_snapshot(types(), "2.2") is None


@posix
def test_links_and_pipes_are_not_read(cache: Path, tmp_path: Path) -> None:
    path = the_file(cache)
    elsewhere = tmp_path / "elsewhere"
    path.rename(elsewhere)
    path.symlink_to(elsewhere)
    assert load_snapshot(types(), "2.2") is None
    path.unlink()
    os.mkfifo(path)
    assert load_snapshot(types(), "2.2") is None
    path.unlink()
    path.mkdir()
    assert load_snapshot(types(), "2.2") is None


@posix
def test_a_link_in_place_of_the_folder_is_not_followed(cache: Path, tmp_path: Path) -> None:
    cache.rename(tmp_path / "real")
    cache.symlink_to(tmp_path / "real")
    assert load_snapshot(types(), "2.2") is None


def test_a_damaged_snapshot_is_replaced(cache: Path) -> None:
    path = the_file(cache)
    path.write_bytes(b"nonsense")
    file = stdlib.library_file(TYPES, "2.2")
    loaded = load_snapshot(types(), "2.2")
    assert loaded is not None and dump_ast(loaded) == dump_ast(file)


def test_a_folder_that_cannot_be_made_is_no_problem(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("")
    for name in ("XDG_CACHE_HOME", "HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(blocked))
    assert isinstance(stdlib.library_file(TYPES, "2.2"), ast.File)
    assert blocked.read_text() == ""


@pytest.mark.parametrize("function", ["mkstemp", "replace"])
def test_a_read_only_home_is_no_problem(
    function: str, monkeypatch: pytest.MonkeyPatch, cache: Path
) -> None:
    """Permissions do not stop root, so the calls that would fail do so here."""

    def refuse(*arguments: object, **options: object) -> None:
        raise PermissionError(30, "Read-only file system")

    monkeypatch.setattr(f"{'tempfile' if function == 'mkstemp' else 'os'}.{function}", refuse)
    the_file(cache).unlink()
    assert isinstance(stdlib.library_file(TYPES, "2.2"), ast.File)
    assert not list(cache.iterdir())


def test_no_cache_neither_reads_nor_writes(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OSC2TX_NO_CACHE", "1")
    assert load_snapshot(types(), "2.2") is None
    the_file(cache).unlink()
    assert isinstance(stdlib.library_file(TYPES, "2.2"), ast.File)
    assert not list(cache.iterdir())


def test_writers_at_the_same_time_leave_one_whole_snapshot(cache: Path) -> None:
    file = parse_library_file(types())

    def write_and_read(_: int) -> ast.File | None:
        save_snapshot(file, "2.2")
        return load_snapshot(types(), "2.2")

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(write_and_read, range(40)))
    assert the_file(cache).is_file()


@pytest.mark.slow
def test_processes_at_the_same_time(tmp_path: Path) -> None:
    code = "from osc2tx.stdlib import *; print(len(library_file('domain.osc', '2.2').statements))"
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path), "PYTHONPATH": str(ROOT)}
    started = [
        subprocess.Popen([sys.executable, "-c", code], env=environment, stdout=subprocess.PIPE)
        for _ in range(3)
    ]
    answers = {process.communicate()[0] for process in started}
    assert len(answers) == 1 and all(process.returncode == 0 for process in started)

"""The command `check` remembers: what it recalls, what it does not, and that nobody can tell."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from osc2tx.building import fingerprint, result_cache, workers
from osc2tx.building.jobs import Job
from osc2tx.building.results import FileResult, check_job
from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import InternalCompilerError
from tests.unit.cli.shell import DRIVE, Shell

ROOT = Path(__file__).parents[3]
LIBRARY = "import osc.standard\nscenario base:\n  do serial:\n    wait @gone\n"
SOURCES = {
    "good.osc": DRIVE.format(name="top"),
    "lib.osc": LIBRARY,
    "importing.osc": 'import "lib.osc"\n' + DRIVE.format(name="other"),
    "bad.osc": "scenario top:\n  x: vehicel\n  x: int\n",
    "syntax.osc": "scenario top:\n  do serial\n",
    "kept.osc": "use std.stdtypes  #! allow OSC601: old\nuse std.stdtypes\n",
    "unused.osc": "#! allow OSC601: none here\n" + DRIVE.format(name="third"),
}


@pytest.fixture
def shell(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Shell:
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("OSC2TX_NO_CACHE", raising=False)
    for name in ("XDG_CACHE_HOME", "HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path / ".cache"))
    monkeypatch.setattr(result_cache, "tool_stamp", lambda cache: "this osc2tx")
    return Shell(capsys, tmp_path)


@pytest.fixture
def checked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The files that are really checked."""
    names: list[str] = []

    def check(job: Job, memory: object = None) -> FileResult:
        names.append(job.name)
        return check_job(job)

    for module in (result_cache, workers):
        monkeypatch.setattr(module, "check_job", check)
    return names


def results_in(shell: Shell) -> Path:
    """Return the only file of results."""
    found = (shell.folder / ".cache/osc2tx/results").rglob("*")
    (kept,) = (path for path in found if path.is_file())
    return kept


def write_all(shell: Shell) -> None:
    for name, text in SOURCES.items():
        shell.write(f"in/{name}", text)


@pytest.mark.parametrize("form", ["text", "json", "sarif", "github"])
def test_what_is_recalled_reads_as_at_the_first_time(
    shell: Shell, checked: list[str], form: str
) -> None:
    write_all(shell)
    arguments = ("check", "in", "--dialect", "carla", "--output-format", form)
    first = shell(*arguments)
    assert sorted(checked) == sorted(SOURCES)
    checked.clear()
    assert shell(*arguments) == first
    assert checked == []
    assert first.code == 3
    levels = (first.out if form == "text" else first.err).count(": scenario ")
    assert levels == 4  # of the files without errors


def test_a_recalled_report_does_not_depend_on_its_form(shell: Shell, checked: list[str]) -> None:
    write_all(shell)
    fresh = shell("check", "in", "--no-cache", "--output-format", "json")
    shell("check", "in")
    checked.clear()
    assert shell("check", "in", "--output-format", "json") == fresh
    assert checked == []


def test_only_what_changed_is_checked_again(shell: Shell, checked: list[str]) -> None:
    write_all(shell)
    shell("check", "in")
    shell.write("in/lib.osc", LIBRARY.replace("@gone", "elapsed(1s)"))
    checked.clear()
    shell("check", "in")
    assert sorted(checked) == ["importing.osc", "lib.osc"]


def test_a_mistake_in_an_import_is_reported_for_the_file_that_did_not_change(shell: Shell) -> None:
    shell.write("lib.osc", "enum color: [red]\n")
    shell.write("a.osc", 'import "lib.osc"\n' + DRIVE.format(name="top"))
    assert shell("check", "a.osc").code == 0
    shell.write("lib.osc", "enum color: [red, red]\n")
    ended = shell("check", "a.osc")
    assert ended.code == 3
    assert "lib.osc:1" in ended.err
    (shell.folder / "lib.osc").unlink()
    assert "lib.osc" in shell("check", "a.osc").err


def test_options_count(shell: Shell, checked: list[str]) -> None:
    shell.write("a.osc", "use std.stdtypes\n")
    assert shell("check", "--dialect", "carla", "a.osc").code == 0
    assert shell("check", "a.osc").code == 3
    assert checked == ["a.osc", "a.osc"]


def test_strictness_and_limits_are_not_remembered(shell: Shell, checked: list[str]) -> None:
    waits = "".join(f"    wait @event_{n}\n" for n in range(3))
    shell.write("a.osc", f"scenario top:\n  do serial:\n{waits}")
    carla = ("check", "--dialect", "carla", "a.osc")
    assert shell(*carla).code == 0
    assert shell(*carla, "--strict").code == 1
    assert "2 more not shown" in shell(*carla, "--max-diagnostics", "1").err
    assert checked == ["a.osc"]


@pytest.mark.parametrize("variable", ["", "1"])
def test_without_cache_all_is_checked_and_nothing_kept(
    shell: Shell, checked: list[str], monkeypatch: pytest.MonkeyPatch, variable: str
) -> None:
    monkeypatch.setenv("OSC2TX_NO_CACHE", variable)
    arguments = ("check", "a.osc") if variable else ("check", "a.osc", "--no-cache")
    shell.drive("a.osc")
    assert shell(*arguments) == shell(*arguments)
    assert checked == ["a.osc", "a.osc"]
    assert not (shell.folder / ".cache/osc2tx/results").exists()


def test_a_bug_is_not_remembered(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(self: Compilation) -> bool:
        raise InternalCompilerError("lost")

    shell.drive("a.osc")
    with monkeypatch.context() as patch:
        patch.setattr(Compilation, "check", fail)
        assert shell("check", "a.osc").code == 70
    assert shell("check", "a.osc").code == 0


@pytest.mark.parametrize("damaged", [{}, [], {"job": 1}, "a.osc"])
def test_a_damaged_memory_is_none(shell: Shell, checked: list[str], damaged: object) -> None:
    shell.drive("a.osc")
    first = shell("check", "a.osc")
    kept = results_in(shell)
    document = json.loads(kept.read_text())
    (record,) = document["records"]
    for change in ({"records": [damaged]}, {"records": damaged}, {"format": damaged}):
        kept.write_text(json.dumps(document | change))
        assert shell("check", "a.osc") == first
    for key in ("scenarios", "dependencies", "outputs", "reports"):
        half = {"records": [record | {key: [damaged]}]}
        kept.write_text(json.dumps(document | half))
        assert shell("check", "a.osc") == first
    assert len(checked) >= 4


def test_the_memory_of_somebody_else_is_not_read(shell: Shell, checked: list[str]) -> None:
    shell.drive("a.osc")
    shell("check", "a.osc")
    results_in(shell).chmod(0o666)
    shell("check", "a.osc")
    assert checked == ["a.osc", "a.osc"]


def test_nothing_is_kept_once_osc2tx_itself_has_changed(
    shell: Shell, checked: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fingerprint, "STARTED", 0)
    monkeypatch.setattr(result_cache, "tool_stamp", fingerprint.tool_stamp)
    shell.drive("a.osc")
    shell("check", "a.osc")
    shell("check", "a.osc")
    assert checked == ["a.osc", "a.osc"]


def test_the_stamp_tells_one_osc2tx_from_another(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fingerprint, "_PACKAGE", tmp_path)
    (tmp_path / "semantics").mkdir()
    module = tmp_path / "semantics" / "model.py"
    module.write_text("a = 1\n")
    os.utime(module, ns=(0, 0))
    cache = tmp_path / "cache"
    stamp_of_a_new_process = fingerprint.tool_stamp.__wrapped__
    before = stamp_of_a_new_process(cache)
    assert before == stamp_of_a_new_process(cache) is not None
    os.utime(module, ns=(0, 1))
    assert stamp_of_a_new_process(cache) == before  # as in another installation
    module.write_text("a = 10\n")
    os.utime(module, ns=(0, 0))
    assert stamp_of_a_new_process(cache) not in (before, None)


def test_what_is_recalled_needs_no_stage(tmp_path: Path) -> None:
    (tmp_path / "a.osc").write_text(DRIVE.format(name="top"))
    stages = ("osc2tx.compilation.driver", "osc2tx.syntax", "osc2tx.semantics")
    stages += ("osc2tx.ir",)
    program = (
        "import sys, atexit\n"
        f"atexit.register(lambda: print([m for m in {stages!r} if m in sys.modules]))\n"
        "from osc2tx.cli import main\n"
        "main(['check', 'a.osc'])\n"
    )
    folders = os.pathsep.join([str(ROOT), str(ROOT / "runtime_lib")])
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path), "PYTHONPATH": folders}
    environment.pop("OSC2TX_NO_CACHE", None)
    ended = [
        subprocess.run(
            [sys.executable, "-c", program],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            check=True,
        ).stdout.splitlines()
        for _ in range(2)
    ]
    assert ended[0][-1] == repr(list(stages))
    assert ended[1] == [*ended[0][:-1], "[]"]

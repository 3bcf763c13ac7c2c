"""The answer to a check that was given before: the same, and only while nothing has changed."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx import cli
from osc2tx.building import answers, result_cache
from osc2tx.building.answers import Answer
from tests.unit.cli.shell import DRIVE, Ended

ROOT = Path(__file__).parents[3]
COMMAND = ("check", "in/importing.osc", "in/bad.osc", "in/good.osc")
LIBRARY = "import osc.standard\nscenario base:\n  do serial:\n    wait elapsed(1s)\n"


class Process:
    """Command lines as processes answer them, without starting any."""

    def __init__(self, capsys: pytest.CaptureFixture[str], folder: Path) -> None:
        self.capsys = capsys
        self.folder = folder

    def check(self, *arguments: str) -> Ended:
        with pytest.raises(SystemExit) as caught:
            cli.main(arguments, answer=Answer(arguments))
        return Ended(int(str(caught.value.code)), *self.capsys.readouterr())

    def recall(self, *arguments: str) -> Ended | None:
        code = Answer(arguments).recall()
        return None if code is None else Ended(code, *self.capsys.readouterr())

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path


@pytest.fixture
def process(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Process:
    (tmp_path / "project").mkdir()
    monkeypatch.chdir(tmp_path / "project")
    for name in ("OSC2TX_NO_CACHE", "OSC2TX_CACHE_DIR", "NO_COLOR", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)
    for name in ("XDG_CACHE_HOME", "HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path / ".cache"))
    for module in (answers, result_cache):
        monkeypatch.setattr(module, "tool_stamp", lambda folder: "this osc2tx")
    monkeypatch.setattr(answers, "STARTED", 1 << 62)  # the files here were written just now
    made = Process(capsys, tmp_path / "project")
    made.write("in/lib.osc", LIBRARY)
    made.write("in/importing.osc", 'import "lib.osc"\n' + DRIVE.format(name="other"))
    made.write("in/good.osc", DRIVE.format(name="top"))
    made.write("in/bad.osc", "scenario top:\n  x: vehicel\n  x: int\n")
    return made


@pytest.mark.parametrize("form", ["text", "json", "sarif", "github", "rdjson"])
def test_an_answer_reads_as_at_the_first_time(process: Process, form: str) -> None:
    command = (*COMMAND, "--output-format", form)
    assert process.recall(*command) is None
    first = process.check(*command)
    assert first.code == 3
    assert process.recall(*command) == first


CHANGES: dict[str, Callable[[Process], object]] = {
    "a source": lambda p: p.write("in/good.osc", DRIVE.format(name="another")),
    "a comment": lambda p: p.write("in/good.osc", DRIVE.format(name="top") + "# done\n"),
    "an imported file": lambda p: p.write("in/lib.osc", LIBRARY + "\n"),
    "no imported file": lambda p: (p.folder / "in/lib.osc").unlink(),
    "no source": lambda p: (p.folder / "in/good.osc").unlink(),
    "a folder in place of a source": lambda p: (
        (p.folder / "in/good.osc").unlink(),
        (p.folder / "in/good.osc").mkdir(),
    ),
    "settings beside it": lambda p: p.write("in/osc2tx.toml", 'std = "2.2"\n'),
    "settings above it": lambda p: p.write("../pyproject.toml", '[tool.osc2tx]\nstd = "2.2"\n'),
}


@pytest.mark.parametrize("change", CHANGES)
def test_an_answer_does_not_outlast_a_change(process: Process, change: str) -> None:
    process.check(*COMMAND)
    CHANGES[change](process)
    assert process.recall(*COMMAND) is None


@pytest.mark.skipif(sys.platform == "win32", reason="links need a right there")
def test_an_answer_does_not_outlast_a_link(process: Process) -> None:
    process.write("old/a.osc", DRIVE.format(name="top"))
    process.write("new/a.osc", DRIVE.format(name="top"))
    link = process.folder / "now"
    link.symlink_to("old")
    process.check("check", "now/a.osc")
    assert process.recall("check", "now/a.osc") is not None
    link.unlink()
    link.symlink_to("new")
    assert process.recall("check", "now/a.osc") is None


def test_an_answer_is_for_one_command_folder_and_environment(
    process: Process, monkeypatch: pytest.MonkeyPatch
) -> None:
    process.check(*COMMAND)
    assert process.recall(*COMMAND, "--strict") is None
    assert process.recall("build", *COMMAND[1:]) is None
    with monkeypatch.context() as patch:
        patch.setenv("FORCE_COLOR", "1")
        assert process.recall(*COMMAND) is None
    with monkeypatch.context() as patch:
        patch.setattr(answers, "tool_stamp", lambda folder: "another osc2tx")
        assert process.recall(*COMMAND) is None
    with monkeypatch.context() as patch:
        patch.setenv("OSC2TX_NO_CACHE", "1")
        assert process.recall(*COMMAND) is None
    monkeypatch.chdir(process.folder.parent)
    assert process.recall(*COMMAND) is None


@pytest.mark.parametrize(
    "arguments", [("in",), (*COMMAND[1:], "--no-cache"), (*COMMAND[1:], "--cache-dir", "kept"), ()]
)
def test_only_files_have_answers(process: Process, arguments: tuple[str, ...]) -> None:
    process.check("check", *arguments)
    assert process.recall("check", *arguments) is None


def test_no_answer_is_kept_of_a_file_that_changed_meanwhile(
    process: Process, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(answers, "STARTED", 0)
    process.check(*COMMAND)
    assert process.recall(*COMMAND) is None


@pytest.mark.parametrize("damage", ["", "[", "null", "[3]", "[3, [[1]], []]", "[" * 100_000])
def test_a_damaged_answer_is_none(process: Process, tmp_path: Path, damage: str) -> None:
    process.check(*COMMAND)
    (kept,) = (path for path in (tmp_path / ".cache/osc2tx/answers").rglob("*") if path.is_file())
    kept.write_text(damage)
    assert process.recall(*COMMAND) is None


@pytest.mark.skipif(sys.platform == "win32", reason="the profile of a user is closed to others")
def test_an_answer_of_somebody_else_is_not_read(process: Process, tmp_path: Path) -> None:
    process.check(*COMMAND)
    (kept,) = (path for path in (tmp_path / ".cache/osc2tx/answers").rglob("*") if path.is_file())
    kept.chmod(0o666)
    assert process.recall(*COMMAND) is None


def test_a_new_process_answers_without_the_command_line(tmp_path: Path) -> None:
    (tmp_path / "a.osc").write_text(DRIVE.format(name="top"))
    os.utime(tmp_path / "a.osc", (0, 0))
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path / ".cache"), "HOME": str(tmp_path)}
    environment.pop("OSC2TX_NO_CACHE", None)
    environment["PYTHONPATH"] = os.pathsep.join([str(ROOT), str(ROOT / "runtime_lib")])
    script = (
        "import sys, atexit\n"
        "from osc2tx.start import main\n"
        "atexit.register(lambda: print('click' in sys.modules))\n"
        "sys.argv = ['osc2tx', 'check', 'a.osc']\n"
        "main()\n"
    )
    said = [
        subprocess.run(
            [sys.executable, "-c", script],
            env=environment,
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=True,
        ).stdout.splitlines()
        for _ in range(2)
    ]
    assert said[1] == [*said[0][:-1], "False"]
    assert said[0][-2:] == ["checked 1 file: 0 errors, 0 warnings", "True"]

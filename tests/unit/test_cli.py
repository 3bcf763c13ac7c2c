"""The command line: what it prints, what it returns, what it loads."""

import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import click
import pytest

from osc2tx import __version__, cli, reporting
from osc2tx.config import ConfigError, ConfigFiles
from osc2tx.run_command import choose_scenario, merge_settings
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.errors import SettingsError

HEAVY = ("black", "pint", "numpy", "lxml", "rich", "py_trees", "jinja2", "osc2tx_runtime")

DRIVE = """import osc.standard

scenario {name}:
  ego: vehicle
  do serial:
    ego.drive(duration: 2s) with:
      speed(30kph)
"""


@dataclass
class Ended:
    code: int
    out: str
    err: str


class Shell:
    def __init__(self, capsys: pytest.CaptureFixture[str], folder: Path) -> None:
        self.capsys = capsys
        self.folder = folder

    def __call__(self, *arguments: object) -> Ended:
        with pytest.raises(SystemExit) as caught:
            cli.main([str(argument) for argument in arguments])
        captured = self.capsys.readouterr()
        assert "Traceback" not in captured.err
        return Ended(int(str(caught.value.code)), captured.out, captured.err)

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def drive(self, name: str, *scenarios: str) -> Path:
        first, *more = scenarios or ("top",)
        text = DRIVE.format(name=first)
        for scenario in more:
            text += "\n" + DRIVE.format(name=scenario).partition("\n\n")[2]
        return self.write(name, text)


@pytest.fixture
def shell(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Shell:
    monkeypatch.chdir(tmp_path)
    return Shell(capsys, tmp_path)


# --- check ---

LEVEL = "scenario top: abstract (open: map file; place of ego)"


def test_check_of_a_good_file(shell: Shell) -> None:
    shell.drive("a.osc")
    ended = shell("check", "a.osc")
    level = f"a.osc: {LEVEL}\n"
    assert ended == Ended(0, f"{level}checked 1 file: 0 errors, 0 warnings\n", "")


def test_check_shows_errors_where_the_reader_is(shell: Shell) -> None:
    shell.write("sub/a.osc", "scenario top:\n  hero: vehicel\n")
    shell.drive("sub/b.osc")
    ended = shell("check", "sub")
    assert ended.code == 3
    assert ended.out == f"b.osc: {LEVEL}\nchecked 2 files: 1 error, 0 warnings\n"
    assert ended.err.startswith("sub/a.osc:2:9: error[OSC202]: ")
    assert ended.err.endswith("\n\n`osc2tx explain OSC202` says more about a code.\n")


def test_warnings_do_not_fail(shell: Shell) -> None:
    shell.write("a.osc", DRIVE.format(name="top").replace("\n\n", "\nuse std.stdtypes\n"))
    ended = shell("check", "--dialect", "carla", "a.osc")
    assert ended.code == 0, ended.err
    assert "warning[OSC601]" in ended.err


def test_an_avalanche_is_cut(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reporting, "MOST_SHOWN", 2)
    fields = "".join(f"  a{number}: nothing{number}\n" for number in range(5))
    shell.write("a.osc", "scenario top:\n" + fields)
    ended = shell("check", "a.osc")
    assert ended.err.count("error[") == 2
    assert "\na.osc: 3 more not shown\n" in ended.err


def test_a_mistake_in_an_imported_file_counts_once(shell: Shell) -> None:
    shell.write("lib.osc", "struct place:\n  x: nothing\n")
    for name in ("a.osc", "b.osc"):
        shell.write(name, 'import "lib.osc"\n')
    ended = shell("check", ".")
    assert ended.code == 3
    assert ended.out == "checked 3 files: 1 error, 0 warnings\n"
    assert ended.err.count("error[OSC202]") == 1


def test_missing_folder_and_file(shell: Shell) -> None:
    (shell.folder / "empty").mkdir()
    assert shell("check", "no.osc") == Ended(
        4, "", "osc2tx: error: no.osc: no such file or folder\n"
    )
    assert shell("check", "empty").code == 2


def test_binary_file(shell: Shell) -> None:
    (shell.folder / "a.osc").write_bytes(b"\x00\xff")
    ended = shell("check", "a.osc")
    assert ended.code == 4
    assert "error[OSC101]: cannot read `a.osc`" in ended.err


def test_wrong_settings_file(shell: Shell) -> None:
    shell.drive("a.osc")
    shell.write("osc2tx.toml", 'dialct = "carla"\n')
    ended = shell("check", "a.osc")
    assert ended.code == 2
    assert ended.err.endswith("osc2tx.toml: unknown key `dialct`; did you mean `dialect`?\n")


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["check"],
        ["chek", "a.osc"],
        ["check", "--std", "3.0", "a.osc"],
        ["build", "a.osc"],
        ["build", "a.osc", "-o", "out", "--emit", "ast"],
        ["build", "a.osc", "-o", "out", "--target", "xml"],
        ["run"],
        ["run", "a.osc", "--seed", "x"],
        ["run", "a.osc", "--signal", "go"],
        ["run", "a.osc", "--dt", "-1"],
        ["run", "a.osc", "--scenario", "nobody"],
        ["run", "a.osc", "--set", "nobody=1"],
        ["explain", "OSC999"],
    ],
)
def test_wrong_usage(shell: Shell, arguments: list[str]) -> None:
    shell.drive("a.osc")
    ended = shell(*arguments)
    assert ended.code == 2
    assert ended.err


# --- build ---


def test_build_writes_and_then_has_nothing_to_do(shell: Shell) -> None:
    shell.drive("in/a.osc")
    first = shell("build", "in", "-o", "out")
    assert (first.code, first.out) == (
        0,
        "1 module in out: 4 files written; 0 errors, 0 warnings\n",
    )
    assert "0 files written" in shell("build", "in", "-o", "out").out
    assert json.loads((shell.folder / "out/a.map.json").read_text())["version"] == 1


def test_build_check_lists_what_would_change(shell: Shell) -> None:
    shell.drive("in/a.osc")
    ended = shell("build", "in", "-o", "out", "--check")
    assert ended.code == 1
    suffixes = ("map.json", "py", "xosc", "xosc.report.json")
    assert ended.err == "".join(f"out/a.{suffix}: is missing\n" for suffix in suffixes)
    shell("build", "in", "-o", "out")
    assert shell("build", "in", "-o", "out", "--check").code == 0
    (shell.folder / "out/a.py").write_text("edited")
    ended = shell("build", "in", "-o", "out", "--check")
    assert (ended.code, ended.err) == (1, "out/a.py: was edited by hand\n")


@pytest.mark.parametrize("product", ["ast", "model", "ir", "py"])
def test_emit_prints_and_writes_nothing(shell: Shell, product: str) -> None:
    shell.drive("a.osc")
    ended = shell("build", "a.osc", "--emit", product)
    assert ended.code == 0
    assert "top" in ended.out
    assert [path.name for path in shell.folder.iterdir()] == ["a.osc"]


def test_emit_of_a_broken_file_prints_what_there_is(shell: Shell) -> None:
    shell.write("a.osc", "scenario top:\n  x: nothing\n")
    assert "ScenarioDeclaration" in shell("build", "a.osc", "--emit", "ast").out
    ended = shell("build", "a.osc", "--emit", "py")
    assert (ended.code, ended.out) == (3, "")


def test_problems_of_outputs(shell: Shell) -> None:
    shell.drive("in/a-b.osc")
    shell.drive("in/a_b.osc")
    ended = shell("build", "in", "-o", "out")
    assert ended.code == 2
    assert "make the same module" in ended.err
    shell.write("file", "")
    assert shell("build", "in/a_b.osc", "-o", "file").code == 4


# --- run ---


def test_run_of_a_source_leaves_nothing_behind(shell: Shell) -> None:
    shell.drive("a.osc")
    before = set(sys.modules)
    ended = shell("run", "a.osc", "--trace", "t.jsonl", "--max-time", "10s")
    assert ended.code == 0, ended.err
    assert ended.out.startswith("top: success after 2.00 s")
    assert {name for name in set(sys.modules) - before if "osc2tx-run" in name} == set()
    lines = [json.loads(line) for line in (shell.folder / "t.jsonl").read_text().splitlines()]
    actions = [line for line in lines if line["kind"] == "action"]
    assert {line["source"] for line in actions} == {"a.osc:6"}
    assert sorted(path.name for path in shell.folder.iterdir()) == ["a.osc", "t.jsonl"]


def test_run_of_a_module(shell: Shell) -> None:
    shell.drive("a.osc")
    shell("build", "a.osc", "-o", "out")
    ended = shell("run", "out/a.py", "--trace", "t.jsonl")
    assert ended.code == 0, ended.err
    assert '"a.osc:6"' in (shell.folder / "t.jsonl").read_text()


def test_a_scenario_that_does_not_end_in_time_failed(shell: Shell) -> None:
    shell.drive("a.osc")
    ended = shell("run", "a.osc", "--max-time", "1")
    assert ended.code == 5
    assert ended.out.startswith("top: timeout after 1.00 s")


def test_run_stops_at_errors_in_the_source(shell: Shell) -> None:
    shell.write("a.osc", "scenario top:\n  x: nothing\n")
    ended = shell("run", "a.osc")
    assert (ended.code, ended.out) == (3, "")
    assert "a.osc:2:6: error[OSC202]" in ended.err


def test_run_takes_settings_of_the_file(shell: Shell) -> None:
    shell.drive("a.osc")
    shell.write("osc2tx.toml", "[scenarios.a.run]\nmax-time = 1\n")
    assert shell("run", "a.osc").code == 5
    assert shell("run", "a.osc", "--max-time", "5").code == 0


@pytest.mark.parametrize(
    ("name", "text", "code"),
    [
        ("library.osc", "enum color: [red]\n", 2),
        ("empty.py", "", 2),
        ("broken.py", "def\n", 4),
        ("binary.py", "\0", 4),
        ("strange.py", "import a_module_that_is_not_there\n", 4),
        ("text.txt", "hello\n", 3),
    ],
)
def test_run_of_what_cannot_run(shell: Shell, name: str, text: str, code: int) -> None:
    shell.write(name, text)
    ended = shell("run", name)
    assert ended.code == code, ended.err
    assert name in ended.err


def test_run_of_a_folder(shell: Shell) -> None:
    assert shell("run", ".").code == 4
    assert shell("run", "no.osc").code == 4


def test_unknown_map_folder(shell: Shell) -> None:
    shell.drive("a.osc")
    ended = shell("run", "a.osc", "--map-path", "nowhere")
    assert ended.code == 4
    assert "nowhere" in ended.err


def scenarios(*names: str) -> dict[str, type[Scenario]]:
    return {name: type(name, (Scenario,), {"name": name}) for name in names}


def test_which_scenario_runs() -> None:
    path = Path("a.osc")
    assert choose_scenario(scenarios("a", "main", "top"), None, path).name == "top"
    assert choose_scenario(scenarios("a", "main"), None, path).name == "main"
    assert choose_scenario(scenarios("a"), None, path).name == "a"
    assert choose_scenario(scenarios("a", "top"), "a", path).name == "a"
    with pytest.raises(click.UsageError, match="choose one with --scenario: a, b"):
        choose_scenario(scenarios("a", "b"), None, path)
    with pytest.raises(click.UsageError, match="no scenario `c`; there is: a, b"):
        choose_scenario(scenarios("a", "b"), "c", path)


def test_command_line_beats_settings_item_by_item(tmp_path: Path) -> None:
    (tmp_path / "osc2tx.toml").write_text(
        '[scenarios.a.run]\nmap-path = ["maps"]\nseed = 1\ndt = 0.1\n'
        'spawn = ["hero=1,-1,5", "npc=1,-2,5"]\n'
    )
    source = tmp_path / "a.osc"
    config = ConfigFiles().for_source(source)
    given = {"seed": "2", "spawn": ("hero=9,-1,7",), "map_path": ("mine",), "signal": ()}
    assert merge_settings(config, source, given) == RunSettings(
        map_path=(Path("mine"), tmp_path / "maps", tmp_path),
        spawn={"hero": ("9", -1, 7.0), "npc": ("1", -2, 5.0)},
        seed=2,
        dt=0.1,
    )


def test_whose_mistake_a_wrong_run_option_is(tmp_path: Path) -> None:
    (tmp_path / "osc2tx.toml").write_text('[scenarios.a.run]\nsignal = ["go"]\n')
    config = ConfigFiles().for_source(tmp_path / "a.osc")
    with pytest.raises(ConfigError, match=r"osc2tx.toml: in \[scenarios.a.run\]: --signal go"):
        merge_settings(config, tmp_path / "a.osc", {})
    with pytest.raises(SettingsError):
        merge_settings(config, tmp_path / "b.osc", {"signal": ("go",)})


# --- explain, help, edges ---


def test_explain(shell: Shell) -> None:
    text = shell("explain", "osc104").out
    assert text.startswith("OSC104 inconsistent-dedent (error)\n\nNo block has this indentation.")
    assert "section 7.2.1.4" in text
    assert shell("explain", "inconsistent-dedent").out == text
    assert "did you mean `inconsistent-dedent`?" in shell("explain", "inconsistent-dedant").err


def test_help_and_version(shell: Shell) -> None:
    assert __version__ in shell("--version").out
    text = shell("--help").out
    assert all(name in text for name in cli.COMMANDS)
    assert "--signal NAME@SECONDS" in shell("run", "--help").out


@pytest.mark.parametrize("name", cli.COMMANDS)
def test_every_command_of_the_help_page_is_there(name: str) -> None:
    context = click.Context(cli.cli)
    command = cli.cli.get_command(context, name)
    assert command is not None and command.name == name


def test_a_bug_has_its_own_exit_code(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr(cli.cli, "main", fail)
    with pytest.raises(SystemExit) as caught:
        cli.main([])
    assert caught.value.code == 70
    assert "this is a bug of osc2tx" in capsys.readouterr().err


def test_check_loads_nothing_heavy(tmp_path: Path) -> None:
    (tmp_path / "a.osc").write_text(DRIVE.format(name="top"))
    program = (
        "import sys, atexit\n"
        f"atexit.register(lambda: print([m for m in {HEAVY!r} if m in sys.modules]))\n"
        "from osc2tx.cli import main\n"
        "main(['check', 'a.osc'])\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    lines = [f"a.osc: {LEVEL}", "checked 1 file: 0 errors, 0 warnings", "[]"]
    assert ended.stdout.splitlines() == lines


def test_a_reader_that_goes_away_is_no_bug(tmp_path: Path) -> None:
    (tmp_path / "a.osc").write_text(DRIVE.format(name="top"))
    ended = subprocess.run(
        f"{sys.executable} -m osc2tx build --emit ast a.osc | true; exit ${{PIPESTATUS[0]}}",
        cwd=tmp_path,
        shell=True,
        executable="/bin/bash",
        capture_output=True,
        text=True,
    )
    assert ended.stderr == ""
    assert ended.returncode in (0, 141)

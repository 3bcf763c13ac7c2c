"""What all commands share: help, explanations, exit codes, and what is loaded."""

import json
import subprocess
import sys
from pathlib import Path

import click
import pytest

from osc2tx import __version__, cli
from osc2tx.diagnostics import CODES
from tests.unit.cli.shell import DRIVE, Shell

HEAVY = ("antlr4", "black", "pint", "numpy", "lxml", "rich", "py_trees", "jinja2", "osc2tx_runtime")


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
    assert "internal error" in capsys.readouterr().err


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
    lines = [
        "a.osc: scenario top: abstract (open: map file; place of ego)",
        "checked 1 file: 0 errors, 0 warnings",
        "[]",
    ]
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


def test_explain_takes_numbers_and_lists(shell: Shell) -> None:
    assert shell("explain", "104").out == shell("explain", "OSC104").out
    listed = shell("explain").out.splitlines()
    assert [line[:6] for line in listed] == list(CODES)
    data = json.loads(shell("explain", "--all", "--json").out)
    assert {entry["code"]: entry["name"] for entry in data} == {
        c.code: c.slug for c in CODES.values()
    }
    assert shell("explain", "--all", "104").code == 2


def test_unknown_commands_suggest(shell: Shell) -> None:
    assert "did you mean `build`?" in shell("biuld").err


def test_sources_of_the_settings(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "osc2tx.toml").write_text('sources = ["own"]\n', encoding="utf-8")
    (tmp_path / "own").mkdir()
    text = "scenario s:\n    do nothing()\n"
    (tmp_path / "own" / "a.osc").write_text(text, encoding="utf-8")
    assert "own/a.osc:2:8: error" in shell("check").err
    quiet = shell("check", "--quiet")
    assert (quiet.code, quiet.out) == (3, "")
    assert "0 of 1 file formatted" in shell("fmt").out


def test_explanations_keep_to_the_terminal(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    """Prose is folded, sources are not; in a pipe neither is."""
    whole = shell("explain", "--all").out
    monkeypatch.setattr("osc2tx.cli.explain.columns", lambda: 60)
    folded = shell("explain", "--all").out
    assert folded.split() == whole.split()
    too_long = [line for line in folded.splitlines() if len(line) > 60 and line[0] != " "]
    heads = tuple(f"{code} " for code in CODES)
    assert [line for line in too_long if not line.startswith((*heads, "Faulty"))] == []
    assert any(len(line) > 60 and line[0] != " " for line in whole.splitlines() if line)


@pytest.mark.parametrize(
    ("variables", "colored"),
    [
        ({}, False),
        ({"FORCE_COLOR": "1"}, True),
        ({"FORCE_COLOR": ""}, False),
        ({"FORCE_COLOR": "1", "NO_COLOR": "1"}, False),
        ({"FORCE_COLOR": "1", "NO_COLOR": ""}, True),
    ],
)
def test_colors_follow_the_variables(
    shell: Shell, monkeypatch: pytest.MonkeyPatch, variables: dict[str, str], colored: bool
) -> None:
    """In a pipe; as no-color.org and force-color.org say."""
    for name in ("NO_COLOR", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    wrong = shell.write("wrong.osc", "scenario a:\n  b: nothing\n")
    assert ("\x1b[" in shell("check", wrong).err) is colored
    assert ("\x1b[1mOSC302" in shell("explain", "302").out) is colored
    assert ("\x1b[" in shell("reference", "OSC302").out) is colored

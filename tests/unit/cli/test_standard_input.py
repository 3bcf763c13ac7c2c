"""`check -` and `fmt -`: texts that an editor has not saved yet."""

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from osc2tx.cli import cli
from osc2tx.cli.reporting import Session

UNTIDY = "actor a:\n  x:int\n"
TIDY = "actor a:\n    x: int\n"


def run(*words: str, text: str | bytes) -> Result:
    return CliRunner().invoke(cli, words, input=text, standalone_mode=False, obj=Session())


def test_check_calls_the_text_by_its_name(tmp_path: Path) -> None:
    """Settings and imports are those of the place that is named."""
    (tmp_path / "parts.osc").write_text("struct part:\n    n: int\n")
    (tmp_path / "osc2tx.toml").write_text('std = "2.2"\n')
    name = str(tmp_path / "new.osc")
    text = 'import "parts.osc"\n\nactor a:\n    p: part\n    q: range of int\n    r: prt\n'
    result = run("check", "-", "--stdin-filename", name, text=text)
    assert result.return_value == 3
    assert f"{name}:6:8: error[OSC202]: no type `prt`" in result.output
    assert result.output.count("error[") == 1
    assert run("check", "-", text=TIDY).return_value == 0
    assert not (tmp_path / "new.osc").exists()


def test_fmt_writes_the_text_to_standard_output() -> None:
    assert run("fmt", "-", text=UNTIDY).stdout == TIDY
    assert run("fmt", "-", text=TIDY).stdout == TIDY
    broken = run("fmt", "-", text="actor a(:\n")
    assert (broken.return_value, broken.stdout) == (3, "")


def test_fmt_compares() -> None:
    for option in ("--check", "--diff"):
        assert run("fmt", option, "-", text=TIDY).return_value == 0
        result = run("fmt", option, "-", text=UNTIDY)
        assert result.return_value == 1
        assert "stdin.osc" in result.output
        assert result.stdout != TIDY


@pytest.mark.parametrize("words", [("-", "a.osc"), ("a.osc", "--stdin-filename", "b.osc")])
def test_other_uses_are_refused(words: tuple[str, ...]) -> None:
    result = run("check", *words, text=TIDY)
    assert type(result.exception).__name__ == "UsageError"


def test_what_is_no_text_is_refused() -> None:
    result = run("check", "-", text=b"\xff\xfe")
    assert type(result.exception).__name__ == "InputError"
    assert "byte offset 0" in str(result.exception)

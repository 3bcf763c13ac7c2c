"""`osc2tx fmt`: what it writes, says and returns."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from osc2tx.cli import cli
from osc2tx.cli.reporting import Session

UNTIDY = "actor a:\n  x:length\n"
TIDY = "actor a:\n    x: length\n"


def fmt(*arguments: str | Path) -> Result:
    runner = CliRunner()
    words = ["fmt", *map(str, arguments)]
    return runner.invoke(cli, words, standalone_mode=False, obj=Session())


@pytest.fixture
def untidy(tmp_path: Path) -> Path:
    path = tmp_path / "untidy.osc"
    path.write_text(UNTIDY)
    return path


def test_files_are_written_in_place(untidy: Path) -> None:
    untidy.chmod(0o640)
    result = fmt(untidy.parent)
    assert (result.return_value, result.output) == (0, "1 of 1 file formatted\n")
    assert untidy.read_text() == TIDY
    assert untidy.stat().st_mode & 0o777 == 0o640


def test_tidy_files_are_not_touched(untidy: Path) -> None:
    untidy.write_text(TIDY)
    before = untidy.stat().st_mtime_ns
    assert fmt(untidy).output == "0 of 1 file formatted\n"
    assert untidy.stat().st_mtime_ns == before


def test_check_names_the_files_and_fails(untidy: Path) -> None:
    result = fmt("--check", untidy)
    assert result.return_value == 1
    assert f"{untidy}: is not formatted" in result.output
    assert untidy.read_text() == UNTIDY
    untidy.write_text(TIDY)
    assert fmt("--check", untidy).return_value == 0


def test_diff_shows_what_would_change(untidy: Path) -> None:
    result = fmt("--diff", untidy)
    assert result.return_value == 1
    assert "-  x:length\n+    x: length\n" in result.output
    assert untidy.read_text() == UNTIDY


def test_line_ends_and_byte_order_marks_are_changes(untidy: Path) -> None:
    untidy.write_bytes(b"\xef\xbb\xbf" + TIDY.replace("\n", "\r\n").encode())
    assert fmt("--check", untidy).return_value == 1
    assert fmt(untidy).return_value == 0
    assert untidy.read_bytes() == TIDY.encode()


def test_files_with_syntax_errors_stay_and_do_not_stop_others(untidy: Path) -> None:
    wrong = untidy.with_name("a_wrong.osc")
    wrong.write_text("actor (\n")
    result = fmt(untidy.parent)
    assert result.return_value == 3
    assert "a_wrong.osc:1:7" in result.output
    assert (wrong.read_text(), untidy.read_text()) == ("actor (\n", TIDY)


def test_block_comments_of_the_other_dialect_stay(tmp_path: Path) -> None:
    path = tmp_path / "a.osc"
    path.write_text("/* by hand */\nactor a:\n  x:int\n")
    assert fmt(path).return_value == 3
    assert fmt(path, "--dialect", "carla").return_value == 0
    assert path.read_text() == "/* by hand */\nactor a:\n    x: int\n"

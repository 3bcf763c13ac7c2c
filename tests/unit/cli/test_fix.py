"""`osc2tx check --fix`: what it writes, prints and returns."""

import io
import json
import os
import sys
from types import SimpleNamespace

import pytest

from tests.unit.cli.shell import Shell

SLIP = """import osc.standard

scenario top:
  ego: vehicle
  do serial
    ego.drive(duration: 2 s) with:
      speed(30kph)
"""
MENDED = SLIP.replace("serial\n", "serial:\n").replace("2 s", "2s")
UNSURE = MENDED.replace("ego: vehicle", "ego: vehicel")


def test_safe_fixes_are_written(shell: Shell) -> None:
    path = shell.write("a.osc", SLIP)
    ended = shell("check", path, "--fix")
    assert (ended.code, path.read_text()) == (0, MENDED)
    assert "2 fixes applied" in ended.out
    assert "0 errors" in ended.out


def test_a_conjunction_becomes_constraints_that_replace_defaults(shell: Shell) -> None:
    line = "  keep(a == 1 and b == 2)\n"
    text = "import osc.standard.all\n\nstruct base:\n  a: int = 5\n  b: int = 6\n\n"
    text += f"struct derived inherits base:\n{line}"
    path = shell.write("a.osc", text)
    assert shell("check", path, "--fix").code == 0
    assert path.read_text() == text.replace(line, "  keep(a == 1)\n  keep(b == 2)\n")


def test_a_second_time_there_is_nothing_to_fix(shell: Shell) -> None:
    path = shell.write("a.osc", SLIP)
    shell("check", path, "--fix")
    assert "no fixes applied" in shell("check", path, "--fix").out


def test_unsafe_fixes_need_their_option(shell: Shell) -> None:
    path = shell.write("a.osc", UNSURE)
    ended = shell("check", path, "--fix")
    assert (ended.code, path.read_text()) == (3, UNSURE)
    assert shell("check", path, "--fix", "--unsafe-fixes").code == 0
    assert path.read_text() == MENDED
    assert shell("check", path, "--unsafe-fixes").code == 2


def test_a_diff_writes_nothing(shell: Shell) -> None:
    path = shell.write("a.osc", SLIP)
    ended = shell("check", path, "--diff")
    assert (ended.code, path.read_text()) == (1, SLIP)
    assert "+  do serial:" in ended.out
    assert shell("check", path, "--diff", "--output-format", "json").code == 2


def test_line_ends_and_byte_order_mark_stay(shell: Shell) -> None:
    path = shell.folder / "a.osc"
    path.write_bytes(b"\xef\xbb\xbf" + SLIP.replace("\n", "\r\n").encode())
    assert shell("check", path, "--fix").code == 0
    assert path.read_bytes() == b"\xef\xbb\xbf" + MENDED.replace("\n", "\r\n").encode()


def test_imported_files_are_left_alone(shell: Shell) -> None:
    library = shell.write("lib.osc", SLIP)
    path = shell.write("a.osc", 'import "lib.osc"\n')
    shell("check", path, "--fix")
    assert library.read_text() == SLIP


def test_a_link_out_of_the_folder_is_not_followed(
    shell: Shell, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    outside = tmp_path_factory.mktemp("outside") / "a.osc"
    outside.write_text(SLIP)
    link = shell.folder / "a.osc"
    os.symlink(outside, link)
    monkeypatch.chdir(shell.folder)
    ended = shell("check", "a.osc", "--fix")
    assert (ended.code, outside.read_text()) == (4, SLIP)
    assert "out of the current folder" in ended.err


def test_standard_input_goes_to_standard_output(
    shell: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(SLIP.encode())))
    ended = shell("check", "-", "--fix")
    assert (ended.code, ended.out) == (0, MENDED)


def test_fixes_in_json_and_sarif(shell: Shell) -> None:
    path = shell.write("a.osc", UNSURE)
    document = json.loads(shell("check", path, "--output-format", "json").out)
    (fix,) = document["diagnostics"][0]["fixes"]
    assert (fix["title"], fix["applicability"]) == ("write `vehicle`", "unsafe")
    (edit,) = fix["edits"]
    assert (edit["text"], edit["location"]["start"]) == ("vehicle", {"line": 4, "column": 8})
    log = json.loads(shell("check", path, "--output-format", "sarif").out)
    (change,) = log["runs"][0]["results"][0]["fixes"][0]["artifactChanges"]
    (replacement,) = change["replacements"]
    assert replacement["insertedContent"] == {"text": "vehicle"}
    assert replacement["deletedRegion"]["startColumn"] == 8


def test_each_fix_is_a_suggested_change(shell: Shell) -> None:
    """What reviewers commit from the comments of reviewdog is what `--fix` writes."""
    path = shell.write("a.osc", SLIP)
    document = json.loads(shell("check", path, "--output-format", "rdjson").out)
    lines = SLIP.splitlines(keepends=True)
    for found in reversed(document["diagnostics"]):
        (change,) = found["suggestions"]
        start, end = change["range"]["start"], change["range"]["end"]
        assert start["line"] == end["line"]
        line = lines[start["line"] - 1]
        before, after = line[: start["column"] - 1], line[end["column"] - 1 :]
        lines[start["line"] - 1] = f"{before}{change['text']}{after}"
    assert "".join(lines) == MENDED

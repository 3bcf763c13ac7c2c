"""The command `build`: what it prints and returns at its plainest, and `--emit`."""

import json

import pytest

from tests.unit.cli.shell import Shell


def test_build_writes_and_then_has_nothing_to_do(shell: Shell) -> None:
    shell.drive("in/a.osc")
    first = shell("build", "in", "-o", "out")
    assert (first.code, first.out) == (
        0,
        "1 module in out: 3 files written; 0 errors, 0 warnings\n",
    )
    assert "0 files written" in shell("build", "in", "-o", "out").out
    assert json.loads((shell.folder / "out/a.map.json").read_text())["version"] == 3


def test_build_check_lists_what_would_change(shell: Shell) -> None:
    shell.drive("in/a.osc")
    ended = shell("build", "in", "-o", "out", "--check")
    assert ended.code == 1
    assert ended.err == "out/a.py: is missing\nout/a.top.xosc: is missing\n"
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
    ended = shell("build", "in/a_b.osc", "-o", "file")
    assert ended.code == 2
    assert "is a file" in ended.err

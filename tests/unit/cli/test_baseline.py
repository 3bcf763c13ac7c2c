"""Baselines of known warnings, and warnings that settings make errors."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.unit.cli.shell import Shell

SCENARIO = """import osc.standard.all

namespace null use std

scenario {name}:
    road: map
    ego: vehicle
{spares}    do ego.drive() with:
        speed(10mps)
"""


def scenario(name: str, *spares: str) -> str:
    lines = "".join(f"    {spare}: vehicle\n" for spare in spares)
    return SCENARIO.format(name=name, spares=lines)


@pytest.fixture
def project(shell: Shell) -> Shell:
    """Two files with a warning each, and a baseline that is not written yet."""
    shell.write("osc2tx.toml", 'sources = ["scenarios"]\nout = "out"\nbaseline = "known.json"\n')
    shell.write("scenarios/old.osc", scenario("old", "spare"))
    shell.write("scenarios/deep/other.osc", scenario("other", "spare"))
    return shell


def known(project: Shell) -> dict[str, int]:
    document = json.loads((project.folder / "known.json").read_text(encoding="utf-8"))
    return {each["file"]: each["count"] for each in document["warnings"]}


def test_known_warnings_are_not_reported(project: Shell) -> None:
    before = project("check", "--strict")
    assert (before.code, before.err.count("`spare`") >= 2) == (1, True)
    assert "known.json: 2 known warnings" in project("check", "--write-baseline").out
    assert known(project) == {"scenarios/deep/other.osc": 1, "scenarios/old.osc": 1}
    for command in ("check", "check scenarios/old.osc", "build"):
        ended = project(*command.split(), "--strict")
        assert (ended.code, ended.err) == (0, "")
        assert "suppressed" in ended.out


def test_a_known_warning_may_move(project: Shell) -> None:
    project("check", "--write-baseline")
    text = scenario("old", "spare").replace("scenario old", "# A comment above\n\nscenario old")
    project.write("scenarios/old.osc", text)
    assert project("check", "--strict").code == 0


def test_new_warnings_are_reported(project: Shell) -> None:
    project("check", "--write-baseline")
    project.write("scenarios/old.osc", scenario("old", "spare", "fresh"))
    project.write("scenarios/young.osc", scenario("young", "spare"))  # in a file of its own
    ended = project("check", "--strict", "--output-format", "json")
    diagnostics = json.loads(ended.out)["diagnostics"]
    found = [(each["location"]["file"], each["message"]) for each in diagnostics]
    assert ended.code == 1
    assert [(file, "fresh" in message) for file, message in found] == [
        ("scenarios/old.osc", True),
        ("scenarios/young.osc", False),
    ]


def test_one_more_of_the_same_is_new(project: Shell) -> None:
    project("check", "--write-baseline")
    second = scenario("second", "spare").partition("scenario")
    project.write("scenarios/old.osc", scenario("old", "spare") + "\n" + "".join(second[1:]))
    ended = project("check", "--strict")
    assert ended.code == 1
    assert "1 warning" in ended.out


def test_what_is_gone_is_said(project: Shell) -> None:
    project("check", "--write-baseline")
    project.write("scenarios/old.osc", scenario("old"))
    ended = project("check")
    assert "known.json: 1 warning does not occur any more" in ended.err
    assert project("check", "--strict").code == 1
    assert project("check", "scenarios/deep").err == ""  # of old.osc nobody asked
    project("check", "--write-baseline", "scenarios/old.osc")
    assert known(project) == {"scenarios/deep/other.osc": 1}
    assert project("check", "--strict").code == 0


def test_files_with_errors_keep_their_entries(project: Shell) -> None:
    """Warnings are found after errors, so their absence says nothing."""
    project("check", "--write-baseline")
    project.write("scenarios/old.osc", scenario("old", "spare") + "    wrong(\n")
    assert "any more" not in project("check").err
    project("check", "--write-baseline")
    assert known(project) == {"scenarios/deep/other.osc": 1, "scenarios/old.osc": 1}


def test_an_answer_depends_on_the_baseline(project: Shell) -> None:
    """A second equal command on unchanged files is answered from memory."""
    assert [project("check", "--strict").code for _ in range(2)] == [1, 1]
    project("check", "--write-baseline")
    assert [project("check", "--strict").code for _ in range(2)] == [0, 0]
    (project.folder / "known.json").unlink()
    assert project("check", "--strict").code == 1


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{", '{"version": 2, "warnings": []}', '{"version": 1, "warnings": [{"file": 1}]}'],
)
def test_a_damaged_baseline(project: Shell, text: str) -> None:
    project.write("known.json", text)
    ended = project("check")
    assert (ended.code, "known.json: is no baseline" in ended.err) == (2, True)


def test_a_baseline_without_a_place(shell: Shell) -> None:
    shell.write("old.osc", scenario("old", "spare"))
    ended = shell("check", "old.osc", "--write-baseline")
    assert (ended.code, "name a file in the settings" in ended.err) == (2, True)


def test_warnings_become_errors_by_pattern(project: Shell) -> None:
    settings = (project.folder / "osc2tx.toml").read_text(encoding="utf-8")
    project.write("osc2tx.toml", settings + '[files."deep/**"]\nerrors = ["OSC433"]\n')
    for command in ("check", "build"):
        ended = project(command)
        assert ended.code == 3
        assert "error[OSC433]" in ended.err
        assert "1 error, 1 warning" in ended.out
        assert "not compiled" not in ended.err
    assert Path(project.folder / "out/deep/other.py").exists()  # as the source is valid
    text = scenario("other", "spare").replace("spare: vehicle", "spare: vehicle  #! allow OSC433")
    project.write("scenarios/deep/other.osc", text)
    assert project("check").code == 0
    project.write("scenarios/deep/other.osc", scenario("other", "spare"))
    project("check", "--write-baseline")
    assert project("check").code == 0

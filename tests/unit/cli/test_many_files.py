"""Reports that fit a repository: stale files in every form, one cause once, files not compiled."""

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from tests.unit.building.test_revision import git
from tests.unit.cli.shell import DRIVE, Shell

SCHEMA = Path(__file__).parents[3] / "docs/diagnostics.schema.json"
BASE = "import osc.standard\nscenario base:\n  v_ego: speed = 30kph\n"
USER = (
    "import base\nimport osc.standard\nscenario s{number} inherits base:\n  keep(v_ego == 31kph)\n"
)


def document(text: str) -> Any:
    found = json.loads(text)
    jsonschema.validate(found, json.loads(SCHEMA.read_text(encoding="utf-8")))
    return found


def faults_of(shell: Shell, form: str, *arguments: str) -> list[tuple[str, str]]:
    """Return the files and the rules of a document, and check that the command fails."""
    ended = shell(*arguments, "--output-format", form)
    assert ended.code == 1
    if form == "json":
        return [(each["file"], each["rule"]) for each in document(ended.out)["files"]]
    if form == "sarif":
        (run,) = json.loads(ended.out)["runs"]
        rules = [rule["id"] for rule in run["tool"]["driver"]["rules"]]
        assert all(rules[each["ruleIndex"]] == each["ruleId"] for each in run["results"])
        places = (each["locations"][0]["physicalLocation"] for each in run["results"])
        uris = [place["artifactLocation"]["uri"] for place in places]
        return list(zip(uris, [each["ruleId"] for each in run["results"]], strict=True))
    if form == "rdjson":
        found = json.loads(ended.out)["diagnostics"]
        return [(each["location"]["path"], each["code"]["value"]) for each in found]
    lines = [line.removeprefix("::error file=") for line in ended.out.splitlines()]
    found = [line.split("::")[0].split(",title=osc2tx ") for line in lines]
    return [(file, rule) for file, rule in found]


@pytest.mark.parametrize("form", ["json", "sarif", "github", "rdjson"])
def test_stale_outputs_and_formatting_are_in_every_form(shell: Shell, form: str) -> None:
    shell.drive("in/a.osc")
    stale = faults_of(shell, form, "build", "in", "-o", "out", "--check", "--target", "py")
    assert stale == [("out/a.py", "stale-output")]
    shell.write("in/a.osc", DRIVE.format(name="top").replace("ego: vehicle", "ego:   vehicle"))
    assert faults_of(shell, form, "fmt", "in", "--check") == [("in/a.osc", "not-formatted")]


def test_changes_since_a_revision_as_json(shell: Shell) -> None:
    shell.drive("in/a.osc")
    for arguments in (("init", "-q"), ("add", "."), ("commit", "-qm", "one")):
        git(shell.folder, *arguments)
    shell.write("in/a.osc", DRIVE.format(name="top").replace("30kph", "31kph"))
    arguments = ("build", "in", "-o", "out", "--diff-against", "HEAD", "--target", "py")
    ended = shell(*arguments, "--output-format", "json")
    (change,) = document(ended.out)["files"]
    assert (change["file"], change["rule"]) == ("out/a.py", "changed-output")
    assert "+++ b/out/a.py" in change["diff"] and "31 * kph" in change["diff"]
    assert shell(*arguments, "--output-format", "github").out.startswith("::notice ")
    (run,) = json.loads(shell(*arguments, "--output-format", "sarif").out)["runs"]
    assert [each["level"] for each in run["results"]] == ["note"]


def test_one_cause_in_many_files_is_shown_once(shell: Shell) -> None:
    for number in range(9):
        shell.write(f"in/s{number}.osc", USER.format(number=number))
    shell.write("in/base.osc", BASE.replace("v_ego", "v_own"))
    ended = shell("check", "in", "-j1")
    (code,) = {line.split("[")[1][:6] for line in ended.err.splitlines() if "error[" in line}
    assert ended.err.count(f"error[{code}]") == 1
    assert "9 times in 9 files: also in/s1.osc:4, in/s2.osc:4" in ended.err
    assert "no `v_ego` is inherited from here" in ended.err
    assert "9 errors" in ended.out
    assert shell("check", "in", "--output-format", "github").out.count("::error") == 1
    whole = document(shell("check", "in", "--output-format", "json").out)
    errors = [each for each in whole["diagnostics"] if each["severity"] == "error"]
    assert len(errors) == 9  # programs get all
    assert shell("check", "in", "--max-diagnostics", "0").err.count(f"error[{code}]") == 9


def test_files_that_a_library_keeps_from_being_compiled_are_counted(shell: Shell) -> None:
    for number in range(3):
        shell.write(f"in/s{number}.osc", USER.format(number=number))
    shell.write("in/base.osc", BASE.replace("base:", "base"))
    ended = shell("check", "in")
    assert "3 files not compiled because of errors in in/base.osc" in ended.err


def test_line_ends_of_windows_are_formatted(shell: Shell) -> None:
    path = shell.drive("in/a.osc")
    shell("fmt", "in")
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    assert shell("fmt", "in", "--check").code == 0

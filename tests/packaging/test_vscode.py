"""The extension for Visual Studio Code fits the product: grammar, commands, matcher."""

import json
import re
import shutil
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from tests.end_to_end.harness import REPOSITORY

FOLDER = REPOSITORY / "editors" / "vscode"
PACKAGE = json.loads((FOLDER / "package.json").read_text(encoding="utf-8"))
BUNDLE = FOLDER / "out" / "extension.js"
CONTRIBUTES = PACKAGE["contributes"]
SCRIPT = (FOLDER / "extension.js").read_text(encoding="utf-8")


def grammar() -> Any:
    return json.loads((FOLDER / CONTRIBUTES["grammars"][0]["path"]).read_text(encoding="utf-8"))


def scope(text: str, word: str) -> str:
    """Return the scope of a word by the first pattern that matches there, line for line."""
    at = 0
    while at < len(text):
        for pattern in grammar()["patterns"]:
            found = re.compile(pattern.get("match", pattern.get("begin"))).match(text, at)
            if found is None or found.end() == at:
                continue
            for number, capture in pattern.get("captures", {}).items():
                if found[int(number)] == word:
                    return str(capture["name"])
            if word in found[0]:
                return str(pattern.get("name", ""))
            at = found.end()
            break
        else:
            at += 1
    return ""


def test_the_grammar_is_the_one_of_the_tables() -> None:
    tool = import_module("tools.make_grammar")
    assert tool.PLACE.read_text(encoding="utf-8") == tool.render()


@pytest.mark.parametrize(
    ("line", "word", "expected"),
    [
        ("scenario vehicle.cut_in:", "vehicle.cut_in", "entity.name.type.osc2"),
        ("    do parallel:  # all", "parallel", "keyword.control.composition.osc2"),
        ("    speed(50kph)", "kph", "keyword.other.unit.osc2"),
        ("    speed(50kph)", "50", "constant.numeric.osc2"),
        ("    speed(50kph)", "speed", "entity.name.function.osc2"),
        ("    wait @approach.end", "@approach.end", "variable.other.event.osc2"),
        ("    until rise(x > 1m)", "rise", "support.function.osc2"),
        ("    x: bool = true  # until", "# until", "comment.line.number-sign.osc2"),
        ("    lane(side: left)", "side", "variable.parameter.osc2"),
    ],
)
def test_words_have_their_scope(line: str, word: str, expected: str) -> None:
    assert scope(line, word) == expected


def test_commands_are_those_of_the_server_and_of_the_script() -> None:
    decorations = pytest.importorskip("osc2tx.language_server.decorations")
    declared = {each["command"] for each in CONTRIBUTES["commands"]}
    assert {command for _, command in decorations.LENSES} <= declared
    registered = set(re.findall(r'registerCommand\("([\w.]+)"', SCRIPT))
    of_server = {"osc2tx.showModule", "osc2tx.showXml"}
    assert registered | of_server == declared


def test_the_problem_matcher_reads_diagnostics() -> None:
    pattern = CONTRIBUTES["problemMatchers"][0]["pattern"]
    line = "scenarios/a.osc:3:7: error[OSC202]: no type `vehicel` (§7.3)"
    found = re.match(pattern["regexp"], line)
    assert found is not None
    assert (found[pattern["file"]], found[pattern["line"]]) == ("scenarios/a.osc", "3")
    assert (found[pattern["code"]], found[pattern["severity"]]) == ("OSC202", "error")


def test_bundled_packages_have_one_version_each() -> None:
    assert all(re.fullmatch(r"\d+\.\d+\.\d+", v) for v in PACKAGE["devDependencies"].values())


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
@pytest.mark.skipif(not BUNDLE.is_file(), reason="not bundled: `make vscode`")
def test_the_bundle_starts_the_server_and_shows_all(tmp_path: Path) -> None:
    """With a stand-in of the module `vscode`; `tests/vscode` has a session of VS Code itself."""
    pytest.importorskip("pygls")
    path = tmp_path / "cut_in.osc"
    text = (REPOSITORY / "docs/recipes/cut_in_at_gap.osc").read_text(encoding="utf-8")
    path.write_text(f"{text}\nscenario unfinished:\n    other: vehicel\n", encoding="utf-8")
    wrong = played(path)
    (found,) = wrong["diagnostics"].values()
    assert any("vehicel" in message for message in found)
    path.write_text(text, encoding="utf-8")
    seen = played(path)
    assert list(seen["diagnostics"].values()) == [[]]
    assert "class " in seen["shown"]["cut_in.py"]
    assert "<OpenSCENARIO>" in seen["shown"]["cut_in.xosc"]
    assert "parallel" in seen["shown"]["tree.txt"]
    assert seen["reports"] == [["Report of cut_in.osc", "<!DOCTYPE html>"]]
    assert seen["tasks"][0][1][-2:] == ["run", str(path)]
    assert seen["errors"] == []


def played(scenario: Path) -> Any:
    """Return what the extension registered and showed for a file."""
    stand_in = Path(__file__).parent / "vscode_stand_in.js"
    command = ["node", str(stand_in), str(BUNDLE), str(scenario), sys.executable, "-m", "osc2tx"]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert ended.returncode == 0, ended.stderr
    return json.loads(ended.stdout)

"""Documents for programs contain what a run finds, at line and column of its modifier."""

import json
from xml.etree import ElementTree

import pytest

from tests.unit.cli.shell import Shell

HEAD = """\
import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do serial:
        ego.drive(duration: 2s) with:
            lane(2, at: start)
            position(50m, at: start)
            speed(10mps)
        ego.drive(duration: 3s) with:
            keep_lane()
"""
PARTLY = HEAD + "            speed(15mps)\n"
NEVER = PARTLY + "            physical_movement(must_be_physical)\n"
PLACE = {"startLine": 16, "startColumn": 13, "endLine": 16, "endColumn": 25}


@pytest.mark.parametrize(
    ("text", "code", "level"), [(PARTLY, "OSC811", "warning"), (NEVER, "OSC810", "error")]
)
def test_sarif(shell: Shell, text: str, code: str, level: str) -> None:
    shell.write("a.osc", text)
    ended = shell("run", "a.osc", "--output-format", "sarif")
    assert ended.code == (0 if level == "warning" else 5)
    (result,) = json.loads(ended.out)["runs"][0]["results"]
    assert (result["ruleId"], result["level"]) == (code, level)
    assert result["locations"][0]["physicalLocation"]["region"] == PLACE
    assert "its speed is 10.00, not 15.00 m/s" in result["message"]["text"]


@pytest.mark.parametrize("form", ["json", "rdjson", "github"])
def test_other_documents(shell: Shell, form: str) -> None:
    shell.write("a.osc", PARTLY)
    found = shell("run", "a.osc", "--output-format", form).out
    if form == "github":
        assert found.startswith("::warning file=a.osc,line=16,endLine=16,col=13,")
    else:
        (entry,) = json.loads(found)["diagnostics"]
        start = entry["location"]["range" if form == "rdjson" else "start"]
        start = start["start"] if form == "rdjson" else start
        assert (start["line"], start["column"]) == (16, 13)


def test_errors_of_the_source_and_of_the_command_line_have_one_document(shell: Shell) -> None:
    shell.write("a.osc", "scenario top:\n  x: nothing\n")
    shell.write("b.osc", PARTLY)
    ended = shell("run", "a.osc", "--output-format", "json")
    assert (ended.code, json.loads(ended.out)["diagnostics"][0]["code"]) == (3, "OSC202")
    ended = shell("run", "b.osc", "--scenario", "none", "--output-format", "json")
    assert ended.code == 2 and "no scenario `none`" in json.loads(ended.out)["failure"]
    ended = shell("run", "b.osc", "--output-format", "json", "--max-time", "1")
    (entry,) = json.loads(ended.out)["diagnostics"]
    assert (ended.code, entry["code"], entry["severity"]) == (5, "OSC809", "error")


def test_junit(shell: Shell) -> None:
    shell.write("scenarios/a.osc", PARTLY)
    shell.write("osc2tx.toml", 'sources = ["scenarios"]\n')
    ended = shell("test", "--junit", "junit.xml", "-j", "1")
    assert ended.code == 0, ended.out
    properties = ElementTree.parse(shell.folder / "junit.xml").getroot().iter("property")
    (found,) = (e.attrib["value"] for e in properties if e.attrib["name"] == "osc2tx.violation")
    assert found.startswith("scenarios/a.osc:16:13: warning[OSC811]: ego drive: `speed` does not")

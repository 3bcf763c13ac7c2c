"""Texts of a scenario are only ever texts of the document."""

from pathlib import Path

import pytest
from lxml import etree

from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions, XmlOptions
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Unwritable, text_of
from tests.unit.backends.xosc.checks import schema_errors, story_problems

SOURCE = """\
# --> <!-- ]]> &amp; \u2028
import osc.standard.all

namespace null use std, stdtypes

scenario |a "b" --> <c> & ${d}|:
    road: map with:
        keep(it.map_file == %s)
    |my ego|, my_ego: vehicle
    event |go there|
    event go_there

    do parallel:
        |my ego|.drive() with: # --> <!--
            speed(10mps)
            until @|go there|
        serial:
            my_ego.drive(duration: 1s) with:
                speed(12mps)
            emit go_there
"""


def compiled(literal: str, tmp_path: Path) -> Compilation:
    path = tmp_path / "a.osc"
    path.write_text(SOURCE % literal, encoding="utf-8")
    options = CompileOptions(target="xosc", xml=XmlOptions(spawns=("my_ego=1,-1,5",)))
    return Compilation(path, path.name, options)


@pytest.mark.parametrize(
    ("literal", "value"),
    [
        (r'"highway.xodr"', "highway.xodr"),
        (r'"a\"><x y=\"1.xodr"', 'a"><x y="1.xodr'),
        (r'"a\nb\tc.xodr"', "a\nb\tc.xodr"),
        (r'"&lt;&#0;.xodr"', "&lt;&#0;.xodr"),
    ],
)
def test_texts_arrive_as_they_are(literal: str, value: str, tmp_path: Path) -> None:
    """What the map is called stands in the document just so, whatever else that may mean."""
    found = compiled(literal, tmp_path)
    (scenario,) = found.xml
    if scenario.xml is None:  # a map that is not at hand: the actors have no place
        assert all("map" in entry.reason for entry in scenario.report.obstacles)
        return
    root = etree.fromstring(scenario.xml.encode())
    (file,) = root.iter("LogicFile")
    assert file.get("filepath") == value
    assert schema_errors(scenario.xml, "1.3") == []
    assert story_problems(scenario.xml) == []


@pytest.mark.parametrize("literal", [r'"$map"', r'"${map}"', '"a\\x01b"', '"a\x01b.xodr"'])
def test_texts_that_would_mean_something_else_are_refused(literal: str, tmp_path: Path) -> None:
    found = compiled(literal, tmp_path)
    if found.ir is None:
        assert found.diagnostics
        return
    (scenario,) = found.xml
    assert scenario.xml is None
    assert scenario.report.obstacles


def test_names_that_look_alike_stay_apart(tmp_path: Path) -> None:
    (scenario,) = compiled('"highway.xodr"', tmp_path).xml
    assert scenario.xml is not None, scenario.report.obstacles
    root = etree.fromstring(scenario.xml.encode())
    assert [node.get("name") for node in root.iter("ScenarioObject")] == ["my_ego", "my_ego_2"]
    variables = [node.get("name") for node in root.iter("VariableDeclaration")]
    assert {"go_there", "go_there_2"} <= set(variables)
    (emitting,) = (e for e in root.iter("Event") if "emit" in (e.get("name") or ""))
    (set_there,) = (node.get("variableRef") for node in emitting.iter("VariableAction"))
    waited = {node.get("variableRef") for node in root.iter("VariableCondition")}
    assert set_there not in waited  # the drive waits for the other event


@pytest.mark.parametrize("text", ["$x", "${1}", "a\x00b", "a\x1bb", "\ufffe", "\ud800"])
def test_attributes_refuse(text: str) -> None:
    with pytest.raises(Unwritable):
        xml.Property(name="a", value=text)


def test_attributes_take_all_other_texts() -> None:
    assert text_of('a "b" <c> & 5 $ ${x} \n é 🚗') == 'a "b" <c> & 5 $ ${x} \n é 🚗'

"""Documents as people have them: orders, versions and names of other times."""

import json
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from tests.importing.documents import (
    after,
    at_time,
    document,
    event,
    faults,
    imported,
    speed_change,
)
from tests.importing.test_command import command, written

EVENTS = event("One", speed_change("20"), at_time("1")) + event(
    "Two", speed_change("10"), after("One")
)
TEXT = document(EVENTS)
MIXED = ("OpenSCENARIO", "ScenarioObject", "Vehicle", "Storyboard", "Act", "ManeuverGroup", "Event")


def test_the_order_of_elements_does_not_count() -> None:
    root = ET.fromstring(TEXT)
    for element in root.iter():
        if element.tag in MIXED:
            element[:] = list(reversed(element))
    assert imported(ET.tostring(root, encoding="unicode")).text == imported(TEXT).text


@pytest.mark.parametrize(
    "optional",
    [
        "<ParameterDeclarations></ParameterDeclarations>",
        "<CatalogLocations/>",
        ' delay="0"',
        ' maximumExecutionCount="1"',
        ' selectTriggeringEntities="false"',
        ' offset="0"',
    ],
)
def test_what_is_missing_has_its_default(optional: str) -> None:
    assert optional in TEXT
    assert imported(TEXT.replace(optional, "")).text == imported(TEXT).text


@pytest.mark.parametrize(("major", "minor"), [(1, 0), (1, 1), (1, 4), (1, 9), (2, 0)])
def test_other_versions(major: int, minor: int) -> None:
    version = f'revMajor="{major}" revMinor="{minor}"'
    text = TEXT.replace('revMajor="1" revMinor="3"', version)
    assert imported(text).text == imported(TEXT).text


def test_names_of_earlier_versions() -> None:
    old = TEXT.replace('priority="override"', 'priority="overwrite"')
    assert imported(old).text == imported(TEXT).text


def test_types_of_earlier_versions() -> None:
    """`integer` is `int` since 1.1."""

    def with_type(name: str) -> str:
        parameter = f'<ParameterDeclaration name="v" parameterType="{name}" value="20"/>'
        return imported(document("", parameters=parameter, ego_speed="$v")).text

    assert with_type("integer") == with_type("int")


def test_a_controller_action_of_1_0() -> None:
    action = '<ActivateControllerAction longitudinal="true" lateral="true"/>'
    found = imported(document(event("On", action, at_time("1"))))
    assert found.report.under_test == ["other"]


def test_the_summary_as_json(tmp_path: Path) -> None:
    source = written(tmp_path, "two_cars.xosc", TEXT)
    out = tmp_path / "out"
    result = command("import", source, "-o", out, "--output-format", "json")
    (found,) = json.loads(result.output)
    assert found == json.loads((out / "two_cars.import.json").read_text(encoding="utf-8"))


def test_a_name_is_for_one_document(tmp_path: Path) -> None:
    sources = [written(tmp_path, name, TEXT) for name in ("a.xosc", "b.xosc")]
    words: list[str | Path] = ["import", *sources, "-o", tmp_path / "out"]
    assert "--scenario-name is for one document" in str(
        command(*words, "--scenario-name", "Both").exception
    )


def test_an_encoding_that_a_document_declares(tmp_path: Path) -> None:
    text = TEXT.replace('encoding="UTF-8"', 'encoding="ISO-8859-1"')
    text = text.replace('description="Two cars"', 'description="Zwei ähnliche"').strip()
    source = tmp_path / "two_cars.xosc"
    source.write_bytes(text.encode("latin-1"))
    assert command("import", source, "-o", tmp_path / "out").return_value == 0
    assert "Zwei ähnliche" in (tmp_path / "out" / "two_cars.osc").read_text(encoding="utf-8")


def test_a_name_of_a_parameter_with_a_sign() -> None:
    parameter = '<ParameterDeclaration name="$Goal" parameterType="double" value="25"/>'
    found = imported(
        document(event("Faster", speed_change("$Goal"), at_time("1")), parameters=parameter)
    )
    assert "goal: speed = 90kph" in found.text
    assert faults(found) == []
